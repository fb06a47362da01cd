// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/spectra/spectrum_algebra.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace osio {

namespace {

template <class Operation>
Spectrum each(const Spectrum& a, Operation operation) {
    Spectrum out = a;
    std::transform(a.values.begin(), a.values.end(), out.values.begin(), operation);
    return out;
}

template <class Operation>
Result<Spectrum> each_pair(const Spectrum& a, const Spectrum& b, Operation operation) {
    const auto& nm = a.wavelengths_nm;
    if (nm.size() != b.wavelengths_nm.size())
        return fail(ErrorCode::InvalidGrid, "spectra of " + std::to_string(nm.size()) + " and " +
                                                std::to_string(b.wavelengths_nm.size()) +
                                                " samples; resample one to the other's wavelengths");
    for (std::size_t i = 0; i < nm.size(); ++i)
        if (nm[i] != b.wavelengths_nm[i])
            return fail(ErrorCode::InvalidGrid, "one spectrum has a sample at " + format_double(nm[i]) +
                                                    " nm where the other has " +
                                                    format_double(b.wavelengths_nm[i]) +
                                                    " nm; resample one to the other's wavelengths");
    Spectrum out = a;
    std::transform(a.values.begin(), a.values.end(), b.values.begin(), out.values.begin(), operation);
    return out;
}

double value_at(const Spectrum& a, double nm, EdgeRule edge) {
    if (edge == EdgeRule::Hold && !a.values.empty())
        nm = std::clamp(nm, a.wavelengths_nm.front(), a.wavelengths_nm.back());
    return a.linear_at(nm);
}

/// Samples in order of wavelength, equal wavelengths as their mean. The values of one wavelength are
/// added in order of size, so that the order of samples never matters to a bit.
Spectrum ordered(std::span<const double> wavelengths_nm, std::span<const double> values) {
    std::multimap<std::pair<double, double>, double> sorted;
    for (std::size_t i = 0; i < values.size(); ++i)
        sorted.emplace(std::pair(wavelengths_nm[i], std::isnan(values[i]) ? 0 : values[i]), values[i]);
    Spectrum out;
    std::size_t sharing = 0;
    for (const auto& [key, value] : sorted) {
        if (out.wavelengths_nm.empty() || out.wavelengths_nm.back() != key.first) {
            if (sharing > 1)
                out.values.back() /= static_cast<double>(sharing);
            sharing = 0;
            out.wavelengths_nm.push_back(key.first);
            out.values.push_back(0);
        }
        out.values.back() += value;
        ++sharing;
    }
    if (sharing > 1)
        out.values.back() /= static_cast<double>(sharing);
    return out;
}

}  // namespace

Result<Spectrum> sum(const Spectrum& a, const Spectrum& b) {
    return each_pair(a, b, [](double x, double y) { return x + y; });
}

Result<Spectrum> difference(const Spectrum& a, const Spectrum& b) {
    return each_pair(a, b, [](double x, double y) { return x - y; });
}

Result<Spectrum> product(const Spectrum& a, const Spectrum& b) {
    return each_pair(a, b, [](double x, double y) { return x * y; });
}

Result<Spectrum> quotient(const Spectrum& a, const Spectrum& b) {
    return each_pair(a, b, [](double x, double y) { return x / y; });
}

Result<Spectrum> lerp(double t, const Spectrum& a, const Spectrum& b) {
    return each_pair(a, b, [t](double x, double y) { return t == 1 ? y : t == 0 ? x : (1 - t) * x + t * y; });
}

Spectrum scaled(const Spectrum& a, double factor) {
    return each(a, [factor](double x) { return factor * x; });
}

Spectrum square_root(const Spectrum& a) {
    return each(a, [](double x) { return std::sqrt(x); });
}

Spectrum power(const Spectrum& a, double exponent) {
    return each(a, [exponent](double x) { return std::pow(x, exponent); });
}

Spectrum exponential(const Spectrum& a) {
    return each(a, [](double x) { return std::exp(x); });
}

Spectrum clamped(const Spectrum& a, double low, double high) {
    return each(a, [low, high](double x) { return x < low ? low : x > high ? high : x; });
}

bool is_black(const Spectrum& a) {
    return std::all_of(a.values.begin(), a.values.end(), [](double x) { return x == 0; });
}

bool has_nan(const Spectrum& a) {
    return std::any_of(a.values.begin(), a.values.end(), [](double x) { return std::isnan(x); });
}

Spectrum resampled(const Spectrum& a, std::span<const double> wavelengths_nm, EdgeRule edge) {
    Spectrum out;
    for (const double nm : wavelengths_nm) {
        out.wavelengths_nm.push_back(nm);
        out.values.push_back(value_at(a, nm, edge));
    }
    return out;
}

Result<double> average(std::span<const double> wavelengths_nm, std::span<const double> values, double low_nm,
                       double high_nm, EdgeRule edge) {
    if (values.empty() || values.size() != wavelengths_nm.size())
        return fail(ErrorCode::Usage, std::to_string(wavelengths_nm.size()) + " wavelengths and " +
                                          std::to_string(values.size()) +
                                          " values; expected one value for each wavelength, at least one");
    const auto finite = [](double nm) { return std::isfinite(nm); };
    if (!std::all_of(wavelengths_nm.begin(), wavelengths_nm.end(), finite) || !finite(low_nm) ||
        !finite(high_nm) || low_nm > high_nm)
        return fail(ErrorCode::Usage, "expected finite wavelengths and a range from low to high, found " +
                                          format_double(low_nm) + " to " + format_double(high_nm) + " nm");
    const Spectrum curve = ordered(wavelengths_nm, values);
    if (low_nm == high_nm)
        return value_at(curve, low_nm, edge);

    // Trapezia between all knots inside the range; shares of the range rather than nanometres, so that
    // neither the width nor large values overflow.
    std::vector<double> knots{low_nm};
    for (const double nm : curve.wavelengths_nm)
        if (nm > low_nm && nm < high_nm)
            knots.push_back(nm);
    knots.push_back(high_nm);
    const double first = curve.wavelengths_nm.front(), last = curve.wavelengths_nm.back();
    double mean = 0;
    for (std::size_t i = 1; i < knots.size(); ++i) {
        const bool outside = knots[i] <= first || knots[i - 1] >= last;
        if (outside && edge == EdgeRule::Zero)
            continue;
        const double share = (knots[i] - knots[i - 1]) / (high_nm - low_nm);
        mean += share * (value_at(curve, knots[i - 1], edge) / 2 + value_at(curve, knots[i], edge) / 2);
    }
    return mean;
}

}  // namespace osio
