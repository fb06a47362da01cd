// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/header_bytes.h>
#include <formats/exr/limits.h>

#include <algorithm>

namespace osio::exr {

namespace {

/// What most headers fit in.
constexpr std::uint64_t kFirstBytes = std::uint64_t{1} << 14;

}  // namespace

Result<RawHeaders> read_raw_headers(const files::RawFile& file, std::string& bytes) {
    for (std::uint64_t count = kFirstBytes;; count *= 4) {
        if (count > 4 * kMostHeaderBytes)
            return fail(ErrorCode::Damaged, "its headers take more than " + std::to_string(kMostHeaderBytes) +
                                                " bytes, the limit");
        OSIO_CHECK_OK(file.read(0, std::min(count, file.size()), bytes));
        OSIO_TRY(auto headers, parse_raw_headers(bytes, file.size()));
        if (headers)
            return std::move(*headers);
    }
}

}  // namespace osio::exr
