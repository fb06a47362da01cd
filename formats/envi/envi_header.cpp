// SPDX-License-Identifier: Apache-2.0
#include <formats/envi/envi_header.h>
#include <formats/envi/spectral_keys.h>
#include <formats/image/limits.h>

#include <osio/base/text.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

namespace osio::envi {

namespace {

constexpr std::array<DataType, 9> kTypes{DataType::Uint8,  DataType::Int16,  DataType::Int32,
                                         DataType::Float,  DataType::Double, DataType::Uint16,
                                         DataType::Uint32, DataType::Int64,  DataType::Uint64};

constexpr std::array<std::string_view, 3> kInterleaves{"bsq", "bil", "bip"};

/// Keys that are no metadata: their meaning is in EnviHeader, and a writer gives them its own values.
constexpr std::array<std::string_view, 16> kStructural{"samples",
                                                       "lines",
                                                       "bands",
                                                       "header offset",
                                                       "data type",
                                                       "interleave",
                                                       "byte order",
                                                       "wavelength",
                                                       "wavelengths",
                                                       "wavelength units",
                                                       "fwhm",
                                                       "bbl",
                                                       "reflectance scale factor",
                                                       "data gain values",
                                                       "data offset values",
                                                       "data ignore value"};

std::optional<std::uint64_t> parse_count(std::string_view text) {
    std::uint64_t value = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    return code == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

/// Reads the numbers of a header one key at a time.
class Structure {
  public:
    explicit Structure(EnviHeader& out) : m_out(out) {}

    [[nodiscard]] Result<void> read() {
        OSIO_TRY(m_out.samples, count("samples"));
        OSIO_TRY(m_out.lines, count("lines"));
        OSIO_TRY(m_out.bands, count("bands"));
        OSIO_TRY(m_out.header_offset, count_or("header offset", 0));
        OSIO_CHECK_OK(read_type());
        OSIO_CHECK_OK(read_order());
        OSIO_CHECK_OK(refuse_what_is_no_image());
        OSIO_CHECK_OK(check_sizes());
        return read_scaling();
    }

  private:
    [[nodiscard]] const Field* find(std::string_view key) const { return m_out.fields.find(key); }

    static tl::unexpected<Error> odd(const Field& field, std::string_view expected) {
        return fail(ErrorCode::Damaged, "found \"" + field.label + " = " + field.value.substr(0, 40) +
                                            "\", expected " + std::string(expected));
    }

    [[nodiscard]] Result<const Field*> needed(std::string_view key) const {
        const Field* const field = find(key);
        if (field == nullptr)
            return fail(ErrorCode::Damaged, "the header lacks \"" + std::string(key) + "\"");
        return field;
    }

    [[nodiscard]] Result<std::uint64_t> count(std::string_view key) const {
        OSIO_TRY(const Field* const field, needed(key));
        const auto value = parse_count(trim(field->value));
        if (!value || *value == 0)
            return odd(*field, "a count of 1 or more");
        return *value;
    }

    [[nodiscard]] Result<std::uint64_t> count_or(std::string_view key, std::uint64_t otherwise) const {
        const Field* const field = find(key);
        if (field == nullptr)
            return otherwise;
        const auto value = parse_count(trim(field->value));
        if (!value)
            return odd(*field, "a count");
        return *value;
    }

    [[nodiscard]] Result<void> read_type() {
        OSIO_TRY(const Field* const field, needed("data type"));
        const auto code = parse_count(trim(field->value));
        if (code == 6 || code == 9)
            return fail(ErrorCode::Unsupported,
                        "data type " + std::to_string(*code) + " is complex numbers; bands are real ones");
        for (const DataType type : kTypes)
            if (code == static_cast<std::uint64_t>(type)) {
                m_out.type = type;
                return {};
            }
        return odd(*field, "1, 2, 3, 4, 5, 12, 13, 14 or 15");
    }

    [[nodiscard]] Result<void> read_order() {
        OSIO_TRY(const Field* const field, needed("interleave"));
        const auto interleave = find_interleave(trim(field->value));
        if (!interleave)
            return odd(*field, "bsq, bil or bip");
        m_out.interleave = *interleave;
        OSIO_TRY(const std::uint64_t order, count_or("byte order", 0));
        if (order > 1)
            return odd(*find("byte order"), "0 (little-endian) or 1 (big-endian)");
        m_out.big_endian = order == 1;
        return {};
    }

    [[nodiscard]] Result<void> refuse_what_is_no_image() const {
        if (const Field* const type = find("file type"))
            if (to_lower(type->value).find("library") != std::string::npos)
                return fail(ErrorCode::Unsupported, "is a spectral library; expected an image");
        OSIO_TRY(const std::uint64_t compressed, count_or("file compression", 0));
        if (compressed != 0)
            return fail(ErrorCode::Unsupported, "its data file is compressed; unpack it and remove "
                                                "\"file compression\" from the header");
        for (const std::string_view key : {"major frame offsets", "minor frame offsets"})
            if (const Field* const field = find(key))
                for (const std::string_view item : list_items(field->value))
                    if (item != "0")
                        return fail(ErrorCode::Unsupported,
                                    "\"" + field->label + "\" puts bytes between frames, which is not read");
        return {};
    }

    /// Everything is counted in 64 bits without overflow before anything is allocated.
    [[nodiscard]] Result<void> check_sizes() const {
        constexpr auto kMostSide = static_cast<std::uint64_t>(image::kMostSidePixels);
        const auto too_much = [](std::string_view what, std::uint64_t found, std::uint64_t most) {
            return fail(ErrorCode::Damaged, "the header promises " + std::to_string(found) + " " +
                                                std::string(what) + ", more than the limit of " +
                                                std::to_string(most));
        };
        if (m_out.samples > kMostSide)
            return too_much("samples", m_out.samples, kMostSide);
        if (m_out.lines > kMostSide)
            return too_much("lines", m_out.lines, kMostSide);
        if (m_out.bands > image::kMostChannels)
            return too_much("bands", m_out.bands, image::kMostChannels);
        const std::uint64_t pixel_bytes = m_out.bands * data_bytes(m_out.type);
        if (m_out.samples * m_out.lines > image::kMostPartBytes / pixel_bytes)
            return too_much("pixels", m_out.samples * m_out.lines, image::kMostPartBytes / pixel_bytes);
        if (m_out.header_offset > image::kMostPartBytes)
            return too_much("bytes before the data", m_out.header_offset, image::kMostPartBytes);
        return {};
    }

    [[nodiscard]] Result<void> read_scaling() {
        OSIO_TRY(m_out.gain, numbers_by_band(m_out, "data gain values"));
        OSIO_TRY(m_out.offset, numbers_by_band(m_out, "data offset values"));
        if (const Field* const field = find("reflectance scale factor")) {
            const auto value = parse_double(trim(field->value));
            if (!value || *value <= 0)
                return odd(*field, "a number above 0");
            m_out.divisor = *value;
        }
        if (const Field* const field = find("data ignore value")) {
            m_out.ignore_value = parse_double(trim(field->value));
            m_out.warnings.push_back(
                m_out.ignore_value
                    ? "numbers equal to the \"data ignore value\" " + field->value + " are NaN"
                    : "\"data ignore value\" is \"" + field->value + "\", no number: not used");
        }
        for (const std::string_view key : {"data reflectance gain values", "data reflectance offset values"})
            if (find(key) != nullptr)
                m_out.warnings.push_back("\"" + std::string(key) + "\" are not applied");
        return {};
    }

    EnviHeader& m_out;
};

}  // namespace

std::string_view interleave_name(Interleave interleave) {
    return kInterleaves[static_cast<std::size_t>(interleave)];
}

std::optional<Interleave> find_interleave(std::string_view name) {
    for (std::size_t i = 0; i < kInterleaves.size(); ++i)
        if (iequals(kInterleaves[i], name))
            return static_cast<Interleave>(i);
    return std::nullopt;
}

Result<EnviHeader> parse_header(std::string_view text, const OpenWords& words) {
    EnviHeader out;
    OSIO_TRY(out.fields, parse_fields(text));
    out.warnings = out.fields.warnings;
    OSIO_CHECK_OK(Structure(out).read());
    OSIO_CHECK_OK(read_spectral_keys(out, words));
    return out;
}

bool is_structural(std::string_view key) {
    return std::find(kStructural.begin(), kStructural.end(), key) != kStructural.end();
}

}  // namespace osio::envi
