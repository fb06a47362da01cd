// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/limits.h>
#include <formats/exr/raw_header.h>

#include <string>

namespace osio::exr {

namespace {

constexpr std::size_t kMagicBytes = 4;
constexpr std::size_t kVersionBytes = 4;
constexpr std::uint64_t kMultiPartFlag = 0x1000;

/// Takes pieces from the front of some bytes. `short_of` tells the end of the bytes from nonsense.
class Cursor {
  public:
    Cursor(std::string_view bytes, std::size_t at) : m_bytes(bytes), m_at(at) {}

    [[nodiscard]] std::size_t at() const { return m_at; }

    [[nodiscard]] bool short_of() const { return m_short; }

    /// A piece of `count` bytes; empty and short_of() where there are fewer.
    std::string_view take(std::size_t count) {
        if (m_short || count > m_bytes.size() - m_at) {
            m_short = true;
            return {};
        }
        m_at += count;
        return m_bytes.substr(m_at - count, count);
    }

    /// A name up to its zero; Damaged where it is longer than our limit.
    Result<std::string_view> take_name() {
        const auto end = m_bytes.substr(0, m_at + image::kMostNameBytes + 1).find('\0', m_at);
        if (end == std::string_view::npos) {
            if (m_bytes.size() - m_at > image::kMostNameBytes)
                return fail(ErrorCode::Damaged, "the name of an attribute or of its type has more than " +
                                                    std::to_string(image::kMostNameBytes) + " bytes");
            m_short = true;
            return std::string_view();
        }
        const std::string_view name = m_bytes.substr(m_at, end - m_at);
        m_at = end + 1;
        return name;
    }

  private:
    std::string_view m_bytes;
    std::size_t m_at;
    bool m_short = false;
};

/// The attributes up to the empty name that ends a header; an empty list ends the list of headers.
Result<RawHeader> take_header(Cursor& cursor, std::uint64_t file_bytes) {
    RawHeader out;
    while (!cursor.short_of()) {
        RawAttribute attribute;
        OSIO_TRY(attribute.name, cursor.take_name());
        if (cursor.short_of() || attribute.name.empty())
            break;
        OSIO_TRY(attribute.type, cursor.take_name());
        const std::string_view size = cursor.take(4);
        if (cursor.short_of())
            break;
        const std::uint64_t bytes = little_endian(size, 0, 4);
        if (bytes > file_bytes - cursor.at() || bytes > kMostHeaderBytes)
            return fail(ErrorCode::Damaged, "attribute \"" + std::string(attribute.name) + "\" claims " +
                                                std::to_string(bytes) +
                                                " bytes, more than follow; the file is cut short or damaged");
        attribute.value_at = cursor.at();
        attribute.value = cursor.take(bytes);
        out.push_back(attribute);
    }
    return out;
}

}  // namespace

Result<std::optional<RawHeaders>> parse_raw_headers(std::string_view bytes, std::uint64_t file_bytes) {
    Cursor cursor(bytes, 0);
    cursor.take(kMagicBytes);
    RawHeaders out;
    out.version = cursor.take(kVersionBytes);
    if (!cursor.short_of()) {
        out.multi_part = (little_endian(out.version, 0, kVersionBytes) & kMultiPartFlag) != 0;
        do {
            OSIO_TRY(RawHeader header, take_header(cursor, file_bytes));
            if (header.empty())
                break;
            out.parts.push_back(std::move(header));
            if (out.parts.size() > kMostParts)
                return fail(ErrorCode::Damaged, "more than " + std::to_string(kMostParts) + " parts");
        } while (out.multi_part && !cursor.short_of());
    }
    if (cursor.short_of() && bytes.size() >= file_bytes)
        return fail(ErrorCode::Damaged, "ends inside its header; the file is cut short or damaged");
    if (cursor.short_of())
        return std::optional<RawHeaders>();
    if (out.parts.empty())
        return fail(ErrorCode::Damaged, "has a header without attributes");
    out.end = cursor.at();
    return std::optional(std::move(out));
}

}  // namespace osio::exr
