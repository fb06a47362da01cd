// SPDX-License-Identifier: Apache-2.0
#include <formats/image/attribute_text.h>
#include <formats/image/band_facts.h>
#include <formats/image/limits.h>
#include <formats/tiff/attribute_items.h>
#include <formats/tiff/page_bands.h>
#include <formats/tiff/text_tags.h>
#include <formats/tiff/tiff_file.h>
#include <formats/tiff/tiff_rows.h>

#include <osio/base/text.h>
#include <osio/layout/part_layout.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <numeric>

namespace osio::tiff {

namespace {

std::string storage_of(const Page& page, std::size_t pages) {
    std::string out = pages > 1 ? std::to_string(pages) + " pages, " : "";
    out += page.samples == 1 ? "" : page.planar ? "planar " : "contiguous ";
    out += std::string(page.tiled ? "tiles" : "strips") + " of " + std::string(image::number_name(page.type));
    return image::number_bytes(page.type) == 1 ? out
                                               : out + (page.big_endian ? ", big-endian" : ", little-endian");
}

/// The map's wavelengths in the place of the file's.
Result<void> map_wavelengths(const BandMap& map, std::vector<image::BandFacts>& facts) {
    std::vector<std::string> names;
    for (std::size_t band = 1; band <= facts.size(); ++band)
        names.push_back("band." + std::to_string(band));
    OSIO_TRY(const auto places, map_bands(map, names));
    for (std::size_t band = 0; band < facts.size(); ++band) {
        facts[band].wavelength_nm = places[band] ? places[band]->wavelength_nm : 0;
        facts[band].fwhm_nm = places[band] ? places[band]->fwhm_nm.value_or(0) : 0;
    }
    return {};
}

void add_unique(const std::vector<std::string>& from, std::vector<std::string>& to) {
    for (const std::string& text : from)
        if (std::find(to.begin(), to.end(), text) == to.end())
            to.push_back(text);
}

/// The channels' names; a sample that the page calls alpha and nobody calls a band is A.
std::vector<std::string> names_of(const std::vector<image::BandFacts>& facts, Family family,
                                  const Page* page) {
    std::vector<std::string> names = image::channel_names(facts, family);
    if (page == nullptr)
        return names;
    const auto found = std::find(page->alpha.begin(), page->alpha.end(), true);
    const auto alpha = static_cast<std::size_t>(found - page->alpha.begin());
    if (alpha < names.size() && facts[alpha].wavelength_nm == 0)
        names[alpha] = "A";
    return names;
}

/// The pages that are no overviews, and what libtiff says of their directories.
Result<std::vector<Page>> read_pages(Handle& handle, std::vector<std::string>& warnings) {
    std::vector<Page> pages;
    std::size_t directories = 0;
    for (;;) {
        OSIO_TRY(const bool more, handle.next());
        for (std::string& warning : handle.take_warnings())
            if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end())
                warnings.push_back(std::move(warning));
        if (!more)
            break;
        if (++directories > image::kMostChannels)
            return fail(ErrorCode::Damaged,
                        "has more than " + std::to_string(image::kMostChannels) + " directories");
        if (is_reduced(handle))
            continue;
        OSIO_TRY(Page page, read_page(handle));
        pages.push_back(std::move(page));
    }
    return pages;
}

std::string size_text(const Page& page) {
    return std::to_string(page.width) + "x" + std::to_string(page.height);
}

/// Pages of one sample are bands of one image.
Result<void> check_stack(const std::vector<Page>& pages) {
    for (std::size_t page = 1; page < pages.size(); ++page)
        if (pages[page].width != pages[0].width || pages[page].height != pages[0].height)
            return fail(ErrorCode::Unsupported, "page 0 has " + size_text(pages[0]) + " pixels and page " +
                                                    std::to_string(page) + " has " + size_text(pages[page]) +
                                                    "; bands of one image have one size");
    return {};
}

tl::unexpected<Error> not_spectral(const std::vector<Page>& pages) {
    const Page* const most = &*std::max_element(
        pages.begin(), pages.end(), [](const Page& a, const Page& b) { return a.samples < b.samples; });
    return fail(
        ErrorCode::NotSpectral,
        "is a TIFF file of " + std::to_string(pages.size()) + (pages.size() > 1 ? " pages" : " page") +
            " with " + std::to_string(most->samples) + (most->samples > 1 ? " samples" : " sample") +
            " a pixel, none of which has a wavelength; expected GDAL metadata (tag 42112) with an "
            "item \"wavelength\" for each sample, a description such as \"450 nm\", or a page for each band "
            "whose ImageDescription names its wavelength");
}

}  // namespace

