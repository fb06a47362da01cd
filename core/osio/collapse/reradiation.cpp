// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/collapse/reradiation.h>
#include <osio/spectra/bin_basis.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace osio {

namespace {

/// The wavelengths that a band stands for.
struct Cell {
    double lo_nm = 0;
    double centre_nm = 0;
    double hi_nm = 0;
};

enum class Shape { Triangle, Box };

/// Distinct wavelengths, increasing, and which of them each pair has.
struct Axis {
    std::vector<double> nm;
    std::vector<std::size_t> index_of_pair;

    [[nodiscard]] double mean_step_nm() const {
        return nm.size() < 2 ? 0 : (nm.back() - nm.front()) / static_cast<double>(nm.size() - 1);
    }
};

Axis axis_of(const std::vector<Reradiation>& pairs, double Reradiation::*wavelength) {
    Axis out;
    for (const Reradiation& pair : pairs)
        out.nm.push_back(pair.*wavelength);
    std::sort(out.nm.begin(), out.nm.end());
    out.nm.erase(std::unique(out.nm.begin(), out.nm.end()), out.nm.end());
    for (const Reradiation& pair : pairs)
        out.index_of_pair.push_back(static_cast<std::size_t>(
            std::lower_bound(out.nm.begin(), out.nm.end(), pair.*wavelength) - out.nm.begin()));
    return out;
}

/// The wavelengths with one more at each end, as far away as the next one inside; `step_nm` where there is
/// no next one.
std::vector<double> with_ends(const std::vector<double>& nm, double step_nm) {
    const std::size_t n = nm.size();
    std::vector<double> out{nm[0] - (n > 1 ? nm[1] - nm[0] : step_nm)};
    out.insert(out.end(), nm.begin(), nm.end());
    out.push_back(nm[n - 1] + (n > 1 ? nm[n - 1] - nm[n - 2] : step_nm));
    return out;
}

std::vector<Cell> cells_of(const std::vector<double>& nm, Shape shape, const BandGrid& bands,
                           double step_nm) {
    const std::vector<double> knots = with_ends(nm, step_nm);
    std::vector<Cell> out;
    for (std::size_t i = 0; i < nm.size(); ++i) {
        Cell cell{knots[i], nm[i], knots[i + 2]};
        if (shape == Shape::Box) {
            cell.lo_nm = (cell.lo_nm + nm[i]) / 2;
            cell.hi_nm = (cell.hi_nm + nm[i]) / 2;
            const auto stated = std::find(bands.wavelengths_nm.begin(), bands.wavelengths_nm.end(), nm[i]);
            if (!bands.edges_nm.empty() && stated != bands.wavelengths_nm.end()) {
                const auto bin = static_cast<std::size_t>(stated - bands.wavelengths_nm.begin());
                cell.lo_nm = bands.edges_nm[bin];
                cell.hi_nm = bands.edges_nm[bin + 1];
            }
        }
        out.push_back(cell);
    }
    return out;
}

double share_at(const Cell& cell, Shape shape, double nm) {
    if (shape == Shape::Box)
        return 1;
    return nm < cell.centre_nm ? (nm - cell.lo_nm) / (cell.centre_nm - cell.lo_nm)
                               : (cell.hi_nm - nm) / (cell.hi_nm - cell.centre_nm);
}

double power_at(const ExcitingLight& light, double nm) {
    const double place =
        std::clamp(nm - kUltravioletFirstNm, 0.0, static_cast<double>(light.power.size() - 1));
    const auto i = std::min(static_cast<std::size_t>(place), light.power.size() - 2);
    const double t = place - static_cast<double>(i);
    return light.power[i] + t * (light.power[i + 1] - light.power[i]);
}

/// The mean of the light under a cell's shape over what its table speaks of. Between two whole nanometres
/// and the cell's centre both are straight lines, for whose product Simpson's rule is exact.
double mean_power(const ExcitingLight& light, const Cell& cell, Shape shape) {
    const double from = std::max(cell.lo_nm, light.first_nm), to = std::min(cell.hi_nm, light.last_nm);
    double sum = 0, width = 0;
    for (double a = from; a < to;) {
        double b = std::min(to, std::floor(a) + 1);
        if (a < cell.centre_nm && cell.centre_nm < b)
            b = cell.centre_nm;
        const double middle = (a + b) / 2, h = b - a;
        const double sa = share_at(cell, shape, a), sm = share_at(cell, shape, middle),
                     sb = share_at(cell, shape, b);
        sum += h / 6 * (sa * power_at(light, a) + 4 * sm * power_at(light, middle) + sb * power_at(light, b));
        width += h / 6 * (sa + 4 * sm + sb);
        a = b;
    }
    return width > 0 ? sum / width : power_at(light, cell.centre_nm);
}

bool is_lit(const ExcitingLight& light, double nm) {
    return nm >= light.first_nm && nm <= light.last_nm;
}

/// Integral of a curve over each emitting band.
std::vector<double> emission_integrals(const std::vector<double>& nm, const std::vector<Cell>& cells,
                                       Shape shape, double step_nm, const NmSamples& curve) {
    std::vector<double> out;
    if (shape == Shape::Box) {
        for (const Cell& cell : cells)
            out.push_back(bin_integrals(std::array{cell.lo_nm, cell.hi_nm}, curve, Extrapolation::Zero)[0]);
        return out;
    }
    NmSamples ones;
    ones.fill(1);
    const std::vector<double> knots = with_ends(nm, step_nm);
    const auto all = linear_basis_integrals(knots, ones, curve, Extrapolation::Zero, quadrature_for(knots));
    return {all.begin() + 1, all.end() - 1};
}

std::string range_text(const std::vector<double>& nm) {
    return format_double(nm.front()) + (nm.size() > 1 ? "-" + format_double(nm.back()) : "") + " nm";
}

std::string unlit_warning(const Illuminant& light, const ExcitingLight& exciting, const Axis& excited,
                          double share) {
    std::vector<double> dark;
    for (const double nm : excited.nm)
        if (!is_lit(exciting, nm))
            dark.push_back(nm);
    return "the light " + light.id + " is known from " + format_double(exciting.first_nm) + " to " +
           format_double(exciting.last_nm) + " nm, and the set is excited at " + range_text(excited.nm) +
           ": no light is assumed at " + std::to_string(dark.size()) + " of " +
           std::to_string(excited.nm.size()) + " exciting bands (" + range_text(dark) +
           "), which would have " + format_fixed(100 * share, 2) +
           " % of the weight of reradiation if the light kept its end value";
}

/// Filters whose tables end before the exciting bands do.
void warn_of_filters(std::span<const Filter> filters, const Axis& excited,
                     std::vector<std::string>& warnings) {
    for (const Filter& filter : filters)
        if (excited.nm.front() < filter.first_nm || excited.nm.back() > filter.last_nm)
            warnings.push_back("the filter " + filter.path + " is known from " +
                               format_double(filter.first_nm) + " to " + format_double(filter.last_nm) +
                               " nm, and the set is excited at " + range_text(excited.nm) +
                               ": its end value counts beyond");
}

}  // namespace

