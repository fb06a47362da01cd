// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/text.h>

namespace osio {

/// A wavelength to 1e-9 nm, which no file means to say: 410.3 nm stays 410.3 nm after sums and changes of unit.
[[nodiscard]] inline double decimal_nm(double nm) {
    return parse_double(format_fixed(nm, 9)).value_or(nm);
}

}  // namespace osio
