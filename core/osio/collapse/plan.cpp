// SPDX-License-Identifier: Apache-2.0
#include <osio/base/fingerprint.h>
#include <osio/base/text.h>
#include <osio/collapse/plan.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace osio {

namespace {

/// A share of extrapolated weight above this is worth a warning.
constexpr double kExtrapolationWarning = 0.05;

/// The distinct wavelengths of the bands, and for each band which of them it belongs to.
struct DistinctBands {
    std::vector<double> wavelengths_nm;
    std::vector<std::size_t> index_of_band;
    std::vector<std::size_t> bands_at;  ///< how many bands share a wavelength
};

DistinctBands distinct(const std::vector<Band>& bands) {
    DistinctBands out;
    for (const Band& band : bands) {
        if (out.wavelengths_nm.empty() || out.wavelengths_nm.back() != band.wavelength_nm) {
            out.wavelengths_nm.push_back(band.wavelength_nm);
            out.bands_at.push_back(0);
        }
        ++out.bands_at.back();
        out.index_of_band.push_back(out.wavelengths_nm.size() - 1);
    }
    return out;
}

/// The light that multiplies the samples: the illuminant on a reflectance, 1 on a radiance.
NmSamples light_on(const std::optional<Illuminant>& illuminant) {
    if (illuminant)
        return illuminant->power;
    NmSamples ones{};
    ones.fill(1.0);
    return ones;
}

Result<Illuminant> load_illuminant(const std::string& name, const TextLoader& load_text) {
    if (!is_table_path(name))
        return find_illuminant(name);
    OSIO_TRY(const std::string csv, load_text(name));
    return illuminant_from_csv(csv, name);
}

Result<Vector3> parse_white(const std::string& text, const Observer& observer, Quadrature quadrature,
                            const TextLoader& load_text) {
    const auto pieces = split(text, ',');
    const auto x = pieces.size() == 2 ? parse_double(trim(pieces[0])) : std::nullopt;
    const auto y = pieces.size() == 2 ? parse_double(trim(pieces[1])) : std::nullopt;
    if (!x && !y) {
        OSIO_TRY(const Illuminant light, load_illuminant(text, load_text));
        return white_point(light, observer, quadrature);
    }
    if (!x || !y || *x <= 0 || *y <= 0 || *x + *y > 1)
        return fail(ErrorCode::Usage, "white \"" + text +
                                          "\" is no chromaticity: expected x,y with x > 0, y > 0 and "
                                          "x + y <= 1, such as 0.3127,0.3290");
    return Chromaticity{*x, *y}.xyz();
}

Result<void> check_quantity(const SpectralSet& set, const CollapseRequest& request) {
    if (set.quantity() == Quantity::Reflectance && request.illuminant.empty())
        return fail(ErrorCode::MissingIlluminant,
                    "set " + set.name() +
                        " is a reflectance, which has no colour without a light; name one with "
                        "illuminant=D65 (osiotool list illuminants)");
    if (set.quantity() == Quantity::Radiance && !request.illuminant.empty())
        return fail(ErrorCode::UnexpectedIlluminant,
                    "set " + set.name() +
                        " is a radiance, which already holds its light; leave "
                        "illuminant=" +
                        request.illuminant + " out");
    return {};
}

Result<void> check_grid(const SpectralSet& set, const CollapseRequest& request,
                        const std::vector<double>& nm) {
    if (nm.empty())
        return fail(ErrorCode::InvalidGrid, "set " + set.name() + " holds no band");
    const std::string range = format_double(nm.front()) + "-" + format_double(nm.back()) + " nm";
    if (nm.front() > kObserverLastNm || nm.back() < kObserverFirstNm)
        return fail(ErrorCode::BandsOutsideObserver, "the bands of set " + set.name() + " cover " + range +
                                                         ", nothing of the 360-830 nm that an observer sees");
    if (nm.size() == 1 && request.extrapolation == Extrapolation::Zero)
        return fail(ErrorCode::InvalidGrid,
                    "set " + set.name() + " has one wavelength, " + format_double(nm[0]) +
                        " nm: with extrapolate=zero its spectrum has no width; use extrapolate=hold");
    return {};
}

Result<void> check_names(const CollapseRequest& request) {
    if (request.names == OutputNames::Layout)
        return fail(ErrorCode::Usage,
                    "names=layout is for bands; with to=" + request.to->id + " use rgb or xyz");
    if (request.names == OutputNames::Xyz && request.to->kind != SpaceKind::Xyz &&
        request.to->kind != SpaceKind::XyzD65)
        return fail(ErrorCode::Usage,
                    "names=xyz does not fit to=" + request.to->id + ", whose values are " +
                        (request.to->kind == SpaceKind::Rgb ? "red, green and blue"
                                                            : join(space_outputs(request.to->kind), ", ")));
    if (request.adaptation != CollapseRequest{}.adaptation && !is_adapted(request.to->kind))
        return fail(ErrorCode::Usage, "adapt=" + std::string(adaptation_name(request.adaptation)) +
                                          " does not fit to=" + request.to->id + ", which is not adapted");
    if (!request.white.empty() && request.to->kind == SpaceKind::Xyz)
        return fail(ErrorCode::Usage,
                    "white=" + request.white + " does not fit to=xyz, which is not adapted; use to=xyz_d65");
    return {};
}

/// Makes a plan, step by step; each step reads what the ones before it have set.
class PlanMaker {
  public:
    PlanMaker(const SpectralSet& set, const CollapseRequest& request, const TextLoader& load_text)
        : m_set(set), m_load_text(load_text) {
        m_plan.request = request;
        m_plan.request.set = set.name();
        m_plan.bands = set.bands;
    }

