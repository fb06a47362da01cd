// SPDX-License-Identifier: Apache-2.0
#include <formats/envi/block_rows.h>
#include <formats/envi/envi_file.h>
#include <formats/files/text_file.h>
#include <formats/image/band_facts.h>
#include <formats/image/limits.h>

#include <osio/base/text.h>
#include <osio/layout/presentation.h>

#include <OpenEXR/ImfStringAttribute.h>

#include <array>
#include <fstream>
#include <sys/stat.h>

namespace osio::envi {

namespace {

/// What data files are called: the header's name without .hdr, with one of these.
constexpr std::array<std::string_view, 10> kDataEndings{"",     ".img", ".dat", ".raw", ".bsq",
                                                        ".bil", ".bip", ".sli", ".bin", ".hyspex"};

std::string to_upper(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        if (c >= 'a' && c <= 'z')
            c = static_cast<char>(c - 'a' + 'A');
    return out;
}

bool is_regular(const std::string& path) {
    struct stat status {};

    return ::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode);
}

bool is_header(const std::string& path) {
    std::array<char, 64> head{};
    std::ifstream in(path, std::ios::binary);
    in.read(head.data(), head.size());
    return starts_like_envi({head.data(), static_cast<std::size_t>(in.gcount())});
}

bool ends_in_hdr(const std::string& path) {
    return to_lower(path).ends_with(".hdr");
}

Result<std::string> choose_data(const std::string& path, EnviHeader& header) {
    const auto found = data_files_of(path);
    if (found.empty())
        return fail(ErrorCode::Damaged,
                    "there is no data file beside the header; expected its name without .hdr, "
                    "or with .img, .dat, .raw, .bsq, .bil or .bip instead");
    if (found.size() > 1)
        header.warnings.push_back(std::to_string(found.size()) +
                                  " files may hold the data: " + found.front() + " is taken");
    return found.front();
}

/// Checked before anything is read or allocated.
Result<void> check_length(const files::RawFile& data, EnviHeader& header) {
    const std::uint64_t needed = header.header_offset + header.data_size();
    if (data.size() < needed)
        return fail(ErrorCode::Damaged, "has " + std::to_string(data.size()) +
                                            " bytes, the header promises " + std::to_string(needed) +
                                            "; the file is cut short, or the header is another file's");
    if (data.size() > needed)
        header.warnings.push_back("the data file has " + std::to_string(data.size() - needed) +
                                  " bytes more than the header promises");
    return {};
}

std::vector<image::BandFacts> facts_of(const EnviHeader& header) {
    std::vector<image::BandFacts> out(header.bands);
    for (std::size_t band = 0; band < header.bands; ++band) {
        if (!header.wavelengths_nm.empty())
            out[band].wavelength_nm = header.wavelengths_nm[band];
        if (!header.fwhm_nm.empty())
            out[band].fwhm_nm = header.fwhm_nm[band];
        out[band].bad = !header.bad.empty() && header.bad[band];
    }
    return out;
}

std::string storage_of(const EnviHeader& header) {
    std::string out = std::string(interleave_name(header.interleave)) + " of " +
                      std::string(image::number_name(number_type(header.type)));
    return data_bytes(header.type) > 1 ? out + (header.big_endian ? ", big-endian" : ", little-endian") : out;
}

image::Part understand(const EnviHeader& header) {
    const image::Window window{0, 0, static_cast<int>(header.samples) - 1,
                               static_cast<int>(header.lines) - 1};
    image::Part part;
    part.header = Imf::Header(window.width(), window.height());
    part.header.compression() = Imf::NO_COMPRESSION;
    part.data_window = part.display_window = window;
    part.compression = "none";
    part.storage = storage_of(header);
    const auto facts = facts_of(header);
    const Family family = image::family_of(header.quantity);
    image::insert_band_attributes(facts, family, header.units, part.header);
    for (const Field& field : header.fields.fields)
        if (!is_structural(field.key))
            insert_field(field, part.header);
    std::vector<std::string> warnings = header.warnings;
    if (image::rounds_to_float(number_type(header.type)))
        warnings.push_back(image::rounding_warning(number_type(header.type)));
    image::describe_bands(image::channel_names(facts, family), warnings, part);
    return part;
}

}  // namespace

std::vector<std::string> data_files_of(const std::string& header) {
    const std::string base = ends_in_hdr(header) ? header.substr(0, header.size() - 4) : header;
    std::vector<std::string> out;
    for (const std::string_view ending : kDataEndings)
        for (const std::string& spelt : {std::string(ending), to_upper(ending)}) {
            const std::string path = base + spelt;
            if (path != header && is_regular(path) && (out.empty() || out.back() != path))
                out.push_back(path);
        }
    return out;
}

Result<std::shared_ptr<const EnviFile>> EnviFile::open(const std::string& path, const OpenWords& words) {
    const std::string header_path = find_header(path).value_or(path);
    OSIO_TRY(const std::string text, files::read_text(header_path));
    auto header = parse_header(text, words);
    if (!header)
        return fail_within(header_path, header.error());
    auto data_path = choose_data(header_path, *header);
    if (!data_path)
        return fail_in(header_path, data_path.error());
    OSIO_TRY(files::RawFile data, files::RawFile::open(*data_path));
    if (auto result = check_length(data, *header); !result)
        return fail_in(*data_path, result.error());
    image::Part part = understand(*header);
    const std::shared_ptr<EnviFile> file(
        new EnviFile(header_path, std::move(*data_path), std::move(*header), std::move(data)));
    file->add(std::move(part));
    return file;
}

Result<std::unique_ptr<BlockSource>> EnviFile::make_block_source(std::size_t, image::PlaneChannels planes,
                                                                 image::Grain grain) const {
    return make_row_source(shared_from_this(), std::move(planes), grain);
}

std::optional<std::string> find_header(const std::string& path) {
    if (is_header(path))
        return path;
    const auto dot = path.find_last_of("./");
    const bool named = dot != std::string::npos && path[dot] == '.';
    for (const std::string& base : {path, named ? path.substr(0, dot) : path})
        for (const std::string_view ending : {".hdr", ".HDR"}) {
            const std::string beside = base + std::string(ending);
            if (is_regular(path) && beside != path && is_header(beside))
                return beside;
        }
    return std::nullopt;
}

}  // namespace osio::envi
