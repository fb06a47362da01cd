// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/collapse/preview.h>
#include <osio/collapse/stream.h>
#include <osio/layout/channel_layout.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace osio::plugin {

/// Metadata by which our reader tells our writer where R, G, B and bands came from together.
inline constexpr const char* kSourceAttribute = "spectral:source";
inline constexpr const char* kSourcePartAttribute = "spectral:source_part";

/// The channels that a preview check compares: R, G, B without a root and the bands beside them.
struct PreviewChannels {
    SpectralSet set;
    std::array<std::size_t, 3> rgb{};

    /// Nothing where a layout lacks R, G, B or bands, both without a root.
    [[nodiscard]] static std::optional<PreviewChannels> find(const ChannelLayout& layout);
};

/// Samples on a grid over pixels in memory; the block's planes are all channels of the file.
[[nodiscard]] std::vector<PreviewSample> preview_samples(const PreviewChannels& channels,
                                                         const PlanarBlock& block);

/// Samples from a few blocks of a file's part; empty where it cannot be read or lacks a preview.
[[nodiscard]] std::vector<PreviewSample> preview_samples_of_file(const std::string& path, std::size_t part);

}  // namespace osio::plugin
