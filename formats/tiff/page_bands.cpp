// SPDX-License-Identifier: Apache-2.0
#include <formats/tiff/attribute_items.h>
#include <formats/tiff/item_names.h>
#include <formats/tiff/page_bands.h>
#include <formats/tiff/xmp_bands.h>

#include <osio/base/text.h>
#include <osio/layout/spectral_metadata.h>
#include <osio/spectra/wavelength_unit.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace osio::tiff {

namespace {

/// Two statements of a wavelength that differ by more are said aloud.
constexpr double kSameNm = 0.5;

tl::unexpected<Error> no_number(std::string_view name, std::string_view text) {
    return fail(ErrorCode::Damaged, "found \"" + std::string(text.substr(0, 40)) + "\" in \"" +
                                        std::string(name) + "\" of its GDAL metadata, expected a number");
}

/// Gathers what items say, by sample.
class Reader {
  public:
    Reader(const Page& page, std::vector<GdalItem> items)
        : m_page(page), m_items(std::move(items)), m_count(page.samples) {
        m_out.facts.resize(m_count);
        m_out.scaling.resize(m_count);
    }

    [[nodiscard]] Result<PageBands> read() {
        std::erase_if(m_items, [this](const GdalItem& item) {
            const bool beyond = item.sample && *item.sample >= m_count;
            m_beyond += beyond;
            return beyond;
        });
        if (m_beyond > 0)
            warn(std::to_string(m_beyond) + " items of GDAL's metadata are of samples that are not there");
        m_used.resize(m_items.size());
        OSIO_CHECK_OK(read_wavelengths());
        OSIO_CHECK_OK(read_bad_bands());
        OSIO_CHECK_OK(read_scaling());
        OSIO_CHECK_OK(read_no_data());
        read_quantity();
        keep_others();
        return std::move(m_out);
    }

  private:
    struct Source {
        std::string name;
        std::vector<double> nm;  ///< one a sample, 0 for none; empty: the source is silent
    };

    void warn(std::string text) { m_out.warnings.push_back(std::move(text)); }

    /// Of each sample the text of an item, by its names in GDAL's own domain or another; else the list of the image.
    template <std::size_t N>
    [[nodiscard]] Result<std::vector<std::string>> texts(const std::array<std::string_view, N>& names,
                                                         bool as_list = true) {
        std::vector<std::string> out;
        for (GdalItem& item : m_items)
            if (item.sample && item.domain.empty() && is_one_of(normal_name(item.name), names)) {
                out.resize(m_count);
                out[*item.sample] = trim(item.value);
                use(item);
            }
        if (!out.empty() || !as_list)
            return out;
        for (GdalItem& item : m_items)
            if (!item.sample && (item.domain.empty() || iequals(item.domain, "ENVI")) &&
                is_one_of(normal_name(item.name), names)) {
                out = list_of(item.value);
                if (out.size() != m_count)
                    return fail(ErrorCode::Damaged, "found " + std::to_string(out.size()) + " items of \"" +
                                                        item.name + "\" of its GDAL metadata for " +
                                                        std::to_string(m_count) + " samples");
                use(item);
                return out;
            }
        return out;
    }

    /// The numbers of texts; 0 for an empty one.
    [[nodiscard]] static Result<std::vector<double>> numbers(std::string_view name,
                                                             const std::vector<std::string>& texts) {
        std::vector<double> out;
        for (const std::string& text : texts) {
            const auto value = text.empty() ? std::optional(0.0) : parse_double(text);
            if (!value)
                return no_number(name, text);
            out.push_back(*value);
        }
        return out;
    }

