// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/checksum.h>
#include <formats/exr/header_bytes.h>
#include <formats/exr/raw_file.h>

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace osio::exr {

namespace {

/// A row, then the size.
constexpr std::size_t kChunkHeaderBytes = 8;

tl::unexpected<Error> not_written() {
    return fail(ErrorCode::Io, std::string("cannot be written: ") + std::strerror(errno));
}

Result<void> overwrite(const std::string& path, std::uint64_t at, std::string_view bytes) {
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0)
        return not_written();
    Result<void> result;
    while (result && !bytes.empty()) {
        const ssize_t count = ::pwrite(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(at));
        if (count < 0 && errno != EINTR)
            result = not_written();
        if (count > 0) {
            at += static_cast<std::uint64_t>(count);
            bytes.remove_prefix(static_cast<std::size_t>(count));
        }
    }
    if (::close(descriptor) != 0 && result)
        return not_written();
    return result;
}

}  // namespace

Result<void> write_checksum(const std::string& path) {
    OSIO_TRY(const RawFile file, RawFile::open(path));
    std::string bytes;
    OSIO_TRY(const RawHeaders headers, read_raw_headers(file, bytes));
    const RawAttribute* const place = find_checksum(headers.parts[0]);
    auto sum = place == nullptr ? std::nullopt : Checksum::parse(place->value);
    if (!sum)
        return fail(ErrorCode::Io, "was not written as it was meant: no place for the checksum");
    std::string table, chunk;
    OSIO_CHECK_OK(file.read(headers.end, sum->chunks.size() * 8, table));
    for (std::size_t i = 0; i < sum->chunks.size(); ++i) {
        const std::uint64_t at = little_endian(table, i * 8, 8);
        OSIO_CHECK_OK(file.read(at, kChunkHeaderBytes, chunk));
        OSIO_CHECK_OK(file.read(at, kChunkHeaderBytes + little_endian(chunk, 4, 4), chunk));
        sum->chunks[i] = chunk_checksum(chunk);
    }
    sum->file_bytes = file.size();
    sum->header = header_checksum(headers.version, headers.parts[0]);
    return overwrite(path, place->value_at, sum->bytes());
}

}  // namespace osio::exr
