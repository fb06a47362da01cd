// SPDX-License-Identifier: Apache-2.0
#include <osio/reduce/bin_fit.h>
#include <osio/spectra/bin_basis.h>

#include <algorithm>
#include <cmath>

namespace osio {

namespace {

/// The grey at which Lab is taken for linear.
constexpr double kGrey = 0.2;

/// out += factor x in, row by row of a matrix.
void add_row(const WeightMatrix& from, std::size_t row, double factor, WeightMatrix& to, std::size_t to_row) {
    if (factor == 0)
        return;
    for (std::size_t i = 0; i < from.bands(); ++i)
        to.at(to_row, i) += factor * from.at(row, i);
}

/// The running integral of the straight lines through the bands, one column a band: see FitTargets.
WeightMatrix running_of_bands(const DistinctBands& distinct, std::span<const Demand> demands) {
    const std::vector<double>& nm = distinct.grid.wavelengths_nm;
    const std::size_t columns = distinct.index_of_band.size();
    WeightMatrix curves(kObserverSampleCount, columns);
    for (std::size_t column = 0; column < columns; ++column) {
        const bool needed = std::any_of(demands.begin(), demands.end(), [column](const Demand& demand) {
            return demand.plan.weights.needs(column);
        });
        if (!needed)
            continue;
        const std::size_t at = distinct.index_of_band[column];
        for (std::size_t i = 0; i < kObserverSampleCount; ++i) {
            const double here = std::clamp(kObserverFirstNm + static_cast<double>(i), nm.front(), nm.back());
            const auto above =
                static_cast<std::size_t>(std::lower_bound(nm.begin(), nm.end(), here) - nm.begin());
            double share = 0;
            if (above == at)
                share = above == 0 ? 1 : (here - nm[above - 1]) / (nm[above] - nm[above - 1]);
            else if (above == at + 1)
                share = (nm[above] - here) / (nm[above] - nm[at]);
            curves.at(i, column) = share * distinct.share_of(column);
        }
    }
    WeightMatrix out(kObserverSampleCount, columns);
    for (std::size_t i = 1; i < kObserverSampleCount; ++i)
        for (std::size_t column = 0; column < columns; ++column)
            out.at(i, column) = out.at(i - 1, column) + (curves.at(i - 1, column) + curves.at(i, column)) / 2;
    return out;
}

/// Solves A x = b for the columns of b, in place; A symmetric and positive definite, overwritten.
void solve_in_place(WeightMatrix& a, WeightMatrix& b) {
    const std::size_t n = a.rows();
    for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t k = 0; k < j; ++k)
            for (std::size_t i = j; i < n; ++i)
                a.at(i, j) -= a.at(i, k) * a.at(j, k);
        // Rounding can leave nothing of a pivot: what is then solved is not what was asked, and is found out by the
        // differences that it makes.
        const double pivot = std::sqrt(std::max(a.at(j, j), 1e-300));
        for (std::size_t i = j; i < n; ++i)
            a.at(i, j) /= pivot;
    }
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < i; ++k)
            add_row(b, k, -a.at(i, k), b, i);
        for (std::size_t c = 0; c < b.bands(); ++c)
            b.at(i, c) /= a.at(i, i);
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k)
            add_row(b, k, -a.at(k, i), b, i);
        for (std::size_t c = 0; c < b.bands(); ++c)
            b.at(i, c) /= a.at(i, i);
    }
}

}  // namespace

BinFit::BinFit(std::span<const Demand> demands) : m_demands(demands) {
    const CollapsePlan& plan = demands.front().plan;
    const BandGrid& grid = plan.distinct.grid;
    m_columns = plan.columns.size();
    const bool binned = is_binned(plan.basis.basis) && grid.size() > 1;
    const std::vector<double> ends = binned ? grid.edges() : grid.wavelengths_nm;
    m_first_nm = std::clamp<double>(ends.front(), kObserverFirstNm, kObserverLastNm);
    m_last_nm = std::clamp<double>(ends.back(), kObserverFirstNm, kObserverLastNm);
    WeightMatrix rows;
    for (const Demand& demand : demands)
        rows.append(demand.plan.weights);
    m_bands = {scaled(rows), running_of_bands(plan.distinct, demands)};
    WeightMatrix curves(3 * demands.size(), kObserverSampleCount);
    for (std::size_t row = 0; row < curves.rows(); ++row)
        for (std::size_t i = 0; i < kObserverSampleCount; ++i)
            curves.at(row, i) = demands[row / 3].curves[row % 3][i];
    curves = scaled(curves);
    for (std::size_t row = 0; row < curves.rows(); ++row)
        for (std::size_t i = 0; i < kObserverSampleCount; ++i)
            m_importance[i] += std::abs(curves.at(row, i)) / static_cast<double>(curves.rows());
}