    [[nodiscard]] Result<Source> stated_wavelengths() {
        Source out{"wavelength", {}};
        OSIO_TRY(auto words, texts(kWavelengthNames));
        if (words.empty())
            return out;
        // "450.5 nm" says its unit itself.
        std::vector<std::optional<double>> own(m_count);
        for (std::size_t sample = 0; sample < m_count; ++sample)
            if (const auto named = wavelengths_in(words[sample]);
                named.size() == 1 && !parse_double(words[sample])) {
                own[sample] = named.front();
                words[sample].clear();
            }
        OSIO_TRY(const auto values, numbers(out.name, words));
        OSIO_TRY(m_units, units_of(values, own));
        OSIO_TRY(const auto widths_text, texts(std::array<std::string_view, 1>{"fwhm"}));
        OSIO_TRY(const auto widths, numbers("fwhm", widths_text));
        for (std::size_t sample = 0; sample < m_count; ++sample) {
            const WavelengthUnit unit = m_units[sample];
            out.nm.push_back(own[sample] ? *own[sample] : unit.empty() ? 0 : nm_of(words[sample], unit));
            if (!widths.empty() && out.nm.back() > 0)
                m_out.facts[sample].fwhm_nm = width_nm(widths[sample], values[sample], out.nm.back(), unit);
        }
        return out;
    }

    /// The unit of each sample's number; empty where the numbers are no wavelengths.
    [[nodiscard]] Result<std::vector<WavelengthUnit>>
    units_of(const std::vector<double>& values, const std::vector<std::optional<double>>& own) {
        OSIO_TRY(auto words, texts(kUnitNames, false));
        if (words.empty()) {
            words.resize(m_count);
            for (GdalItem& item : m_items)
                if (!item.sample && is_one_of(normal_name(item.name), kUnitNames)) {
                    words.assign(m_count, std::string(trim(item.value)));
                    use(item);
                }
        }
        const WavelengthUnit likely = likely_unit(values);
        std::vector<WavelengthUnit> out;
        std::string assumed;
        for (std::size_t sample = 0; sample < m_count; ++sample) {
            const auto unit = find_wavelength_unit(words[sample]);
            const bool index = iequals(words[sample], "index");
            if (!unit && !index && !own[sample] && values[sample] > 0)
                assumed = words[sample].empty()
                              ? "no \"wavelength_units\""
                              : "\"wavelength_units\" are \"" + words[sample].substr(0, 40) + "\"";
            out.push_back(unit          ? *unit
                          : index       ? WavelengthUnit()
                          : own[sample] ? WavelengthUnit("nm")
                                        : likely);
        }
        if (!assumed.empty())
            warn(assumed + ": the wavelengths are taken as " +
                 (likely == "um" ? "micrometres" : "nanometres"));
        return out;
    }

    /// GDAL's own names since 3.10: domain IMAGERY, micrometres.
    [[nodiscard]] Result<Source> imagery_wavelengths() {
        Source out{"CENTRAL_WAVELENGTH_UM", {}};
        for (GdalItem& item : m_items) {
            if (!item.sample || item.domain != "IMAGERY")
                continue;
            const bool centre = item.name == out.name;
            if (!centre && item.name != "FWHM_UM")
                continue;
            const auto value = parse_double(trim(item.value));
            if (!value)
                return no_number(item.name, item.value);
            use(item);
            const double nm = nm_of(trim(item.value), "um");
            if (centre) {
                out.nm.resize(m_count);
                out.nm[*item.sample] = nm;
            } else if (m_out.facts[*item.sample].fwhm_nm == 0) {
                m_out.facts[*item.sample].fwhm_nm = nm;
            }
        }
        return out;
    }

    /// What descriptions of samples, or of the image `Band_1`, ..., name.
    [[nodiscard]] Source described_wavelengths() {
        Source out{"DESCRIPTION", {}};
        for (GdalItem& item : m_items) {
            std::optional<std::size_t> sample;
            if (item.sample && item.domain.empty() &&
                (item.role == "description" || item.name == "DESCRIPTION"))
                sample = item.sample;
            else if (!item.sample && item.domain.empty() && item.name.starts_with("Band_"))
                if (const auto number = parse_int(std::string_view(item.name).substr(5));
                    number && *number >= 1 && static_cast<std::size_t>(*number) <= m_count)
                    sample = static_cast<std::size_t>(*number - 1);
            if (!sample)
                continue;
            use(item);
            if (const auto named = wavelengths_in(item.value); named.size() == 1) {
                out.nm.resize(m_count);
                out.nm[*sample] = named.front();
            }
        }
        return out;
    }

