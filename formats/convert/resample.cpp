// SPDX-License-Identifier: Apache-2.0
#include <formats/convert/choice.h>
#include <formats/convert/resample.h>
#include <formats/envi/attribute_fields.h>
#include <formats/image/derived_image.h>
#include <formats/image/header_attributes.h>
#include <formats/image/preview_plan.h>

#include <osio/base/text.h>

#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <set>
#include <utility>

namespace osio::convert {

namespace {

/// The channels of a part, one set after the other resampled.
class Builder {
  public:
    explicit Builder(const image::Part& part)
        : m_part(part), m_names(image::derived_names(part)), m_header(attributes_of(part)) {}

    void keep(const SpectralSet& set) {
        for (const Band& band : set.bands)
            keep_channel(band.channel);
        for (const Reradiation& pair : set.reradiation)
            keep_channel(pair.channel);
    }

    void drop(const SpectralSet& set, const std::string& why) {
        forget(set);
        m_lost.push_back("set " + set.name() + ": " + why);
    }

    void replace(const SpectralSet& set, const ResamplingPlan& plan, const WavelengthGrid& grid) {
        forget(set);
        const std::vector<double> targets = grid.wavelengths_nm();
        for (std::size_t t = 0; t < targets.size(); ++t) {
            const std::string name =
                format_channel_name({set.root, set.family, targets[t], {}}, DecimalMark::Comma);
            image::DerivedChannel channel{{name, SampleType::Float, false}, std::nullopt, {}};
            for (std::size_t band = 0; band < set.bands.size(); ++band)
                if (plan.weights.at(t, band) != 0)
                    channel.terms.push_back({set.bands[band].channel, plan.weights.at(t, band)});
            if (channel.terms.size() == 1 && channel.terms[0].weight == 1)
                channel.source = channel.terms[0].channel;
            m_channels.push_back(std::move(channel));
        }
        if (!set.reradiation.empty())
            m_lost.push_back("reradiation of set " + set.name());
        replace_edges(plan, targets, grid.step_nm);
    }

    Resampled finish(std::shared_ptr<const image::SpectralImage> image, std::size_t part) {
        std::vector<std::string> names;
        for (auto a = m_header.begin(); a != m_header.end(); ++a) {
            const std::string name = a.name();
            const bool counts = name.starts_with(envi::kAttributePrefix) &&
                                envi::counts_bands(name.substr(envi::kAttributePrefix.size()));
            const auto band = parse_channel_name(name, DecimalMark::Comma);
            const bool of_changed = band && m_sets.contains({band->root, band->family});
            if (of_changed ||
                (!m_sets.empty() && (name == attribute::kFwhm || name == attribute::kReduction || counts)))
                names.push_back(name);
        }
        image::erase_attributes({names.begin(), names.end()}, m_header);
        if (!m_pictures.empty())
            image::erase_attributes({image::attribute::kPreviewRecipe}, m_header);
        if (!names.empty())
            m_lost.push_back((names.size() > 1 ? "attributes " : "attribute ") + names_text(names) +
                             ", of the bands before");
        for (const std::size_t channel : m_part.layout.others) {
            const std::string& name = m_part.layout.channel_names[channel];
            if (m_pictures.contains(name))
                m_lost.push_back("channel " + name + ", a preview of the bands before");
            else
                keep_channel(channel);
        }
        return {image::derive_image(std::move(image), part, std::move(m_channels), std::move(m_header)),
                std::move(m_lost),
                {}};
    }

  private:
    void keep_channel(std::size_t channel) {
        image::Channel named = m_part.channels[channel];
        named.name = m_names[channel];
        m_channels.push_back({std::move(named), channel, {}});
    }

    void forget(const SpectralSet& set) {
        m_sets.emplace(set.root, set.family);
        for (std::string& name : picture_names(set.root))
            m_pictures.insert(std::move(name));
    }

    /// Edges that the file states become those of the new bins, where the new bands are bins.
    void replace_edges(const ResamplingPlan& plan, const std::vector<double>& targets, double step) {
        const std::string name(attribute::kBinEdges);
        if (m_header.find(name) == m_header.end())
            return;
        if (!plan.binned) {
            image::erase_attributes({name}, m_header);
            m_lost.push_back(name + ": the new bands are samples");
            return;
        }
        std::vector<std::string> words;
        for (const double nm : targets)
            words.push_back(format_double(nm - step / 2));
        words.push_back(format_double(targets.back() + step / 2));
        m_header.insert(name, Imf::StringAttribute(join(words, ";")));
    }

    const image::Part& m_part;
    std::vector<std::string> m_names;
    Imf::Header m_header;
    std::vector<image::DerivedChannel> m_channels;
    std::set<std::pair<std::string, Family>> m_sets;  // that are no longer as they were
    std::set<std::string> m_pictures;
    std::vector<std::string> m_lost;
};

}  // namespace

Result<Resampled> resample(std::shared_ptr<const image::SpectralImage> image, const Selection& selection,
                           const Resampling& resampling) {
    const image::Part& part = image->parts()[selection.part];
    Builder builder(part);
    std::vector<std::string> warnings;
    for (std::size_t i = 0; i < part.layout.sets.size(); ++i) {
        const SpectralSet& set = part.layout.sets[i];
        auto plan = set.bands.empty()
                        ? Result<ResamplingPlan>(fail(ErrorCode::Unsupported, "it has reradiation only"))
                        : plan_resampling(set, part.metadata, resampling);
        if (!plan && i == selection.set)
            return fail_in(image->path(), std::move(plan).error());
        if (!plan) {
            builder.drop(set, plan.error().what);
        } else if (plan->identity) {
            builder.keep(set);
        } else {
            builder.replace(set, *plan, resampling.grid);
            for (std::string& warning : plan->warnings)
                if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end())
                    warnings.push_back(std::move(warning));
        }
    }
    Resampled out = builder.finish(std::move(image), selection.part);
    out.warnings = std::move(warnings);
    return out;
}

}  // namespace osio::convert
