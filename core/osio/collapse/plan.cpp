// SPDX-License-Identifier: Apache-2.0
#include <osio/base/fingerprint.h>
#include <osio/base/text.h>
#include <osio/collapse/plan.h>
#include <osio/collapse/plan_checks.h>
#include <osio/collapse/stokes_plan.h>
#include <osio/colour/adaptation.h>
#include <osio/colour/photometric_constants.h>
#include <osio/colour/polarisation.h>

#include <array>
#include <cmath>
#include <numeric>

namespace osio {

namespace {

/// Below this share of a light's power seen by an observer (an ultraviolet lamp, say) 1 / sum is noise.
constexpr double kSmallestSeenShare = 1e-9;

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

/// A display's primaries and white as chromaticities.
OutputSpace described_by(const Matrix3& xyz_from_rgb, OutputSpace space) {
    const auto chromaticity = [&](const Vector3& rgb) {
        const Vector3 xyz = xyz_from_rgb * rgb;
        const double sum = xyz[0] + xyz[1] + xyz[2];
        return Chromaticity{xyz[0] / sum, xyz[1] / sum};
    };
    space.red = chromaticity({1, 0, 0});
    space.green = chromaticity({0, 1, 0});
    space.blue = chromaticity({0, 0, 1});
    space.white = chromaticity({1, 1, 1});
    return space;
}

/// Makes a plan, step by step; each step reads what the ones before it have set.
class PlanMaker {
  public:
    PlanMaker(const SpectralSet& set, const SpectralMetadata& metadata, const CollapseRequest& request,
              const TextLoader& load_text)
        : m_set(set), m_metadata(metadata), m_load_text(load_text) {
        m_plan.request = request;
        m_plan.request.set = set.name();
        m_plan.has_sign = set.family == Family::S1 || set.family == Family::S2 || set.family == Family::S3;
        m_plan.bands = set.bands;
        for (const Band& band : set.bands)
            m_plan.columns.push_back({band.channel, band.wavelength_nm, std::nullopt});
        for (const Reradiation& pair : set.reradiation)
            m_plan.columns.push_back({pair.channel, pair.excited_nm, pair.emitted_nm});
    }

    Result<CollapsePlan> make() {
        OSIO_CHECK_OK(check());
        OSIO_CHECK_OK(look_up());
        OSIO_CHECK_OK(decide_basis());
        OSIO_CHECK_OK(choose_white());
        OSIO_CHECK_OK(choose_matrix());
        OSIO_CHECK_OK(weigh_bands());
        OSIO_CHECK_OK(weigh_reradiation());
        measure_extrapolation();
        name_it();
        return std::move(m_plan);
    }

  private:
    Result<void> check() {
        OSIO_CHECK_OK(check_request(m_plan.request));
        OSIO_CHECK_OK(check_quantity(m_set, m_plan.request));
        m_plan.space = *m_plan.request.to;
        m_plan.outputs = space_outputs(m_plan.space.transform ? SpaceKind::Rgb : m_plan.space.kind);
        m_plan.distinct = distinct_bands(m_set, m_metadata);
        return check_grid(m_set, m_plan.distinct.grid.wavelengths_nm);
    }

    Result<void> look_up() {
        const CollapseRequest& request = m_plan.request;
        OSIO_TRY(m_plan.observer, load_observer(request.observer));
        OSIO_CHECK_OK(check_observer(m_plan.observer, m_plan.space));
        if (!request.illuminant.empty()) {
            OSIO_TRY(m_plan.illuminant, load_illuminant(request.illuminant, m_load_text));
            m_plan.request.illuminant = m_plan.illuminant->id;
        }
        m_light.fill(1.0);  // on a radiance
        if (m_plan.illuminant)
            m_light = m_plan.illuminant->power;
        m_filtered = m_light;
        for (const std::string& path : request.filters) {
            OSIO_TRY(const std::string csv, m_load_text(path));
            OSIO_TRY(Filter filter, filter_from_csv(csv, path));
            for (std::size_t i = 0; i < m_filtered.size(); ++i)
                m_filtered[i] *= filter.transmittance[i];
            m_plan.filters.push_back(std::move(filter));
        }
        if (!request.display.empty()) {
            OSIO_TRY(const std::string csv, m_load_text(request.display));
            OSIO_TRY(m_plan.display, display_from_csv(csv, request.display));
        }
        return {};
    }