    [[nodiscard]] Source named_wavelength() {
        Source out{{}, {}};
        if (m_count == 1)
            for (const char* name : {"ImageDescription", "PageName", "DocumentName"})
                if (const auto named = wavelengths_in(m_page.text(name)); named.size() == 1)
                    return {name, {named.front()}};
        return out;
    }

    [[nodiscard]] Result<void> read_wavelengths() {
        std::vector<Source> sources;
        OSIO_TRY(Source stated, stated_wavelengths());
        sources.push_back(std::move(stated));
        OSIO_TRY(Source imagery, imagery_wavelengths());
        sources.push_back(std::move(imagery));
        sources.push_back(described_wavelengths());
        if (m_count == 1)
            if (const XmpBand camera = read_xmp_band(m_page.xmp); camera.wavelength_nm > 0) {
                sources.push_back({"Camera:CentralWavelength", {camera.wavelength_nm}});
                if (m_out.facts[0].fwhm_nm == 0)
                    m_out.facts[0].fwhm_nm = camera.fwhm_nm;
            }
        sources.push_back(named_wavelength());
        std::erase_if(sources, [](const Source& source) {
            return std::all_of(source.nm.begin(), source.nm.end(), [](double nm) { return nm == 0; });
        });
        if (sources.empty())
            return {};
        const Source& first = sources.front();
        for (std::size_t sample = 0; sample < m_count; ++sample)
            m_out.facts[sample].wavelength_nm = first.nm[sample];
        for (auto other = sources.begin() + 1; other != sources.end(); ++other)
            for (std::size_t sample = 0; sample < m_count; ++sample)
                if (other->nm[sample] > 0 && std::abs(other->nm[sample] - first.nm[sample]) > kSameNm) {
                    warn("sample " + std::to_string(sample) + " has " + format_double(first.nm[sample]) +
                         " nm by \"" + first.name + "\" and " + format_double(other->nm[sample]) +
                         " nm by \"" + other->name + "\": \"" + first.name + "\" is taken");
                    break;
                }
        return {};
    }

    [[nodiscard]] Result<void> read_bad_bands() {
        OSIO_TRY(const auto words, texts(std::array<std::string_view, 1>{"bbl"}));
        if (words.empty())
            return {};
        for (std::size_t sample = 0; sample < m_count; ++sample) {
            const auto value = words[sample].empty() ? std::optional(1.0) : parse_double(words[sample]);
            if (!value)
                return no_number("bbl", words[sample]);
            m_out.facts[sample].bad = *value == 0;
        }
        return {};
    }

    [[nodiscard]] Result<void> read_scaling() {
        for (GdalItem& item : m_items) {
            const std::string name = normal_name(item.name);
            const bool scale = name == "scale", offset = name == "offset";
            const bool divisor = name == "reflectance_scale_factor" && !item.sample;
            if (!(divisor || (item.sample && item.domain.empty() && (scale || offset))))
                continue;
            const auto value = parse_double(trim(item.value));
            if (!value || (divisor && *value == 0))
                return no_number(item.name, item.value);
            use(item);
            if (scale)
                m_out.scaling[*item.sample].gain = *value;
            else if (offset)
                m_out.scaling[*item.sample].offset = *value;
            else
                m_divisor = *value;
        }
        const bool scaled = std::any_of(m_out.scaling.begin(), m_out.scaling.end(),
                                        [](const image::Scaling& scaling) { return !scaling.identity(); });
        if (m_divisor && scaled)
            warn("samples have a SCALE or OFFSET: \"reflectance_scale_factor\" is not applied");
        else if (m_divisor)
            for (image::Scaling& scaling : m_out.scaling)
                scaling.divisor = *m_divisor;
        return {};
    }

