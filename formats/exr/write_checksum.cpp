// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/checksum.h>
#include <formats/exr/header_bytes.h>
#include <formats/files/raw_file.h>

namespace osio::exr {

namespace {

/// The sums of a part's chunks, whose table starts at `table_at`.
Result<void> sum_chunks(const files::RawFile& file, bool multi_part, std::uint64_t table_at, Checksum& sum) {
    // A part's number where there are several, a row, the size.
    const std::size_t header_bytes = multi_part ? 12 : 8;
    std::string table, chunk;
    OSIO_CHECK_OK(file.read(table_at, sum.chunks.size() * 8, table));
    for (std::size_t i = 0; i < sum.chunks.size(); ++i) {
        const std::uint64_t at = little_endian(table, i * 8, 8);
        OSIO_CHECK_OK(file.read(at, header_bytes, chunk));
        OSIO_CHECK_OK(file.read(at, header_bytes + little_endian(chunk, header_bytes - 4, 4), chunk));
        sum.chunks[i] = chunk_checksum(chunk);
    }
    return {};
}

}  // namespace

Result<void> write_checksum(const std::string& path) {
    OSIO_TRY(const files::RawFile file, files::RawFile::open(path));
    std::string bytes;
    OSIO_TRY(const RawHeaders headers, read_raw_headers(file, bytes));
    std::uint64_t table_at = headers.end;
    for (const RawHeader& header : headers.parts) {
        const RawAttribute* const place = find_checksum(header);
        auto sum = place == nullptr ? std::nullopt : Checksum::parse(place->value);
        if (!sum)
            return fail(ErrorCode::Io, "was not written as it was meant: no place for the checksum");
        OSIO_CHECK_OK(sum_chunks(file, headers.multi_part, table_at, *sum));
        table_at += sum->chunks.size() * 8;
        sum->file_bytes = file.size();
        sum->header = header_checksum(headers.version, header);
        OSIO_CHECK_OK(files::overwrite(path, place->value_at, sum->bytes()));
    }
    return {};
}

}  // namespace osio::exr
