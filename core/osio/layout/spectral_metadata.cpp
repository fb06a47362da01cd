// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/layout/spectral_metadata.h>

#include <algorithm>
#include <array>

namespace osio {

namespace {

/// Units as writers spell them; all are the density per nanometre.
constexpr std::array<std::string_view, 2> kKnownEmissiveUnits{"W.m^-2.sr^-1", "W.m^-2.sr^-1.nm^-1"};

class Reader {
  public:
    Reader(const ChannelLayout& layout, const TextAttributes& attributes)
        : m_layout(layout), m_attributes(attributes) {}

    SpectralMetadata read() {
        m_out.layout_version = text(attribute::kLayoutVersion);
        m_out.emissive_units = text(attribute::kEmissiveUnits);
        m_out.handedness = text(attribute::kHandedness);
        m_out.lens_transmission = spectrum(attribute::kLensTransmission);
        m_out.camera_response = spectrum(attribute::kCameraResponse);
        m_out.basis = text(attribute::kBasis);
        m_out.bin_edges_nm = bin_edges();
        m_out.fwhm = fwhm();
        for (const SpectralSet& set : m_layout.sets)
            for (const Band& band : set.bands)
                if (auto curve = spectrum(m_layout.channel_names[band.channel]))
                    m_out.sensitivities.emplace(band.channel, std::move(*curve));
        if (!m_layout.sets.empty())
            warn();
        return std::move(m_out);
    }

  private:
    [[nodiscard]] std::optional<std::string> text(std::string_view name) const {
        const auto found = m_attributes.find(name);
        if (found == m_attributes.end())
            return std::nullopt;
        return found->second;
    }

    std::optional<Spectrum> spectrum(std::string_view name) {
        const auto value = text(name);
        if (!value)
            return std::nullopt;
        SpectrumText parsed = parse_spectrum_text(*value);
        if (!parsed.rejected.empty())
            m_out.warnings.push_back("attribute \"" + std::string(name) +
                                     "\": " + std::to_string(parsed.rejected.size()) +
                                     " pieces are no wavelength:value, the first is \"" +
                                     parsed.rejected.front().substr(0, 40) + "\"");
        return std::move(parsed.spectrum);
    }

    std::vector<double> bin_edges() {
        const auto value = text(attribute::kBinEdges);
        if (!value)
            return {};
        std::vector<double> out;
        for (const std::string_view piece : split(*value, ';')) {
            const auto nm = parse_double(trim(piece));
            if (!nm || (!out.empty() && *nm <= out.back())) {
                m_out.warnings.push_back(
                    "spectral:binEdges is \"" + value->substr(0, 40) +
                    "\", expected increasing wavelengths in nm between semicolons: ignored");
                return {};
            }
            out.push_back(*nm);
        }
        return out;
    }

    std::optional<Spectrum> fwhm() {
        const auto value = text(attribute::kFwhm);
        if (!value)
            return std::nullopt;
        auto curve = parse_double(trim(*value)) ? Spectrum{{kObserverFirstNm}, {*parse_double(trim(*value))}}
                                                : parse_spectrum_text(*value).spectrum;
        const bool positive =
            std::all_of(curve.values.begin(), curve.values.end(), [](double width) { return width > 0; });
        if (!curve.values.empty() && positive)
            return curve;
        m_out.warnings.push_back("spectral:fwhm is \"" + value->substr(0, 40) +
                                 "\", expected a width in nm or wavelength:width;...: ignored");
        return std::nullopt;
    }

    [[nodiscard]] bool has_family(Family family) const {
        return std::any_of(m_layout.sets.begin(), m_layout.sets.end(),
                           [family](const SpectralSet& set) { return set.family == family; });
    }

    void warn() {
        const bool emissive = has_family(Family::S0);
        const bool polarised = has_family(Family::S1) || has_family(Family::S2) || has_family(Family::S3);
        if (!m_out.layout_version && m_layout.dialect.name == kLayoutDialect)
            m_out.warnings.emplace_back(
                "no spectralLayoutVersion: read as version 1.0 from the channel names alone");
        else if (m_out.layout_version && *m_out.layout_version != kWrittenLayoutVersion)
            m_out.warnings.push_back("spectralLayoutVersion is \"" + *m_out.layout_version +
                                     "\", not 1.0: read as version 1.0");
        if (emissive && !m_out.emissive_units)
            m_out.warnings.emplace_back("no emissiveUnits: taken as W.m^-2.sr^-1 per nanometre");
        else if (emissive && std::find(kKnownEmissiveUnits.begin(), kKnownEmissiveUnits.end(),
                                       *m_out.emissive_units) == kKnownEmissiveUnits.end())
            m_out.warnings.push_back("emissiveUnits is \"" + *m_out.emissive_units +
                                     "\", which the layout does not know: taken as W.m^-2.sr^-1 per "
                                     "nanometre");
        if (m_out.handedness && *m_out.handedness != "left" && *m_out.handedness != "right")
            m_out.warnings.push_back("polarisationHandedness is \"" + *m_out.handedness +
                                     "\", expected left or right");
        if (polarised && !emissive)
            m_out.warnings.emplace_back("S1, S2 or S3 without S0: the intensity is missing");
    }

    const ChannelLayout& m_layout;
    const TextAttributes& m_attributes;
    SpectralMetadata m_out;
};

}  // namespace

SpectralMetadata read_spectral_metadata(const ChannelLayout& layout, const TextAttributes& attributes) {
    return Reader(layout, attributes).read();
}

bool describes_bands(std::string_view attribute_name) {
    constexpr std::array<std::string_view, 7> kOwn{attribute::kReduction,     attribute::kLayoutVersion,
                                                   attribute::kEmissiveUnits, attribute::kHandedness,
                                                   attribute::kExposureValue, attribute::kLensTransmission,
                                                   attribute::kCameraResponse};
    return std::find(kOwn.begin(), kOwn.end(), attribute_name) != kOwn.end() ||
           parse_channel_name(attribute_name, DecimalMark::Comma).has_value();
}

}  // namespace osio
