// SPDX-License-Identifier: Apache-2.0
#include <osio/spectra/basis.h>

#include <algorithm>
#include <cmath>

namespace osio {

namespace {

/// Band spacings are computed from decimal names; this much below 1 nm still counts as 1 nm.
constexpr double kSpacingToleranceNm = 1e-9;

/// The piecewise-linear curve through 1 nm samples, at a wavelength inside 360-830 nm.
double at_nm(const NmSamples& samples, double nm) {
    const double offset = nm - kObserverFirstNm;
    const auto i = std::min(static_cast<std::size_t>(offset), kObserverSampleCount - 2);
    const double t = offset - static_cast<double>(i);
    return samples[i] + t * (samples[i + 1] - samples[i]);
}

/// Spreads an amount at a wavelength onto the bands whose phi_i are not zero there.
class LinearSpread {
  public:
    LinearSpread(std::span<const double> bands_nm, Extrapolation extrapolation)
        : m_bands(bands_nm), m_extrapolation(extrapolation), m_weights(bands_nm.size(), 0.0) {}

    void add(double nm, double amount) {
        if (nm < m_bands.front() || nm > m_bands.back()) {
            if (m_extrapolation == Extrapolation::Hold)
                (nm < m_bands.front() ? m_weights.front() : m_weights.back()) += amount;
            return;
        }
        const auto above = std::lower_bound(m_bands.begin(), m_bands.end(), nm);
        const auto i = static_cast<std::size_t>(above - m_bands.begin());
        if (m_bands[i] == nm) {
            m_weights[i] += amount;
            return;
        }
        const double t = (nm - m_bands[i - 1]) / (m_bands[i] - m_bands[i - 1]);
        m_weights[i - 1] += (1 - t) * amount;
        m_weights[i] += t * amount;
    }

    [[nodiscard]] std::vector<double> take() { return std::move(m_weights); }

  private:
    std::span<const double> m_bands;
    Extrapolation m_extrapolation;
    std::vector<double> m_weights;
};

/// 360, 361, ..., 830 nm and the bands between them, increasing.
std::vector<double> knots_of(std::span<const double> bands_nm) {
    std::vector<double> knots;
    for (int nm = kObserverFirstNm; nm <= kObserverLastNm; ++nm)
        knots.push_back(nm);
    for (const double nm : bands_nm)
        if (nm > kObserverFirstNm && nm < kObserverLastNm)
            knots.push_back(nm);
    std::sort(knots.begin(), knots.end());
    knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
    return knots;
}

/// Calls visit(middle of the segment, lambda, quadrature weight at lambda). Between two knots the
/// product of three straight lines is a cubic, for which Simpson's rule (1, 4, 1) h / 6 is exact.
/// The middle tells on which side of an end band a segment lies: with Extrapolation::Zero the
/// spectrum jumps there, and lambda alone cannot tell.
template <class Visit>
void visit_exact(std::span<const double> bands_nm, Visit visit) {
    const std::vector<double> knots = knots_of(bands_nm);
    for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
        const double lo = knots[k], hi = knots[k + 1], middle = 0.5 * (lo + hi);
        visit(middle, lo, (hi - lo) / 6);
        visit(middle, middle, (hi - lo) * 4 / 6);
        visit(middle, hi, (hi - lo) / 6);
    }
}

}  // namespace

Quadrature quadrature_for(std::span<const double> bands_nm) {
    for (std::size_t i = 1; i < bands_nm.size(); ++i) {
        const bool inside = bands_nm[i] > kObserverFirstNm && bands_nm[i - 1] < kObserverLastNm;
        if (inside && bands_nm[i] - bands_nm[i - 1] < 1.0 - kSpacingToleranceNm)
            return Quadrature::Exact;
    }
    return Quadrature::Sum1nm;
}

double integral(const NmSamples& a, const NmSamples& b, Quadrature quadrature) {
    double sum = 0;
    if (quadrature == Quadrature::Sum1nm) {
        for (std::size_t i = 0; i < kObserverSampleCount; ++i)
            sum += a[i] * b[i];
        return sum;
    }
    visit_exact({}, [&](double, double nm, double weight) { sum += weight * at_nm(a, nm) * at_nm(b, nm); });
    return sum;
}

std::vector<double> linear_basis_integrals(std::span<const double> bands_nm, const NmSamples& a,
                                           const NmSamples& b, Extrapolation extrapolation,
                                           Quadrature quadrature) {
    LinearSpread spread(bands_nm, extrapolation);
    if (quadrature == Quadrature::Sum1nm) {
        for (std::size_t i = 0; i < kObserverSampleCount; ++i)
            spread.add(kObserverFirstNm + static_cast<double>(i), a[i] * b[i]);
        return spread.take();
    }
    visit_exact(bands_nm, [&](double segment, double nm, double weight) {
        const bool outside = segment < bands_nm.front() || segment > bands_nm.back();
        if (!outside || extrapolation == Extrapolation::Hold)
            spread.add(nm, weight * at_nm(a, nm) * at_nm(b, nm));
    });
    return spread.take();
}

}  // namespace osio
