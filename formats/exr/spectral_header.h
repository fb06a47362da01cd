// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/layout/channel_layout.h>

#include <OpenEXR/ImfHeader.h>

namespace osio::exr {

/// Makes a header one of the spectral layout for the channels of `layout`, which carry their written
/// names: the layout's version always, units of what is emitted and handedness of what is polarised
/// where the header does not say them. Curves (sensitivities, lensTransmission, cameraResponse) are spelt as
/// format_spectrum_text() does, but for those with pieces that are no samples, which stay as they are. Sensitivities are attributes named like their band: they follow
/// the band to its written name, and go where it is not written.
void complete_spectral_header(const ChannelLayout& layout, Imf::Header& header);

}  // namespace osio::exr
