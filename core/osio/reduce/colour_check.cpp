// SPDX-License-Identifier: Apache-2.0
#include <osio/colour/difference.h>
#include <osio/reduce/colour_check.h>

#include <cmath>
#include <limits>

namespace osio {

namespace {

Vector3 colour_at(std::span<const float* const> planes, std::size_t pixel) {
    return {static_cast<double>(planes[0][pixel]), static_cast<double>(planes[1][pixel]),
            static_cast<double>(planes[2][pixel])};
}

bool is_colour(const Vector3& xyz) {
    return std::isfinite(xyz[0]) && std::isfinite(xyz[1]) && std::isfinite(xyz[2]);
}

}  // namespace

void colour_differences(std::span<const float* const> original, std::span<const float* const> other,
                        const Vector3& white, std::size_t count, std::span<double> out) {
    for (std::size_t i = 0; i < count; ++i) {
        const Vector3 wanted = colour_at(original, i), found = colour_at(other, i);
        if (!is_colour(wanted))
            out[i] = std::numeric_limits<double>::quiet_NaN();
        else if (!is_colour(found))
            out[i] = std::numeric_limits<double>::infinity();
        else
            out[i] = wanted == found ? 0 : delta_e_2000(lab_of(wanted, white), lab_of(found, white));
    }
}

}  // namespace osio
