// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>
#include <osio/collapse/band_view.h>
#include <osio/collapse/selection.h>
#include <osio/collapse/stream.h>
#include <osio/layout/channel_layout.h>
#include <osio/layout/spectral_metadata.h>

#include <OpenEXR/ImfHeader.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// An image of many channels, whichever format its file has.
namespace osio::image {

/// A channel of a part.
struct Channel {
    std::string name;
    SampleType type = SampleType::Float;  ///< as stored
    bool subsampled = false;
    double scale = 1;  ///< readers deliver the stored samples times this, as floats where it is not 1

    /// How readers deliver it.
    [[nodiscard]] SampleType delivered() const { return scale == 1 ? type : SampleType::Float; }
};

/// A box of pixels, both corners inside.
struct Window {
    int min_x = 0, min_y = 0, max_x = 0, max_y = 0;

    [[nodiscard]] int width() const { return max_x - min_x + 1; }

    [[nodiscard]] int height() const { return max_y - min_y + 1; }

    friend bool operator==(const Window&, const Window&) = default;
};

/// One image of a file: its header, understood.
struct Part {
    std::string name;
    /// Carries every attribute, also those nobody here knows: OpenEXR's can hold what the others have.
    Imf::Header header;
    Window data_window;
    Window display_window;
    std::vector<Channel> channels;
    bool deep = false;
    bool tiled = false;
    std::string compression;  ///< "zip", "piz", "none", ...: OpenImageIO's words
    /// How a format stores samples that is not told by tiles and types: "bil of uint16, little-endian".
    std::string storage;
    ChannelLayout layout;
    SpectralMetadata metadata;

    [[nodiscard]] PartSummary summary() const;
};

/// Which channel each plane of a block holds; nothing for a plane that nobody reads.
using PlaneChannels = std::vector<std::optional<std::size_t>>;

/// How many rows are taken together.
enum class Grain {
    Block,  ///< as many as are worth a worker's while
    Chunk,  ///< as few as the file has together, so that damage takes no others with it
};

/// A file, headers read. Immutable: any number of threads may decode from it.
class SpectralImage {
  public:
    SpectralImage(const SpectralImage&) = delete;
    SpectralImage& operator=(const SpectralImage&) = delete;
    virtual ~SpectralImage() = default;

    [[nodiscard]] const std::string& path() const { return m_path; }

    [[nodiscard]] const std::vector<Part>& parts() const { return m_parts; }

    [[nodiscard]] std::vector<PartSummary> summaries() const;

    /// select_set() of this file, whose name the refusals say.
    [[nodiscard]] Result<Selection> select(const CollapseRequest& request) const;

    /// "OpenEXR", "ENVI".
    [[nodiscard]] virtual std::string_view format() const = 0;

    /// Channels of one part as planes of samples, as stored; the source keeps the file open. Refuses
    /// (Unsupported, Damaged) what has no such planes, or blocks beyond our limits.
    [[nodiscard]] virtual Result<std::unique_ptr<BlockSource>>
    make_block_source(std::size_t part, PlaneChannels planes, Grain grain) const = 0;

  protected:
    explicit SpectralImage(std::string path) : m_path(std::move(path)) {}

    void add(Part part) { m_parts.push_back(std::move(part)); }

  private:
    std::string m_path;
    std::vector<Part> m_parts;
};

/// A header's string attributes by name.
[[nodiscard]] TextAttributes text_attributes(const Imf::Header& header);

}  // namespace osio::image
