// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <plugins/spectralexr.imageio/preview_samples.h>

#include <formats/exr/exr_writer.h>

#include <osio/collapse/plan.h>

#include <OpenImageIO/imageio.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace osio::plugin {

/// Metadata (int, not 0) by which a host asks that close() succeeds only when the storage has every byte.
inline constexpr const char* kFsyncAttribute = "spectral:fsync";

/// Metadata (string) by which a host asks for R, G, B made of the bands: a light's name, or "none" for radiance.
inline constexpr const char* kPreviewAttribute = "spectral:preview";

/// One subimage that a host writes: its channels as they are stored, its header, and what becomes of R, G, B.
class OutputImage {
  public:
    /// Usage, Unsupported and the refusals of a preview's plan; an image without bands only where `needs_bands` is
    /// false.
    [[nodiscard]] static Result<OutputImage> create(const OIIO::ImageSpec& spec, bool needs_bands);

    /// The host's spec, with the types that are stored; rows come in these.
    [[nodiscard]] const OIIO::ImageSpec& spec() const { return m_spec; }

    [[nodiscard]] bool has_bands() const { return !m_layout.sets.empty(); }

    /// True where R, G, B came with the bands and must be compared with them before anything is written.
    [[nodiscard]] bool must_be_held() const { return m_preview.has_value(); }

    void hold(const std::byte* rows, int row_count);

    /// Leaves out R, G, B where they do not show the bands of the rows that were held; true where it did.
    bool drop_stale_preview();

    [[nodiscard]] const std::vector<std::byte>& held() const { return m_held; }

    [[nodiscard]] exr::OutputPart part() const;

    /// Where the stored channels of some rows lie, in the order of part()'s channels. A picture made of the bands
    /// lives until the next call.
    [[nodiscard]] std::vector<exr::ChannelRows> channels_of(const std::byte* rows, int row_count);

    int next_row = 0;  ///< that the host has not written yet

  private:
    explicit OutputImage(const OIIO::ImageSpec& spec) : next_row(spec.y), m_spec(spec) {}

    Result<void> name_channels(bool needs_bands);
    void choose_types();
    Result<void> plan_picture(const std::string& light);
    [[nodiscard]] Imf::Header header() const;
    [[nodiscard]] bool is_written(std::size_t channel) const;

    OIIO::ImageSpec m_spec;
    ChannelLayout m_layout;  ///< of the names that are written
    std::vector<SampleType> m_types;
    std::vector<std::ptrdiff_t> m_offsets;  ///< of each channel inside a pixel, bytes
    std::optional<PreviewChannels> m_preview;
    std::vector<PreviewSample> m_source_samples;
    bool m_stale = false;
    std::vector<std::byte> m_held;
    std::optional<CollapsePlan> m_picture;
    std::array<std::string, 3> m_picture_names;
    std::array<std::vector<float>, 3> m_picture_rows;
};

}  // namespace osio::plugin
