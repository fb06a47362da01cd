// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>

/// What each target defines: works on some bytes. A crash, or a law that does not hold, ends the
/// process; libFuzzer keeps the bytes, and a test replays the ones that are kept in seeds/.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count);

namespace osio::fuzz {

inline void require(bool holds) {
    if (!holds)
        std::abort();
}

}  // namespace osio::fuzz
