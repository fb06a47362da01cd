// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/checksum.h>
#include <formats/exr/header_bytes.h>
#include <formats/files/raw_file.h>

#include <algorithm>

namespace osio::exr {

namespace {

bool is_tiled(const RawHeader& header) {
    return std::any_of(header.begin(), header.end(),
                       [](const RawAttribute& attribute) { return attribute.name == "tiles"; });
}

/// The sums of a part's chunks, whose table starts at `table_at` and whose own headers have `header_bytes`.
Result<void> sum_chunks(const files::RawFile& file, std::size_t header_bytes, std::uint64_t table_at,
                        Checksum& sum) {
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
        // A part's number where there are several; a row, or a tile's place and level; the size.
        const std::size_t header_bytes = (headers.multi_part ? 4U : 0U) + (is_tiled(header) ? 16U : 4U) + 4U;
        OSIO_CHECK_OK(sum_chunks(file, header_bytes, table_at, *sum));
        table_at += sum->chunks.size() * 8;
        sum->file_bytes = file.size();
        sum->header = header_checksum(headers.version, header);
        OSIO_CHECK_OK(files::overwrite(path, place->value_at, sum->bytes()));
    }
    return {};
}

}  // namespace osio::exr
