// SPDX-License-Identifier: Apache-2.0
#include <formats/convert/joined_rows.h>
#include <formats/envi/envi_file.h>
#include <formats/exr/exr_file.h>
#include <formats/files/text_file.h>
#include <formats/image/band_facts.h>
#include <formats/stack/png_file.h>
#include <formats/stack/stack.h>
#include <formats/tiff/tiff_file.h>

#include <osio/base/text.h>
#include <osio/layout/part_layout.h>
#include <osio/spectra/wavelength_unit.h>

#include <algorithm>
#include <array>
#include <fstream>

namespace osio::stack {

namespace {

using Member = std::shared_ptr<const image::SpectralImage>;

/// A member's one channel.
struct Band {
    Member file;
    std::size_t channel = 0;
    image::BandFacts facts;
    std::optional<Quantity> quantity;  ///< what the file says
};

class StackImage final : public image::SpectralImage, public std::enable_shared_from_this<StackImage> {
  public:
    StackImage(const std::string& path, std::vector<Band> bands, image::Part part)
        : SpectralImage(path), m_bands(std::move(bands)) {
        add(std::move(part));
    }

    [[nodiscard]] std::string_view format() const override { return "band files"; }

    [[nodiscard]] Result<std::unique_ptr<BlockSource>>
    make_block_source(std::size_t, image::PlaneChannels planes, image::Grain grain) const override {
        std::vector<std::unique_ptr<BlockSource>> sources;
        std::vector<convert::JoinedPlane> joined;
        for (const auto& plane : planes) {
            // A plane that nobody reads is one of the first file's, empty.
            const Band& band = m_bands[plane.value_or(0)];
            OSIO_TRY(auto source, band.file->make_block_source(
                                      0, {plane ? std::optional(band.channel) : std::nullopt}, grain));
            joined.push_back({sources.size(), 0});
            sources.push_back(std::move(source));
        }
        return convert::join_sources(std::move(sources), std::move(joined));
    }

