// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>

#include <cstdio>
#include <cstdlib>
#include <type_traits>
#include <utility>

namespace osio::test {

/// The value, or the end of a program that cannot go on without it.
template <class T>
T must(Result<T> result) {
    if (!result) {
        std::fprintf(stderr, "%s\n", result.error().text().c_str());
        std::exit(1);
    }
    if constexpr (!std::is_void_v<T>)
        return std::move(*result);
}

}  // namespace osio::test