Result<void> TiffFile::add_part(const std::vector<std::size_t>& pages, const OpenWords& words) {
    const Page& first = m_pages[pages.front()];
    std::vector<Plane> planes;
    std::vector<image::BandFacts> facts;
    std::vector<std::string> warnings = m_warnings;
    std::optional<Quantity> stated;
    std::string units;
    for (const std::size_t index : pages) {
        const PageBands& bands = m_bands[index];
        for (std::size_t sample = 0; sample < bands.facts.size(); ++sample)
            planes.push_back({index, static_cast<std::uint16_t>(sample), bands.scaling[sample]});
        facts.insert(facts.end(), bands.facts.begin(), bands.facts.end());
        add_unique(bands.warnings, warnings);
        if (!stated && bands.quantity) {
            stated = bands.quantity;
            units = bands.units;
        }
        if (const image::NumberType type = m_pages[index].type; image::rounds_to_float(type))
            add_unique({image::rounding_warning(type)}, warnings);
    }
    if (words.wavelengths)
        OSIO_CHECK_OK(map_wavelengths(*words.wavelengths, facts));
    if (stated)
        OSIO_CHECK_OK(check_quantity(words.quantity, *stated, "its GDAL metadata say what the numbers are"));
    image::warn_of_unusable(facts, "bbl", warnings);
    const Family family = stated ? image::family_of(*stated) : assumed_family(words.quantity, warnings);

    image::Part part;
    part.data_window =
        part.display_window = {0, 0, static_cast<int>(first.width) - 1, static_cast<int>(first.height) - 1};
    part.header = Imf::Header(part.data_window.width(), part.data_window.height());
    part.header.compression() = Imf::NO_COMPRESSION;
    part.tiled = first.tiled;
    part.compression = first.compression;
    part.storage = storage_of(first, pages.size());
    for (const GdalItem& item : m_bands[pages.front()].others)
        insert_item(item, part.header);
    image::insert_band_attributes(facts, family, units, part.header);
    for (const auto& [name, text] : first.texts)
        if (pages.size() == 1 || (name != "ImageDescription" && name != "PageName"))
            image::insert_text(std::string(kTextPrefix) + name, text, part.header);
    image::describe_bands(names_of(facts, family, pages.size() == 1 ? &first : nullptr), warnings, part);
    add(std::move(part));
    m_planes.push_back(std::move(planes));
    return {};
}

Result<void> TiffFile::read(const OpenWords& words) {
    if (m_pages.size() > 1 &&
        std::all_of(m_pages.begin(), m_pages.end(), [](const Page& page) { return page.samples == 1; })) {
        if (!words.wavelengths && std::none_of(m_bands.begin(), m_bands.end(),
                                               [](const PageBands& page) { return page.spectral(); }))
            return not_spectral(m_pages);
        OSIO_CHECK_OK(check_stack(m_pages));
        std::vector<std::size_t> all(m_pages.size());
        std::iota(all.begin(), all.end(), std::size_t{0});
        return add_part(all, words);
    }
    std::optional<Error> denied;
    std::vector<std::size_t> chosen;
    for (std::size_t page = 0; page < m_pages.size(); ++page) {
        if (!words.wavelengths && !m_bands[page].spectral()) {
            m_warnings.push_back("page " + std::to_string(page) + " has no wavelengths and is left out");
            continue;
        }
        auto facts = m_bands[page].facts;
        auto fits = words.wavelengths ? map_wavelengths(*words.wavelengths, facts) : Result<void>();
        if (fits) {
            chosen.push_back(page);
            continue;
        }
        m_warnings.push_back("page " + std::to_string(page) + " is left out: " + fits.error().what);
        if (!denied)
            denied = fits.error();
    }
    if (chosen.empty())
        return denied ? tl::unexpected(*denied) : not_spectral(m_pages);
    for (const std::size_t page : chosen)
        OSIO_CHECK_OK(add_part({page}, words));
    return {};
}

