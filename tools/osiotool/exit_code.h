// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>

namespace osio::tool {

/// What the process tells its caller; documented in docs/cli.md.
enum ExitCode : int {
    kDone = 0,
    kDoesNotFit = 1,    ///< the request does not fit the file
    kUsage = 2,         ///< a word or a combination of words that means nothing
    kNotCertified = 3,  ///< the result's error cannot be shown to be as small as was asked for
    kBadInput = 4,      ///< damaged, or not spectral
    kSystem = 5,        ///< the operating system refused to read or write
    kInterrupted = 130,
};

[[nodiscard]] constexpr ExitCode exit_code(ErrorCode code) {
    switch (code) {
    case ErrorCode::Usage:
    case ErrorCode::UnknownName: return kUsage;
    case ErrorCode::NoSuchPart:
    case ErrorCode::Ambiguous:
    case ErrorCode::MissingIlluminant:
    case ErrorCode::UnexpectedIlluminant:
    case ErrorCode::BandsOutsideObserver:
    case ErrorCode::InvalidGrid:
    case ErrorCode::Unsupported:
    case ErrorCode::Contradiction: return kDoesNotFit;
    case ErrorCode::NotCertified: return kNotCertified;
    case ErrorCode::NotSpectral:
    case ErrorCode::Damaged: return kBadInput;
    case ErrorCode::Io: return kSystem;
    case ErrorCode::Cancelled: return kInterrupted;
    }
    return kUsage;
}

}  // namespace osio::tool
