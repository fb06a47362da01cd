// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tl/expected.hpp>

#include <string>
#include <string_view>
#include <utility>

namespace osio {

/// What went wrong, at the grain at which a caller acts differently.
enum class ErrorCode {
    Usage,                 ///< the request contradicts itself or cannot be parsed
    UnknownName,           ///< a name that no table, space or option has
    NoSuchPart,            ///< the part or set asked for is not in the file
    Ambiguous,             ///< several parts or sets fit and none was named
    MissingIlluminant,     ///< a reflectance cannot be seen without a light
    UnexpectedIlluminant,  ///< a radiance already holds its light
    BandsOutsideObserver,  ///< no band near 360-830 nm
    InvalidGrid,           ///< wavelengths that define no curve
    Unsupported,           ///< deep or sub-sampled bands
    NotCertified,          ///< the error of a result cannot be shown to be as small as was asked for
    Contradiction,         ///< words say of the file what its names or its header deny
    NotSpectral,           ///< a sound file without spectral bands
    Damaged,               ///< a file that contradicts itself or is cut short
    Io,                    ///< the operating system refused
    Cancelled,             ///< the user interrupted
};

/// A failure in words: what was found, what was expected, what to do.
/// `where` is a file, channel, attribute or `line N`; empty when it is obvious.
struct Error {
    ErrorCode code;
    std::string what;
    std::string where;

    /// `where: what`, or `what` alone.
    [[nodiscard]] std::string text() const { return where.empty() ? what : where + ": " + what; }
};

/// A value or an Error, in the shape of C++23's std::expected.
template <class T>
using Result = tl::expected<T, Error>;

/// The failing side of a Result.
[[nodiscard]] inline tl::unexpected<Error> fail(ErrorCode code, std::string what, std::string where = {}) {
    return tl::unexpected<Error>(Error{code, std::move(what), std::move(where)});
}

/// The same failure; where it does not say where it was, it was in `where`.
[[nodiscard]] inline tl::unexpected<Error> fail_in(std::string_view where, Error error) {
    if (error.where.empty())
        error.where = where;
    return tl::unexpected<Error>(std::move(error));
}

/// The same failure, seen from further out: `where` becomes `outer: where`.
[[nodiscard]] inline tl::unexpected<Error> fail_within(std::string_view outer, Error error) {
    error.where = error.where.empty() ? std::string(outer) : std::string(outer) + ": " + error.where;
    return tl::unexpected<Error>(std::move(error));
}

}  // namespace osio

#define OSIO_JOIN_IMPL(a, b) a##b
#define OSIO_JOIN(a, b) OSIO_JOIN_IMPL(a, b)

/// `OSIO_TRY(auto x, expression)`: x is the value, or the enclosing function returns the error.
#define OSIO_TRY(declaration, expression)                                            \
    auto OSIO_JOIN(osio_result_, __LINE__) = (expression);                           \
    if (!OSIO_JOIN(osio_result_, __LINE__))                                          \
        return tl::unexpected(std::move(OSIO_JOIN(osio_result_, __LINE__)).error()); \
    declaration = std::move(*OSIO_JOIN(osio_result_, __LINE__))

/// `OSIO_CHECK_OK(expression)`: the enclosing function returns the error of a Result<void>.
#define OSIO_CHECK_OK(expression)                                                            \
    do {                                                                                     \
        auto&& osio_status = (expression);                                                   \
        if (!osio_status)                                                                    \
            return tl::unexpected(std::forward<decltype(osio_status)>(osio_status).error()); \
    } while (false)
