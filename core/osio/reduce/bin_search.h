// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/reduce/bin_fit.h>

#include <cstddef>
#include <vector>

namespace osio {

/// Spectra of some pixels, as the original has them.
class SpectrumSample {
  public:
    explicit SpectrumSample(std::size_t bands) : m_bands(bands) {}

    /// `bands` samples of a pixel. Pixels with NaN or infinities are left out: no difference is defined there.
    void add(std::span<const double> pixel);

    [[nodiscard]] std::size_t bands() const { return m_bands; }

    [[nodiscard]] std::size_t size() const { return m_values.size() / m_bands; }

    [[nodiscard]] std::span<const double> pixel(std::size_t index) const {
        return std::span<const double>(m_values).subspan(index * m_bands, m_bands);
    }

    /// Some of them as a matrix, bands x spectra.
    [[nodiscard]] WeightMatrix matrix(std::span<const std::size_t> pixels) const;

  private:
    std::size_t m_bands;
    std::vector<double> m_values;
};

/// Looks for the edges of bins that lose least of some spectra.
class BinSearch {
  public:
    /// Both outlive this.
    BinSearch(std::span<const Demand> demands, const BinFit& fit) : m_demands(demands), m_fit(fit) {}

    /// Edges of `count` bins, which is at least 1 and leaves each bin 1 nm or more: those for which the mean of
    /// the eighth power of CIEDE2000 over the demands and the sample is smallest that a descent from edges of
    /// equal importance() finds, moving one inner edge at a time by 32 to 1 nm. It sees a few hundred of
    /// the spectra: some in even steps, and those that were worst.
    [[nodiscard]] std::vector<double> place(std::size_t count, double fidelity,
                                            const SpectrumSample& sample) const;

  private:
    class Objective;

    std::span<const Demand> m_demands;
    const BinFit& m_fit;
};

}  // namespace osio
