// SPDX-License-Identifier: Apache-2.0
#include <formats/image/collapse_job.h>
#include <formats/image/colour_attributes.h>
#include <formats/image/colour_image.h>
#include <formats/image/open_image.h>

#include <osio/base/text.h>
#include <osio/collapse/text_loader.h>

#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <array>

namespace osio::image {

namespace {

using Channels = std::array<std::optional<std::size_t>, 3>;

bool complete(const Channels& channels) {
    return channels[0] && channels[1] && channels[2];
}

Channels find_channels(const Part& part, const std::array<std::string_view, 3>& names) {
    Channels out;
    for (std::size_t c = 0; c < 3; ++c)
        out[c] = part.layout.find_channel(names[c]);
    return out;
}

constexpr std::array<std::string_view, 3> kRgb{"R", "G", "B"}, kXyz{"X", "Y", "Z"};

/// What a header says of its R, G, B.
Result<OutputSpace> stated_space(const Part& part, std::vector<std::string>& warnings) {
    const auto* const name =
        part.header.findTypedAttribute<Imf::StringAttribute>(image::attribute::kColorSpace);
    if (name != nullptr)
        if (auto known = find_output_space(name->value()); known && is_tristimulus(known->kind))
            return known;
    const auto* const stated =
        part.header.findTypedAttribute<Imf::ChromaticitiesAttribute>(image::attribute::kChromaticities);
    if (stated == nullptr) {
        warnings.push_back((name == nullptr ? std::string("no oiio:ColorSpace or chromaticities")
                                            : "no chromaticities, and oiio:ColorSpace \"" + name->value() +
                                                  "\" is not known") +
                           ": R, G, B are taken as linear Rec.709");
        return find_output_space("lin_rec709");
    }
    const Imf::Chromaticities& c = stated->value();
    std::vector<std::string> numbers;
    for (const Imath::V2f& xy : {c.red, c.green, c.blue, c.white})
        for (const float value : {xy.x, xy.y})
            numbers.push_back(format_double(static_cast<double>(value)));
    OSIO_TRY(OutputSpace space, find_output_space("rgb:" + join(numbers, ",")));
    if (space.red == Chromaticity{1, 0} && space.green == Chromaticity{0, 1} &&
        space.blue == Chromaticity{0, 0})
        space.kind = SpaceKind::Xyz;
    return space;
}

WeightMatrix weights_of(const Matrix3& matrix) {
    WeightMatrix out(3, 3);
    for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c)
            out.at(r, c) = matrix.rows[r][c];
    return out;
}

void understand_xyz(ColourImage& image, const OutputSpace& space) {
    image.recipe = {weights_of(Matrix3::identity()), Transfer::Linear, kD65.xyz()};
    image.meaning = "X, Y, Z";
    if (space.kind != SpaceKind::XyzD65)
        image.warnings.emplace_back("the white of X, Y, Z is not stated: taken as D65");
}

Result<void> understand(ColourImage& image, bool rgb) {
    if (!rgb) {
        std::vector<std::string> unused;
        OSIO_TRY(const OutputSpace space, stated_space(image.part(), unused));
        understand_xyz(image, space);
        return {};
    }
    OSIO_TRY(const OutputSpace space, stated_space(image.part(), image.warnings));
    if (space.kind != SpaceKind::Rgb) {
        understand_xyz(image, space);
        return {};
    }
    image.recipe = {weights_of(xyz_from_rgb(space)), space.transfer, space.white.xyz()};
    image.meaning = "R, G, B of " + space.id;
    return {};
}

Result<ColourImage> open_colour(std::shared_ptr<const SpectralImage> file, const CollapseRequest& request) {
    const std::string path = file->path();
    std::vector<std::size_t> parts;
    if (request.part.empty()) {
        for (std::size_t part = 0; part < file->parts().size(); ++part)
            parts.push_back(part);
    } else {
        const auto part = select_part(file->summaries(), request.part);
        if (!part)
            return fail_in(path, part.error());
        parts.push_back(*part);
    }
    for (const std::size_t part : parts) {
        const Part& header = file->parts()[part];
        Channels channels = find_channels(header, kRgb);
        const bool rgb = complete(channels);
        if (!rgb)
            channels = find_channels(header, kXyz);
        if (!complete(channels))
            continue;
        ColourImage out;
        out.file = file;
        out.part_index = part;
        out.planes.assign(channels.begin(), channels.end());
        if (auto understood = understand(out, rgb); !understood)
            return fail_in(path, understood.error());
        return out;
    }
    return fail(ErrorCode::NotSpectral, "holds neither bands nor channels R, G, B or X, Y, Z", path);
}

Result<ColourImage> open_spectral(const std::shared_ptr<const SpectralImage>& file,
                                  const CollapseRequest& request, const TextLoader& load_text) {
    CollapseRequest to_xyz = request;
    OSIO_TRY(to_xyz.to, find_output_space("lab"));  // its weights are those of X, Y, Z
    OSIO_TRY(const CollapseJob job, prepare_collapse(file, to_xyz, load_text));
    ColourImage out;
    out.file = file;
    out.part_index = job.part_index;
    for (std::size_t column = 0; column < job.plan.columns.size(); ++column)
        out.planes.push_back(job.plan.weights.needs(column) ? std::optional(job.plan.columns[column].channel)
                                                            : std::nullopt);
    out.recipe = {job.plan.weights, Transfer::Linear, job.plan.white};
    out.spectral = true;
    out.meaning = "set " + job.plan.request.set +
                  (job.plan.illuminant ? " under " + job.plan.illuminant->id : std::string(", radiance"));
    out.warnings = job.warnings;
    return out;
}

}  // namespace

Result<std::unique_ptr<BlockSource>> ColourImage::open_source() const {
    return file->make_block_source(part_index, planes, Grain::Block);
}

Result<ColourImage> open_colour_image(const std::string& path, const CollapseRequest& request,
                                      const TextLoader& load_text) {
    OSIO_TRY(const OpenWords words, load_open_words(request, load_text));
    auto file = open_image(path, words);
    std::optional<Error> denied;
    if (!file && file.error().code == ErrorCode::Contradiction) {
        denied = file.error();
        file = open_image(path);
    }
    if (!file)
        return tl::unexpected(std::move(file).error());
    const auto& parts = (*file)->parts();
    const bool spectral = std::any_of(parts.begin(), parts.end(), [](const Part& part) {
        return std::any_of(part.layout.sets.begin(), part.layout.sets.end(),
                           [](const SpectralSet& set) { return !set.bands.empty(); });
    });
    OSIO_TRY(ColourImage out,
             spectral ? open_spectral(*file, request, load_text) : open_colour(*file, request));
    out.denied = std::move(denied);
    if (out.denied)
        out.warnings.push_back(out.denied->what + ": read without the word");
    return out;
}

}  // namespace osio::image