ExcitingLight exciting_light(const Illuminant& light, std::span<const Filter> filters) {
    ExcitingLight out;
    out.power.assign(light.ultraviolet.begin(), light.ultraviolet.end());
    out.power.insert(out.power.end(), light.power.begin(), light.power.end());
    for (const Filter& filter : filters) {
        const std::size_t below = filter.ultraviolet.size();
        for (std::size_t i = 0; i < out.power.size(); ++i)
            out.power[i] *= i < below ? filter.ultraviolet[i] : filter.transmittance[i - below];
    }
    out.first_nm = std::max<double>(light.first_nm, kUltravioletFirstNm);
    out.last_nm = std::min<double>(light.last_nm, kObserverLastNm);
    return out;
}

Result<ReradiationWeights> reradiation_weights(const SpectralSet& set, Basis basis, const BandGrid& bands,
                                               const Illuminant& light, std::span<const Filter> filters,
                                               const Observer& observer) {
    const Axis excited = axis_of(set.reradiation, &Reradiation::excited_nm);
    const Axis emitted = axis_of(set.reradiation, &Reradiation::emitted_nm);
    double step_nm = 0;  // of an axis with one wavelength
    for (const double candidate : {bands.mean_step_nm(), emitted.mean_step_nm(), excited.mean_step_nm()})
        step_nm = candidate > 0 ? candidate : step_nm;
    if (step_nm == 0)
        return fail(ErrorCode::InvalidGrid,
                    "set " + set.name() + " has one band and one pair of reradiation, " +
                        format_double(excited.nm[0]) + " to " + format_double(emitted.nm[0]) +
                        " nm: nothing says how wide its bands are");

    const Shape shape = is_binned(basis) ? Shape::Box : Shape::Triangle;
    const std::vector<Cell> exciting = cells_of(excited.nm, shape, bands, step_nm);
    const std::vector<Cell> emitting = cells_of(emitted.nm, shape, bands, step_nm);
    std::array<std::vector<double>, 3> seen;
    for (std::size_t c = 0; c < seen.size(); ++c)
        seen[c] = emission_integrals(emitted.nm, emitting, shape, step_nm, observer.curves[c]);

    const ExcitingLight power = exciting_light(light, filters);
    std::vector<double> lit, held;  // held: with the end value where the table is silent
    for (const Cell& cell : exciting) {
        const bool known = is_lit(power, cell.centre_nm);
        lit.push_back(known ? mean_power(power, cell, shape) : 0);
        held.push_back(known ? lit.back()
                             : power_at(power, std::clamp(cell.centre_nm, power.first_nm, power.last_nm)));
    }

    std::map<std::pair<std::size_t, std::size_t>, std::size_t> sharing;
    for (std::size_t pair = 0; pair < set.reradiation.size(); ++pair)
        ++sharing[{excited.index_of_pair[pair], emitted.index_of_pair[pair]}];

    ReradiationWeights out;
    double all = 0, unlit = 0;
    for (std::size_t pair = 0; pair < set.reradiation.size(); ++pair) {
        const std::size_t in = excited.index_of_pair[pair], to = emitted.index_of_pair[pair];
        const double share = 1 / static_cast<double>(sharing[{in, to}]);
        Vector3 integrals{};
        for (std::size_t c = 0; c < 3; ++c) {
            integrals[c] = share * lit[in] * seen[c][to];
            all += std::abs(share * held[in] * seen[c][to]);
            unlit += std::abs(share * (held[in] - lit[in]) * seen[c][to]);
        }
        out.integrals.push_back(integrals);
    }
    out.unlit_share = all > 0 ? unlit / all : 0;
    if (!is_lit(power, excited.nm.front()) || !is_lit(power, excited.nm.back()))
        out.warnings.push_back(unlit_warning(light, power, excited, out.unlit_share));
    warn_of_filters(filters, excited, out.warnings);
    out.excited_nm = excited.nm;
    out.emitted_nm = emitted.nm;
    return out;
}

}  // namespace osio
