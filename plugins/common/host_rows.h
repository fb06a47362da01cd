// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>
#include <osio/collapse/stream.h>

#include <OpenImageIO/imageio.h>

#include <exception>

namespace osio::plugin {

/// Rows `begin` to `end`, without the end, as a host asks an input for them: checked against the image, and
/// read by `read(RowRange)`. What fails or throws becomes the input's message.
template <class Read>
bool read_host_rows(const OIIO::ImageInput& input, const OIIO::ImageSpec& spec, int begin, int end,
                    Read read) {
    if (begin < spec.y || end > spec.y + spec.height || begin >= end) {
        input.errorfmt("rows {} to {} were asked for, the image has {} to {}", begin, end - 1, spec.y,
                       spec.y + spec.height - 1);
        return false;
    }
    try {
        if (Result<void> result = read(RowRange{begin, end - 1}); !result) {
            input.errorfmt("{}", result.error().text());
            return false;
        }
    } catch (const std::exception& error) {
        input.errorfmt("{}", error.what());
        return false;
    }
    return true;
}

}  // namespace osio::plugin