    [[nodiscard]] Result<Observer> load_observer(const std::string& name) const {
        if (!is_table_path(name))
            return find_observer(name);
        OSIO_TRY(const std::string csv, m_load_text(name));
        return camera_from_csv(csv, name);
    }

    Result<void> decide_basis() {
        OSIO_TRY(m_plan.basis, choose_basis(m_plan.request.basis, m_set, m_plan.distinct.grid, m_metadata));
        if (m_plan.basis.warning)
            m_plan.warnings.push_back(*m_plan.basis.warning);
        m_plan.quadrature = quadrature_for(m_plan.basis.basis, m_plan.distinct.grid.wavelengths_nm);
        OSIO_CHECK_OK(check_width(m_plan));
        const auto [first, last] = covered();
        return check_light(m_plan, m_filtered, first, last);
    }

    /// The white that adaptation starts from, and that Lab and its like refer to.
    Result<void> choose_white() {
        if (m_plan.observer.kind != ObserverKind::Colorimetric)
            return {};
        Vector3 white = kD65.xyz();  // radiance counts as D65-referred
        if (m_plan.display)          // but a display shows its very colour
            white = m_plan.display->xyz_from_rgb(m_plan.observer) * Vector3{1, 1, 1};
        if (m_plan.illuminant) {
            OSIO_TRY(white, white_point(*m_plan.illuminant, m_plan.observer, m_plan.quadrature));
        }
        if (!m_plan.request.white.empty()) {
            OSIO_TRY(white,
                     parse_white(m_plan.request.white, m_plan.observer, m_plan.quadrature, m_load_text));
        }
        m_plan.white = white;
        const SpaceKind kind = m_plan.space.kind;
        if (kind == SpaceKind::Lab && !(white[0] > 0 && white[2] > 0))
            return fail(ErrorCode::InvalidGrid, "the white has X " + format_double(white[0]) + " and Z " +
                                                    format_double(white[2]) +
                                                    ", and Lab divides by them; name another with white=");
        if (is_adapted(kind))
            m_plan.adapted_from = white;
        return {};
    }

    /// outputs = m_output_from_curves x the three integrals with the observer's curves.
    Result<void> choose_matrix() {
        OSIO_TRY(const Vector3 k, normalisation());
        const double gain = std::exp2(m_plan.request.exposure_stops);
        const Matrix3 scaled = Matrix3::diagonal({gain * k[0], gain * k[1], gain * k[2]});
        m_output_from_curves = scaled;
        if (is_single(m_plan.space.kind))
            m_output_from_curves.rows[0] = scaled.rows[1];
        if (!is_adapted(m_plan.space.kind))
            return {};
        Vector3 target = kD65.xyz();
        Matrix3 output_from_xyz = Matrix3::identity();
        if (m_plan.space.kind == SpaceKind::Rgb) {
            target = m_plan.space.white.xyz();
            output_from_xyz = inverse(xyz_from_rgb(m_plan.space));
        } else if (m_plan.display) {
            const Matrix3 xyz_from_display = m_plan.display->xyz_from_rgb(m_plan.observer);
            target = xyz_from_display * Vector3{1, 1, 1};
            output_from_xyz = inverse(xyz_from_display);
            m_plan.space = described_by(xyz_from_display, m_plan.space);
        }
        OSIO_TRY(const Matrix3 adapt,
                 adaptation_matrix(m_plan.request.adaptation, *m_plan.adapted_from, target));
        m_output_from_curves = output_from_xyz * adapt * scaled;
        return {};
    }