WeightMatrix BinFit::scaled(const WeightMatrix& rows) const {
    // f(t) = cbrt(t): its slope at the grey.
    const double slope = std::pow(kGrey, -2.0 / 3) / 3;
    WeightMatrix out(rows.rows(), rows.bands());
    for (std::size_t d = 0; d < m_demands.size(); ++d) {
        const Vector3& white = m_demands[d].white;
        const double x = slope / white[0], y = slope / white[1], z = slope / white[2];
        add_row(rows, 3 * d + 1, 116 * y, out, 3 * d);
        add_row(rows, 3 * d, 500 * x, out, 3 * d + 1);
        add_row(rows, 3 * d + 1, -500 * y, out, 3 * d + 1);
        add_row(rows, 3 * d + 1, 200 * y, out, 3 * d + 2);
        add_row(rows, 3 * d + 2, -200 * z, out, 3 * d + 2);
    }
    return out;
}

FitTargets BinFit::targets_of(const WeightMatrix& spectra) const {
    const auto times = [&spectra](const WeightMatrix& rows) {
        WeightMatrix out(rows.rows(), spectra.bands());
        for (std::size_t row = 0; row < rows.rows(); ++row)
            for (std::size_t column = 0; column < rows.bands(); ++column)
                add_row(spectra, column, rows.at(row, column), out, row);
        return out;
    };
    return {times(m_bands.demanded), times(m_bands.running)};
}

WeightMatrix BinFit::weights(std::span<const double> edges_nm) const {
    WeightMatrix out(3 * m_demands.size(), edges_nm.size() - 1);
    for (std::size_t row = 0; row < out.rows(); ++row) {
        const auto bins = bin_integrals(edges_nm, m_demands[row / 3].curves[row % 3], Extrapolation::Hold);
        for (std::size_t bin = 0; bin < bins.size(); ++bin)
            out.at(row, bin) = bins[bin];
    }
    return out;
}

WeightMatrix BinFit::metric(const WeightMatrix& weights, double fidelity) const {
    const WeightMatrix rows = scaled(weights);
    WeightMatrix out(rows.bands(), rows.bands());
    for (std::size_t i = 0; i < rows.bands(); ++i) {
        for (std::size_t row = 0; row < rows.rows(); ++row)
            add_row(rows, row, rows.at(row, i), out, i);
        out.at(i, i) += fidelity * fidelity;
    }
    return out;
}

WeightMatrix BinFit::fit(std::span<const double> edges_nm, const WeightMatrix& weights, double fidelity,
                         const FitTargets& targets) const {
    const WeightMatrix rows = scaled(weights);
    const std::size_t bins = rows.bands(), count = targets.demanded.bands();
    const double pull = fidelity * fidelity;
    WeightMatrix normal = metric(weights, fidelity), out(bins, count);
    for (std::size_t i = 0; i < bins; ++i) {
        for (std::size_t row = 0; row < rows.rows(); ++row)
            add_row(targets.demanded, row, rows.at(row, i), out, i);
        const double factor = pull / (edges_nm[i + 1] - edges_nm[i]);
        const auto add_running = [&](double nm, double sign) {
            const double place = nm - kObserverFirstNm;
            const auto below = static_cast<std::size_t>(
                std::clamp(place, 0.0, static_cast<double>(kObserverSampleCount - 2)));
            const double share = place - static_cast<double>(below);
            add_row(targets.running, below, sign * factor * (1 - share), out, i);
            add_row(targets.running, below + 1, sign * factor * share, out, i);
        };
        add_running(edges_nm[i + 1], 1);
        add_running(edges_nm[i], -1);
    }
    solve_in_place(normal, out);
    return out;
}

}  // namespace osio