    Result<CollapsePlan> make() {
        OSIO_CHECK_OK(check());
        OSIO_CHECK_OK(look_up());
        OSIO_CHECK_OK(choose_matrix());
        weigh_bands();
        measure_extrapolation();
        name_it();
        return std::move(m_plan);
    }

  private:
    Result<void> check() {
        if (!m_plan.request.to)
            return fail(ErrorCode::Usage,
                        "no space to collapse to was named; use to=" + join(output_space_names(), ", to="));
        m_plan.space = *m_plan.request.to;
        m_plan.outputs = space_outputs(m_plan.space.kind);
        OSIO_CHECK_OK(check_names(m_plan.request));
        OSIO_CHECK_OK(check_quantity(m_set, m_plan.request));
        m_distinct = distinct(m_plan.bands);
        return check_grid(m_set, m_plan.request, m_distinct.wavelengths_nm);
    }

    Result<void> look_up() {
        OSIO_TRY(m_plan.observer, find_observer(m_plan.request.observer));
        if (!m_plan.request.illuminant.empty()) {
            OSIO_TRY(m_plan.illuminant, load_illuminant(m_plan.request.illuminant, m_load_text));
            m_plan.request.illuminant = m_plan.illuminant->id;
        }
        m_light = light_on(m_plan.illuminant);
        m_plan.quadrature = quadrature_for(m_distinct.wavelengths_nm);
        return {};
    }

    /// outputs = m_output_from_xyz x (X, Y, Z of the light's own white at Y = 1).
    Result<void> choose_matrix() {
        const double gain = std::exp2(m_plan.request.exposure_stops);
        Vector3 white = kD65.xyz();  // radiance counts as D65-referred
        if (m_plan.illuminant) {
            OSIO_TRY(white, white_point(*m_plan.illuminant, m_plan.observer, m_plan.quadrature));
        }
        if (!m_plan.request.white.empty()) {
            OSIO_TRY(white,
                     parse_white(m_plan.request.white, m_plan.observer, m_plan.quadrature, m_load_text));
        }
        m_output_from_xyz = Matrix3::diagonal({gain, gain, gain});
        m_plan.white = white;
        if (m_plan.space.kind == SpaceKind::Lab && !(white[0] > 0 && white[2] > 0))
            return fail(ErrorCode::InvalidGrid, "the white has X " + format_double(white[0]) + " and Z " +
                                                    format_double(white[2]) +
                                                    ", and Lab divides by them; name another with white=");
        if (!is_adapted(m_plan.space.kind))
            return {};
        m_plan.adapted_from = white;
        const bool rgb = m_plan.space.kind == SpaceKind::Rgb;
        const Vector3 target = (rgb ? m_plan.space.white : kD65).xyz();
        OSIO_TRY(const Matrix3 adapt, adaptation_matrix(m_plan.request.adaptation, white, target));
        m_output_from_xyz = m_output_from_xyz * adapt;
        if (rgb)
            m_output_from_xyz = inverse(xyz_from_rgb(m_plan.space)) * m_output_from_xyz;
        return {};
    }