  private:
    std::vector<Band> m_bands;
};

/// The name of a file without folder and ending.
std::string stem(const std::string& path) {
    const std::string name = path.substr(path.find_last_of('/') + 1);
    const auto dot = name.rfind('.');
    return dot == std::string::npos || dot == 0 ? name : name.substr(0, dot);
}

Result<Member> open_member(const std::string& path, const OpenWords& words, std::optional<double> scale) {
    if (starts_like_png(path))
        return PngFile::open(path, scale);
    if (tiff::starts_like_tiff(path))
        return tiff::TiffFile::open_band(path, words, scale);
    if (scale && exr::starts_like_exr(path))
        return fail(ErrorCode::Usage, "holds floats; a stack's scale is for whole numbers", path);
    auto file = exr::ExrFile::open(path);
    if (!file && file.error().code == ErrorCode::NotSpectral)
        return fail(ErrorCode::NotSpectral, "is no PNG, TIFF or OpenEXR file", path);
    return file;
}

/// The one channel of a file, and what the file says of it.
Result<Band> open_band(const StackFile& line, const OpenWords& words, std::optional<double> scale) {
    Band out;
    OSIO_TRY(out.file, open_member(line.path, words, scale));
    const auto& parts = out.file->parts();
    const image::Part& part = parts.front();
    if (parts.size() != 1 || part.channels.size() != 1)
        return fail(ErrorCode::Unsupported,
                    "has " + std::to_string(parts.size()) + (parts.size() > 1 ? " parts, " : " part, ") +
                        std::to_string(part.channels.size()) +
                        (part.channels.size() > 1 ? " channels" : " channel") +
                        "; a file of a stack is one band",
                    line.path);
    if (part.deep || part.channels.front().subsampled)
        return fail(ErrorCode::Unsupported, "is deep or sub-sampled", line.path);
    if (!part.layout.sets.empty() && !part.layout.sets.front().bands.empty()) {
        const SpectralSet& set = part.layout.sets.front();
        out.facts.wavelength_nm = set.bands.front().wavelength_nm;
        out.quantity = set.quantity();
        if (part.metadata.fwhm)
            out.facts.fwhm_nm = part.metadata.fwhm->held_at(out.facts.wavelength_nm);
    }
    return out;
}

/// Wavelengths by the list, the map, the files, their names: the first that speaks of a file.
Result<void> find_wavelengths(const StackText& stack, const OpenWords& words, std::vector<Band>& bands) {
    std::vector<std::string> names;
    for (const StackFile& file : stack.files)
        names.push_back(stem(file.path));
    std::vector<std::optional<MappedBand>> mapped(names.size());
    if (words.wavelengths) {
        OSIO_TRY(mapped, map_bands(*words.wavelengths, names));
    }
    for (std::size_t i = 0; i < bands.size(); ++i) {
        image::BandFacts& facts = bands[i].facts;
        if (stack.files[i].wavelength_nm > 0)
            facts = {stack.files[i].wavelength_nm, stack.files[i].fwhm_nm, false};
        else if (mapped[i])
            facts = {mapped[i]->wavelength_nm, mapped[i]->fwhm_nm.value_or(0), false};
        else if (facts.wavelength_nm == 0)
            if (const auto named = wavelengths_in(names[i]); named.size() == 1)
                facts.wavelength_nm = named.front();
        if (facts.wavelength_nm == 0)
            return fail(
                ErrorCode::NotSpectral,
                "has no wavelength: neither the file nor its name says one; write it behind the name in "
                "the list, or give wavelengths=START:STEP:END for all",
                stack.files[i].path);
    }
    return {};
}

Result<void> check_windows(const StackText& stack, const std::vector<Band>& bands) {
    const auto size = [](const image::Window& window) {
        return std::to_string(window.width()) + "x" + std::to_string(window.height()) + " pixels from " +
               std::to_string(window.min_x) + "," + std::to_string(window.min_y) + " on";
    };
    const image::Window& first = bands.front().file->parts().front().data_window;
    for (std::size_t i = 1; i < bands.size(); ++i)
        if (const image::Window& window = bands[i].file->parts().front().data_window; window != first)
            return fail(ErrorCode::Unsupported,
                        "has " + size(window) + ", and " + stack.files.front().path + " has " + size(first) +
                            "; bands of one image have one size",
                        stack.files[i].path);
    return {};
}

/// What the files say their numbers are; Contradiction where they do not agree.
Result<std::optional<Quantity>> stated_quantity(const StackText& stack, const std::vector<Band>& bands) {
    std::optional<Quantity> out;
    std::size_t first = 0;
    for (std::size_t i = 0; i < bands.size(); ++i) {
        if (!bands[i].quantity)
            continue;
        if (out && *out != *bands[i].quantity)
            return fail(ErrorCode::Contradiction,
                        "holds " + std::string(quantity_name(*bands[i].quantity)) + ", and " +
                            stack.files[first].path + " holds " + std::string(quantity_name(*out)),
                        stack.files[i].path);
        if (!out)
            first = i;
        out = bands[i].quantity;
    }
    return out;
}

image::Part describe(const std::vector<Band>& bands, Family family, std::vector<std::string> warnings) {
    const image::Part& first = bands.front().file->parts().front();
    image::Part part;
    part.data_window = first.data_window;
    part.display_window = first.display_window;
    part.header = Imf::Header(first.header.displayWindow(), first.header.dataWindow());
    part.header.compression() = Imf::NO_COMPRESSION;
    part.compression = "none";
    std::vector<image::BandFacts> facts;
    std::vector<std::string> formats;
    for (const Band& band : bands) {
        facts.push_back(band.facts);
        const std::string format(band.file->format());
        if (std::find(formats.begin(), formats.end(), format) == formats.end())
            formats.push_back(format);
        for (const std::string& warning : band.file->parts().front().layout.warnings)
            if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end())
                warnings.push_back(warning);
    }
    part.storage = std::to_string(bands.size()) + " files, " + join(formats, ", ");
    image::insert_band_attributes(facts, family, {}, part.header);
    image::describe_bands(image::channel_names(facts, family), warnings, part);
    for (std::size_t i = 0; i < bands.size(); ++i)
        part.channels[i].type = bands[i].file->parts().front().channels[bands[i].channel].type;
    return part;
}

Result<Member> open_named(const std::string& path, const StackText& stack, const OpenWords& words) {
    OpenWords of_files;
    of_files.quantity = words.quantity;
    std::vector<Band> bands;
    for (const StackFile& file : stack.files) {
        OSIO_TRY(Band band, open_band(file, of_files, stack.scale));
        bands.push_back(std::move(band));
    }
    OSIO_CHECK_OK(check_windows(stack, bands));
    OSIO_CHECK_OK(find_wavelengths(stack, words, bands));
    OSIO_TRY(const auto stated, stated_quantity(stack, bands));
    if (stated)
        OSIO_CHECK_OK(check_quantity(words.quantity, *stated, "the files say what their numbers are"));
    std::vector<std::string> warnings;
    const Family family = stated ? image::family_of(*stated) : assumed_family(words.quantity, warnings);
    image::Part part = describe(bands, family, std::move(warnings));
    return std::make_shared<const StackImage>(path, std::move(bands), std::move(part));
}

}  // namespace

Result<Member> open_stack(const StackText& stack, const OpenWords& words) {
    return open_named(stack.files.front().path, stack, words);
}

Result<Member> open_stack(std::span<const std::string> files, const OpenWords& words) {
    StackText stack;
    for (const std::string& path : files)
        stack.files.push_back({path, 0, 0});
    return open_stack(stack, words);
}

Result<Member> open_stack_file(const std::string& path, const OpenWords& words) {
    OSIO_TRY(const std::string text, files::read_text(path));
    auto stack = parse_stack(text);
    if (!stack)
        return fail_within(path, stack.error());
    const std::string folder = files::folder_of(path);
    for (StackFile& file : stack->files)
        file.path = files::seen_from(folder, file.path);
    return open_named(path, *stack, words);
}

bool starts_like_stack(const std::string& path) {
    std::array<char, kStackMagic.size() + 4> head{};
    std::ifstream in(path, std::ios::binary);
    in.read(head.data(), head.size());
    std::string_view text(head.data(), static_cast<std::size_t>(in.gcount()));
    if (text.starts_with("\xEF\xBB\xBF"))
        text.remove_prefix(3);
    if (!text.starts_with(kStackMagic))
        return false;
    text.remove_prefix(kStackMagic.size());
    return text.empty() || text.front() == '\n' || text.front() == '\r' || text.front() == ' ';
}

}  // namespace osio::stack