    /// What each integral is multiplied by.
    [[nodiscard]] Result<Vector3> normalisation() const {
        const Observer& observer = m_plan.observer;
        if (m_plan.request.scale == Scale::Integral)
            return Vector3{1, 1, 1};
        if (m_plan.request.scale == Scale::Photometric) {
            const double efficacy =
                observer.id == "scotopic" ? kScotopicEfficacyLmPerW : kLuminousEfficacyLmPerW;
            return Vector3{efficacy, efficacy, efficacy};
        }
        const NmSamples& light = m_plan.request.filter_normalise ? m_filtered : m_light;
        const double power = std::accumulate(light.begin(), light.end(), 0.0);
        const bool camera = observer.kind == ObserverKind::Camera;
        Vector3 out{};
        for (std::size_t c = 0; c < out.size(); ++c) {
            const double sum = integral(light, observer.curves[camera ? c : 1], m_plan.quadrature);
            if (!(sum > kSmallestSeenShare * power))
                return fail(ErrorCode::InvalidGrid,
                            "the light has nothing that " + observer.id +
                                " sees (the sum of its power times " + (camera ? "a sensitivity" : "y-bar") +
                                " is " + format_double(sum) + "), so nothing can be normalised by it",
                            m_plan.illuminant ? m_plan.illuminant->id : std::string());
            out[c] = 1 / sum;
        }
        return out;
    }

    Result<void> weigh_bands() {
        std::array<std::vector<double>, 3> integrals;
        for (std::size_t c = 0; c < 3; ++c) {
            integrals[c] =
                band_integrals(m_plan.basis.basis, m_plan.distinct.grid, m_filtered,
                               m_plan.observer.curves[c], m_plan.request.extrapolation, m_plan.quadrature);
            if (integrals[c].empty())
                return fail(ErrorCode::InvalidGrid,
                            "the responses of the bands do not tell them apart; use basis=linear");
        }
        m_plan.weights = WeightMatrix(m_plan.outputs.size(), m_plan.columns.size());
        for (std::size_t band = 0; band < m_plan.bands.size(); ++band) {
            const std::size_t i = m_plan.distinct.index_of_band[band];
            const double share = m_plan.distinct.share_of(band);
            set_column(band, {share * integrals[0][i], share * integrals[1][i], share * integrals[2][i]});
        }
        return {};
    }

    void set_column(std::size_t column, const Vector3& integrals) {
        const Vector3 out = m_output_from_curves * integrals;
        for (std::size_t row = 0; row < m_plan.weights.rows(); ++row)
            m_plan.weights.at(row, column) = out[row];
    }

    Result<void> weigh_reradiation() {
        if (m_set.reradiation.empty())
            return {};
        OSIO_TRY(m_plan.reradiation,
                 reradiation_weights(m_set, m_plan.basis.basis, m_plan.distinct.grid, *m_plan.illuminant,
                                     m_plan.filters, m_plan.observer));
        for (std::size_t pair = 0; pair < m_set.reradiation.size(); ++pair)
            set_column(m_plan.bands.size() + pair, m_plan.reradiation->integrals[pair]);
        for (const std::string& warning : m_plan.reradiation->warnings)
            m_plan.warnings.push_back(warning);
        return {};
    }

    /// Share of an output's absolute weight, wavelength by wavelength, that lies beyond the bands.
    void measure_extrapolation() {
        const auto [first, last] = covered();
        Vector3 outside{}, all{};
        for (std::size_t i = 0; i < kObserverSampleCount; ++i) {
            const double nm = kObserverFirstNm + static_cast<double>(i);
            const auto& c = m_plan.observer.curves;
            const Vector3 weight =
                m_output_from_curves *
                Vector3{m_filtered[i] * c[0][i], m_filtered[i] * c[1][i], m_filtered[i] * c[2][i]};
            for (std::size_t row = 0; row < 3; ++row) {
                all[row] += std::abs(weight[row]);
                if (nm < first || nm > last)
                    outside[row] += std::abs(weight[row]);
            }
        }
        for (std::size_t row = 0; row < m_plan.weights.rows(); ++row)
            m_plan.extrapolated_share.push_back(all[row] > 0 ? outside[row] / all[row] : 0);
        if (auto warning = extrapolation_warning(m_plan, first, last))
            m_plan.warnings.push_back(std::move(*warning));
    }

