// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/chunk_geometry.h>
#include <formats/exr/chunk_map.h>

#include <algorithm>

namespace osio::exr {

namespace {

constexpr std::size_t kOffsetBytes = 8;
constexpr std::size_t kNumberBytes = 4;

tl::unexpected<Error> damaged(std::string what) {
    return fail(ErrorCode::Damaged, std::move(what));
}

std::int32_t signed_number(std::string_view bytes, std::size_t at) {
    return static_cast<std::int32_t>(little_endian(bytes, at, kNumberBytes));
}

/// A number of a chunk's header that must be what its place in the table implies.
Result<void> expect(std::string_view what, std::int64_t found, std::int64_t expected) {
    if (found == expected)
        return {};
    return damaged("its header says " + std::string(what) + " " + std::to_string(found) + ", expected " +
                   std::to_string(expected));
}

}  // namespace

Result<std::shared_ptr<const ChunkMap>> ChunkMap::load(files::RawFile file, const RawHeaders& headers,
                                                       const std::vector<image::Part>& parts,
                                                       const std::vector<std::uint64_t>& counts) {
    const std::shared_ptr<ChunkMap> map(new ChunkMap(std::move(file)));
    map->m_multi_part = headers.multi_part;
    if (headers.parts.size() != parts.size())
        return damaged("has " + std::to_string(headers.parts.size()) + " headers, of which " +
                       std::to_string(parts.size()) + " can be read");
    OSIO_CHECK_OK(map->read_tables(headers.end, parts, counts));
    OSIO_CHECK_OK(map->adopt_checksum(headers));
    return map;
}

Result<void> ChunkMap::read_tables(std::uint64_t at, const std::vector<image::Part>& parts,
                                   const std::vector<std::uint64_t>& counts) {
    std::string bytes;
    for (std::size_t index = 0; index < parts.size(); ++index) {
        const image::Part& header = parts[index];
        Part part;
        part.tiled = header.tiled;
        part.min_y = header.data_window.min_y;
        part.max_y = header.data_window.max_y;
        part.full = header.deep ? 0 : full_resolution_chunks(header);
        if (header.deep ? false : header.tiled ? counts[index] < part.full : counts[index] != part.full)
            return damaged("the header speaks of " + std::to_string(counts[index]) +
                           " chunks, its window of " + std::to_string(part.full));
        const ChunkSize size = chunk_size(header);
        const auto width = static_cast<std::uint64_t>(header.data_window.width());
        const auto height = static_cast<std::uint64_t>(header.data_window.height());
        part.lines = static_cast<std::int64_t>(size.height);
        part.columns = header.tiled ? (width + size.width - 1) / size.width : 1;
        part.most_bytes = sample_bytes_of(header, std::min(width, size.width), std::min(height, size.height));
        if (counts[index] > m_file.size() / kOffsetBytes)
            return damaged("has a table of " + std::to_string(counts[index]) +
                           " chunks, more than the file can hold; it is cut short or damaged");
        OSIO_CHECK_OK(m_file.read(at, counts[index] * kOffsetBytes, bytes));
        at += bytes.size();
        for (std::size_t i = 0; i < bytes.size(); i += kOffsetBytes)
            part.offsets.push_back(little_endian(bytes, i, kOffsetBytes));
        m_sorted.insert(m_sorted.end(), part.offsets.begin(), part.offsets.end());
        m_parts.push_back(std::move(part));
    }
    m_pixels_at = at;
    m_sorted.push_back(m_file.size());
    std::sort(m_sorted.begin(), m_sorted.end());
    return {};
}

Result<void> ChunkMap::adopt_checksum(const RawHeaders& headers) {
    for (std::size_t index = 0; index < m_parts.size(); ++index) {
        const RawAttribute* const found = find_checksum(headers.parts[index]);
        const auto sum = found == nullptr ? std::nullopt : Checksum::parse(found->value);
        if (!sum) {
            m_sum = m_sum == Sum::Own ? Sum::Foreign : m_sum;
            return {};
        }
        // Whoever writes a file again, attributes and all, changes its length; damage in place does not.
        if (sum->file_bytes != m_file.size()) {
            m_sum = Sum::Foreign;
            return {};
        }
        if (sum->chunks.size() != m_parts[index].offsets.size() ||
            sum->header != header_checksum(headers.version, headers.parts[index]))
            return damaged("its header does not have the checksum that was written with it; an attribute was "
                           "changed or damaged");
        m_sum = Sum::Own;
        m_parts[index].sums = sum->chunks;
    }
    return {};
}

std::size_t ChunkMap::chunk_header_bytes(const Part& part) const {
    // Part number where there are several; row, or tile and level in two directions each; size.
    return (m_multi_part ? kNumberBytes : 0) + (part.tiled ? 4 : 1) * kNumberBytes + kNumberBytes;
}

Result<void> ChunkMap::check_header(std::size_t index, std::uint64_t chunk, std::string_view header) const {
    const Part& part = m_parts[index];
    std::size_t at = 0;
    const auto next = [&] {
        at += kNumberBytes;
        return std::int64_t{signed_number(header, at - kNumberBytes)};
    };
    if (m_multi_part)
        OSIO_CHECK_OK(expect("part", next(), static_cast<std::int64_t>(index)));
    const auto place = static_cast<std::int64_t>(chunk);
    if (!part.tiled)
        return expect("row", next(), part.min_y + place * part.lines);
    const auto columns = static_cast<std::int64_t>(part.columns);
    OSIO_CHECK_OK(expect("tile across", next(), place % columns));
    OSIO_CHECK_OK(expect("tile down", next(), place / columns));
    OSIO_CHECK_OK(expect("level", next(), 0));
    return expect("level", next(), 0);
}

Result<void> ChunkMap::check(std::size_t index, std::uint64_t chunk, std::string& scratch) const {
    const Part& part = m_parts[index];
    const std::uint64_t offset = part.offsets[chunk];
    if (offset == 0)
        return damaged("was never written; the file is incomplete");
    const std::size_t header_bytes = chunk_header_bytes(part);
    if (offset < m_pixels_at || offset > m_file.size() || m_file.size() - offset < header_bytes)
        return damaged("is said to lie at " + std::to_string(offset) + ", outside the file's pixels (" +
                       std::to_string(m_pixels_at) + " to " + std::to_string(m_file.size()) + ")");
    OSIO_CHECK_OK(m_file.read(offset, header_bytes, scratch));
    OSIO_CHECK_OK(check_header(index, chunk, scratch));
    const std::uint64_t bytes = little_endian(scratch, header_bytes - kNumberBytes, kNumberBytes);
    if (bytes == 0 || bytes > part.most_bytes)
        return damaged("has " + std::to_string(bytes) + " bytes, expected 1 to " +
                       std::to_string(part.most_bytes));
    const auto after = std::upper_bound(m_sorted.begin(), m_sorted.end(), offset);
    const bool shared = std::count(std::lower_bound(m_sorted.begin(), after, offset), after, offset) > 1;
    if (shared || *after - offset < header_bytes + bytes)
        return damaged(m_file.size() - offset < header_bytes + bytes ? "goes on beyond the end of the file"
                                                                     : "shares bytes with another chunk");
    if (m_sum != Sum::Own)
        return {};
    OSIO_CHECK_OK(m_file.read(offset, header_bytes + bytes, scratch));
    if (chunk_checksum(scratch) != part.sums[chunk])
        return damaged("does not have the checksum that was written with it");
    return {};
}

ChunkMap::Range ChunkMap::chunks_of_rows(std::size_t index, int first, int last) const {
    const Part& part = m_parts[index];
    const auto begin = static_cast<std::uint64_t>((first - part.min_y) / part.lines);
    const auto end = static_cast<std::uint64_t>((last - part.min_y) / part.lines) + 1;
    return {begin * part.columns, end * part.columns};
}

}  // namespace osio::exr
