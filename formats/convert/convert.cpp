// SPDX-License-Identifier: Apache-2.0
#include <formats/convert/all_parts.h>
#include <formats/convert/convert.h>
#include <formats/convert/fan_out.h>
#include <formats/convert/join.h>
#include <formats/convert/picture.h>
#include <formats/convert/resample.h>
#include <formats/convert/sink.h>
#include <formats/image/open_image.h>
#include <formats/stack/stack.h>

#include <osio/base/text.h>
#include <osio/spectra/wavelength.h>

#include <algorithm>

namespace osio::convert {

namespace {

/// Files of a split that are open at a time.
constexpr std::size_t kMostOpen = 64;

/// Every format that is written, one a line.
const std::vector<Target>& targets() {
    static const std::vector<Target> all{{{".exr", ".spexr"}, true, open_exr},
                                         {{".hdr"}, false, open_envi},
                                         {{".tif", ".tiff"}, false, open_tiff},
                                         {{".png"}, false, open_png}};
    return all;
}

Result<void> check_words(const Request& request, const Target& target) {
    const bool exr = target.open == open_exr, envi = target.open == open_envi,
               tiff = target.open == open_tiff;
    if (!envi && request.interleave)
        return fail(ErrorCode::Usage, "--interleave is for .hdr output");
    if (!exr && request.depth)
        return fail(ErrorCode::Usage,
                    "-d and --half are for .exr output; ENVI and TIFF get plain floats, PNG 16 bits");
    if (!exr && !tiff && !request.compression.empty())
        return fail(ErrorCode::Usage,
                    "--compression is for .exr and .tif output; ENVI gets plain floats, PNG "
                    "has a compression of its own");
    if (tiff && !request.compression.empty() && request.compression != "none" && request.compression != "zip")
        return fail(ErrorCode::Usage, "there is no compression \"" + request.compression +
                                          "\" of .tif output; expected none or zip");
    if (!exr && (request.tile || request.multi_part || !request.preview.empty()))
        return fail(ErrorCode::Usage, "--tile, --preview and --multi-part are for .exr output");
    if (request.split == Split::Bands && (request.multi_part || !request.preview.empty()))
        return fail(ErrorCode::Usage, "--preview and --multi-part need all bands in one file, --split bands "
                                      "makes a file of each");
    return {};
}

/// Parts that do not go over, in words; empty for none.
std::string other_parts(const Request& request, const image::SpectralImage& image) {
    const std::size_t others = image.parts().size() - 1;
    if (others == 0 || request.split == Split::Sets)
        return {};
    return std::to_string(others) + " other part" + (others > 1 ? "s" : "");
}

/// False for a file that is a band only together with what its name or the user's words say.
Result<bool> holds_bands(const std::string& path) {
    const auto image = image::open_image(path);
    if (!image && image.error().code == ErrorCode::NotSpectral)
        return false;
    if (!image)
        return tl::unexpected(image.error());
    const auto& parts = (*image)->parts();
    return std::any_of(parts.begin(), parts.end(),
                       [](const image::Part& part) { return !part.layout.sets.empty(); });
}

Result<std::shared_ptr<const image::SpectralImage>> open_inputs(const Request& request, Outcome& outcome) {
    if (request.joined.empty())
        return image::open_image(request.input, request.words);
    OSIO_TRY(const bool bands, holds_bands(request.input));
    if (!bands) {
        std::vector<std::string> files{request.input};
        files.insert(files.end(), request.joined.begin(), request.joined.end());
        return stack::open_stack(files, request.words);
    }
    std::vector<std::shared_ptr<const image::SpectralImage>> images;
    OSIO_TRY(auto first, image::open_image(request.input, request.words));
    images.push_back(std::move(first));
    for (const std::string& path : request.joined) {
        OSIO_TRY(auto image, image::open_image(path, request.words));
        images.push_back(std::move(image));
    }
    OSIO_TRY(Joined joined, join_images(images, request.part));
    add_unique(std::move(joined.lost), outcome.lost);
    return std::move(joined.image);
}

std::string first_with_bands(const ChannelLayout& layout) {
    for (const SpectralSet& set : layout.sets)
        if (!set.bands.empty())
            return set.name();
    return {};
}

std::size_t band_count(const Choice& choice) {
    std::size_t out = 0;
    for (const SpectralSet& set : choice.part().layout.sets)
        for (const Band& band : set.bands)
            out += static_cast<std::size_t>(
                std::count(choice.channels.begin(), choice.channels.end(), band.channel));
    return out;
}

/// The only part that has bands, where all its sets go over and none need be named.
std::optional<std::size_t> only_part(const image::SpectralImage& image) {
    std::optional<std::size_t> out;
    for (std::size_t part = 0; part < image.parts().size(); ++part)
        if (!image.parts()[part].layout.sets.empty()) {
            if (out)
                return std::nullopt;
            out = part;
        }
    return out;
}

/// The sets that are wanted: the one that the words choose, or of a split by sets all.
Result<std::vector<Selection>> selections(const Request& request, const Target& target,
                                          const image::SpectralImage& image) {
    CollapseRequest words;
    if (request.joined.empty())
        words.part = request.part;
    words.set = request.set;
    std::vector<Selection> out;
    const bool every_set = target.everything && !request.split && request.preview.empty();
    if (every_set && request.set.empty()) {
        auto part = only_part(image);
        if (!request.part.empty() && request.joined.empty()) {
            OSIO_TRY(part, select_part(image.summaries(), request.part));
        }
        if (part && image.parts()[*part].layout.sets.size() > 1)
            words.set = first_with_bands(image.parts()[*part].layout);
    }
    if (request.split != Split::Sets) {
        OSIO_TRY(const Selection one, image.select(words));
        const SpectralSet& set = image.parts()[one.part].layout.sets[one.set];
        if (set.bands.empty())
            return fail(ErrorCode::Unsupported, "set " + set.name() + " has reradiation only", image.path());
        out.push_back(one);
        return out;
    }
    for (std::size_t part = 0; part < image.parts().size(); ++part)
        for (const SpectralSet& set : image.parts()[part].layout.sets) {
            words.part = std::to_string(part);
            words.set = set.name();
            if (set.bands.empty())
                continue;
            OSIO_TRY(const Selection one, image.select(words));
            out.push_back(one);
        }
    if (out.empty()) {
        OSIO_TRY(const Selection one, image.select({}));
        out.push_back(one);
    }
    return out;
}

/// The choice of a set and what is made of it.
Result<Choice> prepare(const Request& request, const Target& target,
                       std::shared_ptr<const image::SpectralImage> image, Selection selection,
                       Outcome& outcome) {
    const image::Part& part = image->parts()[selection.part];
    const std::string set = part.layout.sets[selection.set].name();
    add_unique(part.layout.warnings, outcome.warnings);
    add_unique(part.metadata.warnings, outcome.warnings);
    if (request.resampling) {
        OSIO_TRY(Resampled resampled, resample(std::move(image), selection, *request.resampling));
        add_unique(std::move(resampled.lost), outcome.lost);
        add_unique(std::move(resampled.warnings), outcome.warnings);
        CollapseRequest words;
        words.set = set;
        image = std::move(resampled.image);
        OSIO_TRY(selection, image->select(words));
    }
    Choice out = choose(std::move(image), selection, target.everything && request.split != Split::Bands);
    if (request.split)
        leave_out_other_sets(out);
    if (request.bands)
        OSIO_CHECK_OK(leave_out(
            [&](double nm) { return nm >= request.bands->first_nm && nm <= request.bands->last_nm; },
            format_double(request.bands->first_nm) + "-" + format_double(request.bands->last_nm) + " nm",
            out));
    note_lost_channels(out);
    if (!request.preview.empty())
        return with_picture(std::move(out), request.preview);
    return out;
}

/// The choice cut into files.
Result<std::vector<Output>> cut(const Request& request, Choice choice) {
    std::vector<Output> out;
    if (!request.split) {
        out.push_back({request.output, std::move(choice)});
        return out;
    }
    if (request.split == Split::Sets) {
        const std::string name = choice.set.name();
        out.push_back({split_path(request.output, "{set}", name, "_" + name), std::move(choice)});
        return out;
    }
    for (const Band& band : choice.set.bands) {
        const std::string nm = format_double(band.wavelength_nm);
        Choice one = choice;
        OSIO_CHECK_OK(leave_out([&](double other) { return other == band.wavelength_nm; }, nm + " nm", one));
        one.lost = choice.lost;
        out.push_back({split_path(request.output, "{nm}", nm, "_" + nm + "nm"), std::move(one)});
    }
    return out;
}

Result<void> check_distinct(const std::vector<Output>& outputs) {
    std::vector<std::string> paths;
    for (const Output& output : outputs)
        paths.push_back(output.path);
    std::sort(paths.begin(), paths.end());
    const auto twice = std::adjacent_find(paths.begin(), paths.end());
    if (twice == paths.end())
        return {};
    return fail(ErrorCode::Usage,
                "two bands or sets would be written to one file; --split bands takes {nm} in the "
                "output's name, --split sets {set}",
                *twice);
}

}  // namespace

Result<const Target*> find_target(const std::string& output) {
    const std::string name = to_lower(output);
    std::vector<std::string> endings;
    for (const Target& target : targets())
        for (const std::string_view ending : target.endings) {
            if (name.ends_with(ending))
                return &target;
            endings.emplace_back(ending);
        }
    const std::string last = endings.back();
    endings.pop_back();
    return fail(ErrorCode::Usage, "expected an output that ends in " + join(endings, ", ") + " or " + last,
                output);
}

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
    OSIO_TRY(const Target* const target, find_target(request.output));
    OSIO_CHECK_OK(check_words(request, *target));
    Outcome out;
    out.output = request.output;
    OSIO_TRY(const auto image, open_inputs(request, out));
    if (takes_all_parts(request, *target, *image)) {
        OSIO_CHECK_OK(write_all_parts(request, image, runner, progress, out));
        return out;
    }
    OSIO_TRY(const auto sets, selections(request, *target, *image));
    if (std::string others = other_parts(request, *image); !others.empty())
        out.lost.push_back(std::move(others));
    std::vector<Output> outputs;
    for (const Selection& set : sets) {
        OSIO_TRY(Choice choice, prepare(request, *target, image, set, out));
        add_unique(choice.lost, out.lost);
        out.width = choice.part().data_window.width();
        out.height = choice.part().data_window.height();
        out.bands += band_count(choice);
        OSIO_TRY(auto files, cut(request, std::move(choice)));
        std::move(files.begin(), files.end(), std::back_inserter(outputs));
    }
    OSIO_CHECK_OK(check_distinct(outputs));
    std::vector<std::span<const Output>> passes;
    for (std::size_t first = 0; first < outputs.size();) {
        std::size_t end = first + 1;
        while (end < outputs.size() && end - first < kMostOpen &&
               outputs[end].choice.image == outputs[first].choice.image &&
               outputs[end].choice.part_index == outputs[first].choice.part_index)
            ++end;
        passes.push_back(std::span(outputs).subspan(first, end - first));
        first = end;
    }
    for (std::size_t pass = 0; pass < passes.size(); ++pass) {
        const auto share = [&](double done) {
            return !progress ||
                   progress((static_cast<double>(pass) + done) / static_cast<double>(passes.size()));
        };
        OSIO_CHECK_OK(write_outputs(request, *target, passes[pass], runner, share, out));
    }
    return out;
}

}  // namespace osio::convert
