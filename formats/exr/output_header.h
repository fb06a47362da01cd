// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/collapse_job.h>

#include <OpenEXR/ImfHeader.h>

#include <string_view>

namespace osio::exr {

/// The header of a collapse: windows, pixel aspect, timecode and every other attribute of the part,
/// without those that describe its bands, tiles or parts; with the space's chromaticities, its
/// `oiio:ColorSpace` where one is true, and how it was made. No channels; compression zip.
[[nodiscard]] Imf::Header collapsed_header(const image::CollapseJob& job);

/// True for attributes that belong to the file's structure and are never copied as metadata.
[[nodiscard]] bool is_structural(std::string_view attribute_name);

}  // namespace osio::exr