    [[nodiscard]] Result<void> read_no_data() {
        const std::string word = to_lower(trim(m_page.gdal_no_data));
        if (word.empty() || word == "nan" || word == "-nan")
            return {};
        std::optional<double> value = parse_double(word);
        if (word == "inf" || word == "-inf")
            value = std::numeric_limits<double>::infinity() * (word == "inf" ? 1 : -1);
        if (!value) {
            warn("its no-data value (tag 42113) is \"" + word.substr(0, 40) + "\", no number: ignored");
            return {};
        }
        // Written with the digits of the numbers' own type.
        if (m_page.type == image::NumberType::Float &&
            std::abs(*value) <= double{std::numeric_limits<float>::max()})
            value = static_cast<double>(static_cast<float>(*value));
        for (image::Scaling& scaling : m_out.scaling)
            scaling.ignore = value;
        warn("numbers that are " + word.substr(0, 40) + ", the no-data value, are NaN");
        return {};
    }

    /// The first that says reflectance or radiance; a factor that reflectances are stored with means those.
    void read_quantity() {
        bool unit_is_attribute = false;
        for (const GdalItem& item : m_items)
            unit_is_attribute =
                unit_is_attribute || (item.domain == kExrDomain && item.name == "string emissiveUnits");
        if (m_divisor)
            m_out.quantity = Quantity::Reflectance;
        const auto consider = [&](GdalItem& item) {
            const auto quantity = image::quantity_in(item.value);
            if (m_out.quantity || !quantity)
                return;
            m_out.quantity = quantity;
            use(item);
            if (iequals(trim(item.value), "radiance")) {
                if (!unit_is_attribute)
                    warn("\"" + item.name + "\" names no unit: radiance is taken as " +
                         std::string(kWrittenEmissiveUnits) + " per nm");
            } else if (quantity == Quantity::Radiance) {
                m_out.units = trim(item.value);
            }
        };
        for (GdalItem& item : m_items)
            if (!item.sample && (item.domain.empty() || iequals(item.domain, "ENVI")) &&
                is_one_of(normal_name(item.name), kQuantityNames))
                consider(item);
        for (GdalItem& item : m_items)
            if (item.sample && item.role == "unittype")
                consider(item);
    }

    void use(const GdalItem& item) { m_used[static_cast<std::size_t>(&item - m_items.data())] = true; }

    /// Items of the image go on as attributes; of samples there is no place to keep them.
    void keep_others() {
        std::vector<std::string> lost;
        for (std::size_t i = 0; i < m_items.size(); ++i) {
            const GdalItem& item = m_items[i];
            if (m_used[i] || item.role == "unittype" || item.role == "description")
                continue;
            if (!item.sample)
                m_out.others.push_back(item);
            else if (std::find(lost.begin(), lost.end(), item.name) == lost.end())
                lost.push_back(item.name);
        }
        if (!lost.empty())
            warn("items of samples that are not read: " + join(lost, ", "));
    }

    const Page& m_page;
    std::vector<GdalItem> m_items;
    std::size_t m_count;
    std::size_t m_beyond = 0;
    std::vector<bool> m_used;  ///< by item: its meaning is in m_out
    std::vector<WavelengthUnit> m_units;
    std::optional<double> m_divisor;
    PageBands m_out;
};

}  // namespace

bool PageBands::spectral() const {
    return std::any_of(facts.begin(), facts.end(),
                       [](const image::BandFacts& band) { return band.wavelength_nm > 0; });
}

Result<PageBands> read_bands(const Page& page) {
    std::vector<GdalItem> items;
    if (!page.gdal_metadata.empty()) {
        OSIO_TRY(items, parse_gdal_metadata(page.gdal_metadata));
    }
    return Reader(page, std::move(items)).read();
}

}  // namespace osio::tiff
