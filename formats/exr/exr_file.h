// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>
#include <osio/collapse/band_view.h>
#include <osio/collapse/selection.h>
#include <osio/layout/channel_layout.h>
#include <osio/layout/spectral_metadata.h>

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfPixelType.h>
#include <OpenEXR/openexr_context.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace osio::exr {

class ChunkMap;

/// A channel as its part stores it. Channels are in the order of their names, as in the file.
struct ExrChannel {
    std::string name;
    SampleType type = SampleType::Float;
    bool subsampled = false;
};

/// A box of pixels, both corners inside.
struct Window {
    int min_x = 0, min_y = 0, max_x = 0, max_y = 0;

    [[nodiscard]] int width() const { return max_x - min_x + 1; }

    [[nodiscard]] int height() const { return max_y - min_y + 1; }

    friend bool operator==(const Window&, const Window&) = default;
};

/// One part of a file: its header, understood.
struct ExrPart {
    std::string name;
    Imf::Header header;  ///< carries every attribute, also those nobody here knows
    Window data_window;
    Window display_window;
    std::vector<ExrChannel> channels;
    bool deep = false;
    bool tiled = false;
    ChannelLayout layout;
    SpectralMetadata metadata;

    /// "zip", "piz", ...: OpenImageIO's words.
    [[nodiscard]] std::string compression() const;
    [[nodiscard]] PartSummary summary() const;
};

/// An OpenEXR file, headers read. Immutable: any number of threads may decode from it.
class ExrFile {
  public:
    /// Io where the system refuses, NotSpectral where it is no OpenEXR file, Damaged where headers
    /// contradict themselves, the file's length or our limits.
    [[nodiscard]] static Result<std::shared_ptr<const ExrFile>> open(const std::string& path);

    ExrFile(const ExrFile&) = delete;
    ExrFile& operator=(const ExrFile&) = delete;
    ~ExrFile();

    [[nodiscard]] const std::string& path() const { return m_path; }

    [[nodiscard]] const std::vector<ExrPart>& parts() const { return m_parts; }

    [[nodiscard]] std::vector<PartSummary> summaries() const;

    /// Where the chunks lie, and their checksums where the file has some.
    [[nodiscard]] const ChunkMap& chunks() const { return *m_chunks; }

    /// For OpenEXRCore's functions; null where Core cannot read the file and the C++ API can.
    [[nodiscard]] exr_const_context_t context() const { return m_context; }

  private:
    explicit ExrFile(std::string path) : m_path(std::move(path)) {}

    [[nodiscard]] Result<void> check_chunks(std::uint64_t file_bytes) const;
    [[nodiscard]] Result<void> read_headers(std::uint64_t file_bytes);
    [[nodiscard]] std::vector<std::uint64_t> chunk_counts() const;

    std::string m_path;
    exr_context_t m_context = nullptr;
    std::vector<ExrPart> m_parts;
    std::shared_ptr<const ChunkMap> m_chunks;
};

/// True where the file exists and starts with OpenEXR's magic number. Never an error.
[[nodiscard]] bool starts_like_exr(const std::string& path);

/// The last message of OpenEXRCore on this thread, as an Error; the message is then forgotten.
[[nodiscard]] tl::unexpected<Error> core_failure(exr_result_t code, const std::string& path);

/// The word for a compression, and the compression for a word (case ignored).
[[nodiscard]] std::string compression_name(Imf::Compression compression);
[[nodiscard]] Result<Imf::Compression> find_compression(std::string_view name);

/// OpenEXR's word for a sample's type.
[[nodiscard]] Imf::PixelType pixel_type(SampleType type);

/// The version of the OpenEXR library that is running, such as "3.1.5".
[[nodiscard]] std::string library_version();

}  // namespace osio::exr