    /// The wavelengths that the bands say something about.
    [[nodiscard]] std::pair<double, double> covered() const {
        const BandGrid& grid = m_plan.distinct.grid;
        const bool binned = is_binned(m_plan.basis.basis) && (grid.size() > 1 || !grid.edges_nm.empty());
        const auto ends =
            binned && m_plan.basis.basis != Basis::Response ? grid.edges() : grid.wavelengths_nm;
        return {ends.front(), ends.back()};
    }

    void name_it() {
        Fingerprint id;
        CollapseRequest request = m_plan.request;
        request.config.clear();       // the processor says what it does, wherever the config lies
        request.max_delta_e.reset();  // what is proved of the weights does not change them
        request.white_luminance.reset();
        id.add(recipe_text(request)).add(m_plan.observer.digest);
        id.add(basis_name(m_plan.basis.basis));
        if (m_plan.illuminant)
            id.add(m_plan.illuminant->digest);
        for (const Filter& filter : m_plan.filters)
            id.add(filter.digest);
        if (m_plan.display)
            id.add(m_plan.display->digest);
        if (m_plan.space.transform)
            id.add(m_plan.space.color_space).add(m_plan.space.transform->source().processor);
        for (const PlanColumn& column : m_plan.columns) {
            id.add(column.wavelength_nm);
            if (column.emitted_nm)
                id.add(*column.emitted_nm);
        }
        for (std::size_t row = 0; row < m_plan.weights.rows(); ++row)
            for (const double weight : m_plan.weights.row(row))
                id.add(weight);
        m_plan.id = id.hex();
    }

    const SpectralSet& m_set;
    const SpectralMetadata& m_metadata;
    const TextLoader& m_load_text;
    CollapsePlan m_plan;
    NmSamples m_light{};     ///< what the samples are multiplied by, without filters
    NmSamples m_filtered{};  ///< with them
    Matrix3 m_output_from_curves;
};

}  // namespace

std::vector<double> CollapsePlan::wavelengths_nm() const {
    std::vector<double> out;
    for (const Band& band : bands)
        out.push_back(band.wavelength_nm);
    return out;
}

std::vector<std::string> CollapsePlan::weighed() const {
    if (space.transform)
        return space_outputs(space.kind);
    if (is_polarisation(space.kind)) {
        std::vector<std::string> out;
        for (const std::size_t component : stokes_components(space.kind))
            out.push_back("S" + std::to_string(component));
        return out;
    }
    return is_tristimulus(space.kind) ? outputs : space_outputs(SpaceKind::Xyz);
}

std::vector<std::string> CollapsePlan::channel_names() const {
    const bool own = is_single(space.kind) || !is_tristimulus(space.kind);
    if (own && request.names != OutputNames::Rgb)
        return outputs;
    if (request.names == OutputNames::Xyz)
        return {"X", "Y", "Z"};
    return {"R", "G", "B"};
}

Result<CollapsePlan> make_plan(const SpectralSet& set, const SpectralMetadata& metadata,
                               const CollapseRequest& request, const TextLoader& load_text) {
    return make_plan({&set, 1}, 0, metadata, request, load_text);
}

Result<CollapsePlan> make_plan(std::span<const SpectralSet> sets, std::size_t chosen,
                               const SpectralMetadata& metadata, const CollapseRequest& request,
                               const TextLoader& load_text) {
    const auto make = [&](const SpectralSet& set) {
        return PlanMaker(set, metadata, request, load_text).make();
    };
    if (request.to && is_polarimetric(request.to->kind))
        return make_stokes_plan(sets, chosen, request.to->kind, make);
    return make(sets[chosen]);
}

Result<CollapsePlan> make_plan(const SpectralSet& set, const CollapseRequest& request,
                               const TextLoader& load_text) {
    return make_plan(set, {}, request, load_text);
}

}  // namespace osio
