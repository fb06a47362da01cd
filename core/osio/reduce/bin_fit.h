// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/collapse/weights.h>
#include <osio/reduce/demand.h>

#include <span>
#include <vector>

namespace osio {

/// What is known of some spectra, one a column, for bins to be fitted to.
struct FitTargets {
    WeightMatrix demanded;  ///< 3 demands x spectra: their X, Y, Z, scaled as BinFit does
    WeightMatrix
        running;  ///< 471 x spectra: the integral of the straight lines through the bands from 360 nm on
};

/// Samples of bins whose colours are those of the original's bands.
///
/// For a spectrum s the samples r of the bins minimise, over all demands,
///
///     |J (V r - W s)|^2 + fidelity^2 |r - a(s)|^2
///
/// W are the original plan's weights, V those of the bins (bin_integrals, held at the ends), J the slope of
/// CIE 1976 L*, a*, b* at a grey of Y = 0.2, and a the averages of the straight lines through the bands. The
/// minimum is linear in s, so that one matrix serves every pixel:
///
///     (V'J'JV + fidelity^2 I) r = V'J'J W s + fidelity^2 a(s)
///
/// solved by Cholesky's method. Where there are as many bins as rows of independent weights, a small fidelity
/// meets every demand exactly, for any spectrum.
class BinFit {
  public:
    /// Plans for the same bands; `demands` outlives this.
    explicit BinFit(std::span<const Demand> demands);

    /// Where bins begin and end, nm: the range of the bands, within 360-830 nm.
    [[nodiscard]] double first_nm() const { return m_first_nm; }

    [[nodiscard]] double last_nm() const { return m_last_nm; }

    [[nodiscard]] std::size_t columns() const { return m_columns; }

    /// The spectra that are 1 in one band and 0 in the others: what is fitted to them is the matrix.
    [[nodiscard]] const FitTargets& bands() const { return m_bands; }

    /// Of any spectra, bands x spectra.
    [[nodiscard]] FitTargets targets_of(const WeightMatrix& spectra) const;

    /// X, Y, Z of each demand by bins: 3 demands x bins.
    [[nodiscard]] WeightMatrix weights(std::span<const double> edges_nm) const;

    /// Samples of the bins, bins x targets. `weights` are those of the same edges, `fidelity` is above 0.
    [[nodiscard]] WeightMatrix fit(std::span<const double> edges_nm, const WeightMatrix& weights,
                                   double fidelity, const FitTargets& targets) const;

    /// V'J'JV + fidelity^2 I: how far samples are from the minimum, as a metric.
    [[nodiscard]] WeightMatrix metric(const WeightMatrix& weights, double fidelity) const;

    /// How much the demands ask of each nanometre, 360-830 nm, relative: the mean of |J W| over the rows.
    [[nodiscard]] const NmSamples& importance() const { return m_importance; }

  private:
    /// J of every demand times the rows of a matrix.
    [[nodiscard]] WeightMatrix scaled(const WeightMatrix& rows) const;

    std::span<const Demand> m_demands;
    std::size_t m_columns = 0;
    double m_first_nm = 0, m_last_nm = 0;
    FitTargets m_bands;
    NmSamples m_importance{};
};

}  // namespace osio