Result<void> TiffFile::read_band(const OpenWords& words, std::optional<double> scale) {
    const Page& page = m_pages.front();
    if (m_pages.size() != 1 || page.samples != 1)
        return fail(ErrorCode::Unsupported, "has " + std::to_string(m_pages.size()) +
                                                (m_pages.size() > 1 ? " pages, " : " page, ") +
                                                std::to_string(page.samples) +
                                                (page.samples > 1 ? " samples a pixel" : " sample a pixel") +
                                                "; a file of a stack is one band");
    if (scale) {
        image::Scaling& scaling = m_bands.front().scaling.front();
        if (image::is_float(page.type) || scaling.gain != 1 || scaling.offset != 0 || scaling.divisor != 1)
            return fail(ErrorCode::Usage,
                        "holds floats or says how to scale its numbers itself; a stack's scale "
                        "is for whole numbers that nothing else scales");
        scaling.divisor = *scale;
    }
    return add_part({0}, words);
}

Result<std::shared_ptr<TiffFile>> TiffFile::open_pages(const std::string& path) {
    if (!starts_like_tiff(path))
        return fail(ErrorCode::NotSpectral, "is no TIFF file (its first bytes are not II or MM and 42 or 43)",
                    path);
    OSIO_TRY(files::RawFile data, files::RawFile::open(path));
    std::shared_ptr<TiffFile> file(
        new TiffFile(path, std::make_shared<const files::RawFile>(std::move(data))));
    const auto read_directories = [&file]() -> Result<void> {
        OSIO_TRY(const auto handle, Handle::open(file->m_data));
        OSIO_TRY(file->m_pages, read_pages(*handle, file->m_warnings));
        if (file->m_pages.empty())
            return fail(ErrorCode::Damaged, "has no page but overviews and masks");
        for (const Page& page : file->m_pages) {
            OSIO_TRY(PageBands bands, read_bands(page));
            file->m_bands.push_back(std::move(bands));
        }
        return {};
    };
    if (auto result = read_directories(); !result)
        return fail_in(path, result.error());
    return file;
}

Result<std::shared_ptr<const TiffFile>> TiffFile::open(const std::string& path, const OpenWords& words) {
    OSIO_TRY(const std::shared_ptr<TiffFile> file, open_pages(path));
    if (auto result = file->read(words); !result)
        return fail_in(path, result.error());
    return file;
}

Result<std::shared_ptr<const TiffFile>> TiffFile::open_band(const std::string& path, const OpenWords& words,
                                                            std::optional<double> scale) {
    OSIO_TRY(const std::shared_ptr<TiffFile> file, open_pages(path));
    if (auto result = file->read_band(words, scale); !result)
        return fail_in(path, result.error());
    return file;
}

Result<std::unique_ptr<BlockSource>>
TiffFile::make_block_source(std::size_t part, image::PlaneChannels planes, image::Grain grain) const {
    return make_row_source(shared_from_this(), part, std::move(planes), grain);
}

bool starts_like_tiff(const std::string& path) {
    std::array<char, 4> head{};
    std::ifstream in(path, std::ios::binary);
    in.read(head.data(), head.size());
    if (in.gcount() != static_cast<std::streamsize>(head.size()))
        return false;
    const std::string_view start(head.data(), head.size());
    using namespace std::string_view_literals;
    return start == "II*\0"sv || start == "MM\0*"sv || start == "II+\0"sv || start == "MM\0+"sv;
}

}  // namespace osio::tiff
