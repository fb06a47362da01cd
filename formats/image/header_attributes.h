// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/layout/dialect.h>

#include <OpenEXR/ImfHeader.h>

namespace osio::image {

/// A header's texts, and its floats and doubles as the shortest decimals that read back as the same.
[[nodiscard]] HeaderAttributes header_attributes(const Imf::Header& header);

}  // namespace osio::image
