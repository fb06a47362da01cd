// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/layout/channel_layout.h>

#include <cstddef>
#include <string>
#include <vector>

namespace osio {

/// How bands are called when they are shown to a host as channels.
enum class BandNames {
    CommaFree,  ///< T.450.5nm: hosts split lists of channel names at commas
    AsStored,   ///< the file's own names
};

/// A channel as a host sees it.
struct PresentedChannel {
    std::size_t channel = 0;  ///< index into ChannelLayout::channel_names
    std::string name;
};

/// All channels in the order in which hosts expect them: R, G, B, A first, then the bands set by set
/// in order of wavelength, then all else as it was. Names are distinct where the file's are.
[[nodiscard]] std::vector<PresentedChannel> present_channels(const ChannelLayout& layout, BandNames names);

/// The names under which a layout's channels are written, by channel: bands in the spectral EXR layout's
/// spelling in nanometres, whatever the file calls them, others as they are. Bands of one wavelength keep
/// distinct names as in layout_names().
[[nodiscard]] std::vector<std::string> written_names(const ChannelLayout& layout);

/// The names under which a host's channels are written: bands in the layout's spelling in nanometres, others
/// as they are. A name is read with a comma or a point as its decimal mark. Bands of one wavelength
/// keep distinct names by further zeros behind the comma, which mean the same wavelength.
[[nodiscard]] std::vector<std::string> layout_names(std::span<const std::string> names);

}  // namespace osio
