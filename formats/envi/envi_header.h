// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/envi/header_fields.h>
#include <formats/image/number_rows.h>

#include <osio/base/result.h>
#include <osio/layout/open_words.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace osio::envi {

/// How a number is stored, by ENVI's codes for `data type`; 6 and 9 are complex and refused.
enum class DataType : std::uint8_t {
    Uint8 = 1,
    Int16 = 2,
    Int32 = 3,
    Float = 4,
    Double = 5,
    Uint16 = 12,
    Uint32 = 13,
    Int64 = 14,
    Uint64 = 15,
};

[[nodiscard]] constexpr image::NumberType number_type(DataType type) {
    switch (type) {
    case DataType::Uint8: return image::NumberType::Uint8;
    case DataType::Int16: return image::NumberType::Int16;
    case DataType::Int32: return image::NumberType::Int32;
    case DataType::Float: return image::NumberType::Float;
    case DataType::Double: return image::NumberType::Double;
    case DataType::Uint16: return image::NumberType::Uint16;
    case DataType::Uint32: return image::NumberType::Uint32;
    case DataType::Int64: return image::NumberType::Int64;
    case DataType::Uint64: break;
    }
    return image::NumberType::Uint64;
}

[[nodiscard]] constexpr std::size_t data_bytes(DataType type) {
    return image::number_bytes(number_type(type));
}

/// Which index runs fastest in the data file, and which slowest.
enum class Interleave : std::uint8_t {
    Bsq,  ///< samples of a line, lines of a band, bands
    Bil,  ///< samples of a line, bands of a line, lines
    Bip,  ///< bands of a pixel, samples of a line, lines
};

/// "bsq", "bil", "bip".
[[nodiscard]] std::string_view interleave_name(Interleave interleave);
[[nodiscard]] std::optional<Interleave> find_interleave(std::string_view name);

/// A header, understood. Lists are as long as there are bands, or empty where the header has none.
struct EnviHeader {
    std::uint64_t samples = 0;  ///< pixels across
    std::uint64_t lines = 0;    ///< pixels down
    std::uint64_t bands = 0;
    std::uint64_t header_offset = 0;  ///< bytes before the first number
    DataType type = DataType::Uint8;
    Interleave interleave = Interleave::Bsq;
    bool big_endian = false;

    std::vector<double> wavelengths_nm;  ///< 0 for a band that has none
    std::vector<double> fwhm_nm;
    std::vector<bool> bad;  ///< bands that `bbl` calls bad
    Quantity quantity = Quantity::Reflectance;
    std::string units;  ///< of a radiance, in the file's words; empty where it says nothing

    std::vector<double> gain, offset;    ///< value = number * gain + offset, a band each
    double divisor = 1;                  ///< then divided by `reflectance scale factor`
    std::optional<double> ignore_value;  ///< numbers that mean there is none

    HeaderFields fields;
    std::vector<std::string> warnings;  ///< what was odd or assumed, in words

    /// Bytes from the header offset on.
    [[nodiscard]] std::uint64_t data_size() const { return samples * lines * bands * data_bytes(type); }
};

/// Understands the text of a header. Keys in any case and spelling (formats.md lists the variants). NotSpectral
/// where it is no ENVI header; Damaged where it lacks samples, lines, bands, data type or interleave, a number
/// is none, a list has not one item a band, or sizes exceed formats/image/limits.h; Unsupported for complex
/// numbers, compressed data and spectral libraries.
///
/// A map of wavelengths among the user's words takes the place of `wavelength` and `fwhm`: its steps are for all bands
/// in the file's order, a table knows them as `band.N`. Contradiction where it does not fit, or where `quantity` is
/// not what the header says.
[[nodiscard]] Result<EnviHeader> parse_header(std::string_view text, const OpenWords& words = {});

/// True for keys whose meaning EnviHeader holds, which are therefore no metadata.
[[nodiscard]] bool is_structural(std::string_view key);

}  // namespace osio::envi
