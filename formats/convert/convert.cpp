// SPDX-License-Identifier: Apache-2.0
#include <formats/convert/convert.h>
#include <formats/convert/targets.h>

#include <osio/base/text.h>
#include <osio/spectra/wavelength.h>

namespace osio::convert {

Result<Range> parse_range(std::string_view text) {
    const auto dash = text.find('-', 1);
    const std::string_view low = trim(text.substr(0, dash));
    const std::string_view high =
        dash == std::string_view::npos ? std::string_view() : trim(text.substr(dash + 1));
    const auto digits = high.find_last_of("0123456789.");
    std::string unit(high.substr(digits == std::string_view::npos ? 0 : digits + 1));
    const bool bare = unit.empty();
    if (bare)
        unit = "nm";
    const auto first =
        parse_wavelength_nm(std::string(low) + (parse_double(low) ? unit : ""), DecimalMark::Point);
    const auto last = parse_wavelength_nm(std::string(high) + (bare ? unit : ""), DecimalMark::Point);
    if (!first || !last || *first >= *last)
        return fail(ErrorCode::Usage,
                    "found bands \"" + std::string(text) + "\", expected a range such as 400-700nm");
    return Range{*first, *last};
}

Result<Outcome> convert(const Request& request, Runner& runner, const Progress& progress) {
    const std::string name = to_lower(request.output);
    const bool exr = name.ends_with(".exr") || name.ends_with(".spexr");
    if (!exr && !name.ends_with(".hdr"))
        return fail(ErrorCode::Usage, "expected an output that ends in .exr, .spexr or .hdr", request.output);
    if (exr && request.interleave)
        return fail(ErrorCode::Usage, "--interleave is for .hdr output");
    if (!exr && (request.depth || !request.compression.empty()))
        return fail(ErrorCode::Usage, "-d and --compression are for .exr output; ENVI gets plain floats");
    OSIO_TRY(const Choice choice, choose(request, exr));
    const image::Part& part = choice.part();
    Outcome out;
    out.output = request.output;
    out.width = part.data_window.width();
    out.height = part.data_window.height();
    out.bands = choice.set.bands.size();
    out.lost = choice.lost;
    out.warnings = part.layout.warnings;
    out.warnings.insert(out.warnings.end(), part.metadata.warnings.begin(), part.metadata.warnings.end());
    OSIO_CHECK_OK(exr ? write_exr(request, choice, runner, progress, out)
                      : write_envi(request, choice, runner, progress, out));
    return out;
}

}  // namespace osio::convert
