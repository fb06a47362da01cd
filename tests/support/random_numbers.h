// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>

namespace osio::test {

/// Of a test program's own sequence, the same in every run.
inline double uniform(double from, double to) {
    static std::mt19937_64 random(20261128);
    return std::uniform_real_distribution<double>(from, to)(random);
}

}  // namespace osio::test