    void weigh_bands() {
        const auto& y = m_plan.observer.curves[1];
        const double k = 1 / integral(m_light, y, m_plan.quadrature);
        std::array<std::vector<double>, 3> xyz;
        for (std::size_t c = 0; c < 3; ++c)
            xyz[c] = linear_basis_integrals(m_distinct.wavelengths_nm, m_light, m_plan.observer.curves[c],
                                            m_plan.request.extrapolation, m_plan.quadrature);
        m_plan.weights = WeightMatrix(3, m_plan.bands.size());
        for (std::size_t band = 0; band < m_plan.bands.size(); ++band) {
            const std::size_t i = m_distinct.index_of_band[band];
            // Bands that share a wavelength share its weight: the collapse takes their mean.
            const double scale = k / static_cast<double>(m_distinct.bands_at[i]);
            const Vector3 out =
                m_output_from_xyz * Vector3{scale * xyz[0][i], scale * xyz[1][i], scale * xyz[2][i]};
            for (std::size_t row = 0; row < 3; ++row)
                m_plan.weights.at(row, band) = out[row];
        }
    }

    /// Share of an output's absolute weight, wavelength by wavelength, that lies beyond the bands.
    void measure_extrapolation() {
        const double first = m_distinct.wavelengths_nm.front();
        const double last = m_distinct.wavelengths_nm.back();
        Vector3 outside{}, all{};
        for (std::size_t i = 0; i < kObserverSampleCount; ++i) {
            const double nm = kObserverFirstNm + static_cast<double>(i);
            const auto& c = m_plan.observer.curves;
            const Vector3 weight =
                m_output_from_xyz * Vector3{m_light[i] * c[0][i], m_light[i] * c[1][i], m_light[i] * c[2][i]};
            for (std::size_t row = 0; row < 3; ++row) {
                all[row] += std::abs(weight[row]);
                if (nm < first || nm > last)
                    outside[row] += std::abs(weight[row]);
            }
        }
        for (std::size_t row = 0; row < 3; ++row)
            m_plan.extrapolated_share.push_back(all[row] > 0 ? outside[row] / all[row] : 0);
        warn_of_extrapolation(std::max(0.0, first - kObserverFirstNm), std::max(0.0, kObserverLastNm - last));
    }

    void warn_of_extrapolation(double below_nm, double above_nm) {
        if (below_nm + above_nm <= 0)
            return;
        const auto& share = m_plan.extrapolated_share;
        const double largest = *std::max_element(share.begin(), share.end());
        std::string text = format_double(below_nm) + " nm below and " + format_double(above_nm) +
                           " nm above the bands are extrapolated (" +
                           std::string(extrapolation_name(m_plan.request.extrapolation)) + "): ";
        if (largest == 0) {
            text += "no output has weight there";
        } else if (largest <= kExtrapolationWarning) {
            text += "at most " + format_fixed(std::ceil(1e4 * largest) / 100, 2) + " % of an output's weight";
        } else {
            text += "much of the weight rests on it,";
            for (std::size_t row = 0; row < share.size(); ++row)
                text += " " + m_plan.weighed()[row] + " " + format_fixed(100 * share[row], 1) + " %";
        }
        m_plan.warnings.push_back(text);
    }

    void name_it() {
        Fingerprint id;
        id.add(recipe_text(m_plan.request)).add(m_plan.observer.sha256);
        if (m_plan.illuminant)
            id.add(m_plan.illuminant->digest);
        for (const Band& band : m_plan.bands)
            id.add(band.wavelength_nm);
        for (std::size_t row = 0; row < m_plan.weights.rows(); ++row)
            for (const double weight : m_plan.weights.row(row))
                id.add(weight);
        m_plan.id = id.hex();
    }

    const SpectralSet& m_set;
    const TextLoader& m_load_text;
    CollapsePlan m_plan;
    DistinctBands m_distinct;
    NmSamples m_light{};
    Matrix3 m_output_from_xyz;
};

}  // namespace

std::vector<double> CollapsePlan::wavelengths_nm() const {
    std::vector<double> out;
    for (const Band& band : bands)
        out.push_back(band.wavelength_nm);
    return out;
}

std::vector<std::string> CollapsePlan::weighed() const {
    return is_tristimulus(space.kind) ? outputs : space_outputs(SpaceKind::Xyz);
}

std::vector<std::string> CollapsePlan::channel_names() const {
    if (request.names == OutputNames::Xyz)
        return {"X", "Y", "Z"};
    if (request.names == OutputNames::Default && !is_tristimulus(space.kind))
        return outputs;
    return {"R", "G", "B"};
}

Result<CollapsePlan> make_plan(const SpectralSet& set, const CollapseRequest& request,
                               const TextLoader& load_text) {
    return PlanMaker(set, request, load_text).make();
}

}  // namespace osio
