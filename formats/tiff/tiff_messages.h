// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <tiffio.h>
#include <vector>

namespace osio::tiff {

/// What libtiff says through one handle, kept where it is said: nothing is printed and nothing global is touched.
struct Messages {
    std::string error;                  ///< the first
    std::vector<std::string> warnings;  ///< but those of tags that libtiff does not know

    /// Opens through calls of one's own, whose first argument is `client`; null where libtiff refuses. `this`
    /// outlives the handle.
    [[nodiscard]] TIFF* open(const char* mode, void* client, TIFFReadWriteProc read, TIFFReadWriteProc write,
                             TIFFSeekProc seek, TIFFSizeProc size);
};

}  // namespace osio::tiff
