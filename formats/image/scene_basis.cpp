// SPDX-License-Identifier: Apache-2.0
#include <formats/image/derived_image.h>
#include <formats/image/header_attributes.h>
#include <formats/image/scene_basis.h>

#include <osio/base/text.h>

#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace osio::image {

namespace {

constexpr std::size_t kDigits = 3;

/// Bands and coefficients. A small file can name many bands, each of which takes the memory of a plane: so many are 0.25 nm
/// apart over 360-830 nm.
constexpr std::size_t kMost = 2048;

struct Expansion {
    std::vector<std::string> bands;
    std::vector<std::vector<double>> rows;  ///< of each coefficient, one a band
};

Result<Expansion> parse(std::string_view text) {
    const auto damaged = [](const std::string& what) {
        return fail(ErrorCode::Damaged, std::string(attribute::kSceneBasis) + ": " + what);
    };
    Expansion out;
    std::set<std::string_view> seen;
    for (const std::string_view line : split(text, '\n')) {
        const auto pieces = split(line, ';');
        if (out.bands.empty()) {
            for (const std::string_view name : pieces) {
                if (!parse_channel_name(name, DecimalMark::Comma))
                    return damaged("\"" + std::string(name) + "\" is no name of a band such as T.550nm");
                if (!seen.insert(name).second)
                    return damaged("\"" + std::string(name) + "\" comes twice");
                out.bands.emplace_back(name);
            }
            continue;
        }
        if (pieces.size() != out.bands.size())
            return damaged("found a line of " + std::to_string(pieces.size()) + " numbers, expected " +
                           std::to_string(out.bands.size()));
        std::vector<double> row;
        for (const std::string_view piece : pieces) {
            const auto number = parse_double(piece);
            if (!number || !std::isfinite(*number))
                return damaged("\"" + std::string(piece) + "\" is no number");
            row.push_back(*number);
        }
        out.rows.push_back(std::move(row));
    }
    if (out.rows.empty() || out.rows.size() > kMost || out.bands.size() > kMost)
        return damaged("found " + std::to_string(out.rows.size()) + " coefficients of " +
                       std::to_string(out.bands.size()) + " bands, expected 1 to " + std::to_string(kMost) +
                       " of each");
    return out;
}

}  // namespace

std::string coefficient_name(std::size_t index) {
    const std::string number = std::to_string(index);
    return "coefficient." + std::string(kDigits - std::min(kDigits, number.size()), '0') + number;
}

std::string scene_basis_text(const std::vector<std::string>& bands, const WeightMatrix& expansion) {
    std::string out = join(bands, ";");
    for (std::size_t k = 0; k < expansion.bands(); ++k) {
        std::vector<std::string> words;
        for (std::size_t band = 0; band < expansion.rows(); ++band)
            words.push_back(format_double(expansion.at(band, k)));
        out += "\n" + join(words, ";");
    }
    return out;
}

Result<std::shared_ptr<const SpectralImage>> expand_scene_basis(std::shared_ptr<const SpectralImage> file) {
    const auto text_of = [](const Part& part) {
        return part.header.findTypedAttribute<Imf::StringAttribute>(attribute::kSceneBasis);
    };
    const auto& parts = file->parts();
    if (std::none_of(parts.begin(), parts.end(), text_of))
        return file;
    if (parts.size() > 1)
        return fail(ErrorCode::Unsupported,
                    std::string(attribute::kSceneBasis) + " in a file of " + std::to_string(parts.size()) +
                        " parts; expected one",
                    file->path());
    const Part& part = parts.front();
    auto expansion = parse(text_of(part)->value());
    if (!expansion)
        return fail_in(file->path(), std::move(expansion).error());
    std::vector<std::size_t> coefficients;
    for (std::size_t k = 0; k < expansion->rows.size(); ++k) {
        const auto channel = part.layout.find_channel(coefficient_name(k));
        if (!channel || part.channels[*channel].subsampled)
            return fail(ErrorCode::Damaged,
                        std::string(attribute::kSceneBasis) + " names " +
                            std::to_string(expansion->rows.size()) +
                            " coefficients, and there is no channel " + coefficient_name(k) +
                            " with a sample a pixel",
                        file->path());
        coefficients.push_back(*channel);
    }
    std::vector<DerivedChannel> channels;
    for (std::size_t band = 0; band < expansion->bands.size(); ++band) {
        DerivedChannel channel{{expansion->bands[band], SampleType::Float, false}, std::nullopt, {}};
        for (std::size_t k = 0; k < coefficients.size(); ++k)
            channel.terms.push_back({coefficients[k], expansion->rows[k][band]});
        channels.push_back(std::move(channel));
    }
    for (std::size_t channel = 0; channel < part.channels.size(); ++channel)
        if (std::find(coefficients.begin(), coefficients.end(), channel) == coefficients.end())
            channels.push_back({part.channels[channel], channel, {}});
    Imf::Header header = part.header;
    erase_attributes({attribute::kSceneBasis}, header);
    return derive_image(std::move(file), 0, std::move(channels), std::move(header));
}

}  // namespace osio::image
