// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/commands.h>
#include <tools/osiotool/request_words.h>
#include <tools/osiotool/spectrum_plot.h>

#include <formats/files/text_file.h>
#include <formats/image/open_image.h>
#include <formats/image/region_spectrum.h>

#include <osio/base/text.h>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <optional>

namespace osio::tool {

namespace {

tl::unexpected<Error> no_place(const std::string& text) {
    return fail(ErrorCode::Usage, "\"" + text +
                                      "\" is no place; expected X Y, such as 10 20, or WxH+X+Y, such as "
                                      "64x32+10+20");
}

/// The whole number at the front of a text, which it leaves; nothing where there is none.
std::optional<int> take_number(std::string_view& text) {
    int value = 0;
    const bool plus = text.starts_with("+");  // from_chars takes a minus only
    const char* const begin = text.data() + (plus ? 1 : 0);
    const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
    if (error != std::errc() || (plus && value < 0))
        return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return value;
}

/// WxH+X+Y, with signs as oiiotool has them.
std::optional<image::Window> parse_region(std::string_view text) {
    const auto width = take_number(text);
    if (!width || !text.starts_with("x"))
        return std::nullopt;
    text.remove_prefix(1);
    const auto height = take_number(text);
    const auto x = take_number(text), y = take_number(text);
    if (!height || !x || !y || !text.empty() || *width <= 0 || *height <= 0)
        return std::nullopt;
    constexpr int kFarthest = 1 << 30;  // with sums that no int overflows
    if (std::max({*width, *height, std::abs(*x), std::abs(*y)}) >= kFarthest)
        return std::nullopt;
    return image::Window{*x, *y, *x + *width - 1, *y + *height - 1};
}

/// X and Y, or a region; all of the window where there is no word.
Result<image::Window> region_of(const std::vector<std::string>& words, const image::Window& window) {
    if (words.empty())
        return window;
    std::string text = words.front();
    if (words.size() == 2)
        text = "1x1" + std::string(words[0].starts_with("-") ? "" : "+") + words[0] +
               (words[1].starts_with("-") ? "" : "+") + words[1];
    if (const auto region = parse_region(text))
        return *region;
    return no_place(words.size() == 2 ? words[0] + " " + words[1] : text);
}

std::string place_text(const image::Window& region) {
    return region.width() == 1 && region.height() == 1
               ? fmt::format("pixel {},{}", region.min_x, region.min_y)
               : fmt::format("mean of {}x{}{:+}{:+}", region.width(), region.height(), region.min_x,
                             region.min_y);
}

std::string csv_of(const std::vector<image::BandSpread>& spread, bool with_range) {
    std::string out = with_range ? "nm,mean,minimum,maximum\n" : "nm,value\n";
    for (const image::BandSpread& band : spread) {
        out += format_double(band.wavelength_nm) + "," + format_double(band.mean);
        if (with_range)
            out += "," + format_double(band.minimum) + "," + format_double(band.maximum);
        out += "\n";
    }
    return out;
}

}  // namespace

Result<ExitCode> run_spectrum(const SpectrumOptions& options) {
    CollapseRequest request;
    request.part = options.part;
    request.set = options.set;
    const bool plot = to_lower(options.output).ends_with(".svg");
    if (!options.output.empty() && !plot && !to_lower(options.output).ends_with(".csv"))
        return fail(ErrorCode::Usage, "\"" + options.output + "\" is neither a .csv nor a .svg");
    if (plot && options.range)
        return fail(ErrorCode::Usage, "--range is for tables; a plot always shows the range");
    OSIO_TRY(const OpenWords words, open_words_of(options.request));
    OSIO_TRY(const auto file, image::open_image(options.input, words));
    OSIO_TRY(const Selection selection, file->select(request));
    const image::Part& part = file->parts()[selection.part];
    const SpectralSet& set = part.layout.sets[selection.set];
    OSIO_TRY(const image::Window region, region_of(options.place, part.data_window));
    OSIO_TRY(const auto spread, image::region_spectrum(*file, selection, region));
    for (const std::string& warning : part.layout.warnings)
        fmt::print(stderr, "warning: {}\n", warning);
    if (!set.reradiation.empty())
        fmt::print(
            stderr,
            "warning: set {} is fluorescent: this is what it reflects; what its {} pairs send out depends on "
            "the light\n",
            set.name(), set.reradiation.size());
    for (const image::BandSpread& band : spread)
        if (band.undefined != 0)
            fmt::print(stderr, "warning: {} of the samples at {:g} nm are NaN or infinite and are left out\n",
                       band.undefined, band.wavelength_nm);
    const std::string text =
        plot ? spectrum_plot(spread, fmt::format("{}, {}, {}", options.input, set.name(), place_text(region)),
                             std::string(quantity_name(set.quantity())))
             : csv_of(spread, options.range);
    if (options.output.empty()) {
        fmt::print("{}", text);
        return kDone;
    }
    OSIO_CHECK_OK(files::write_text(options.output, text));
    return kDone;
}

}  // namespace osio::tool
