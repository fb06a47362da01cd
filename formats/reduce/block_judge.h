// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/reduce/candidate.h>

#include <osio/reduce/non_negative.h>

#include <cstdint>
#include <span>
#include <vector>

namespace osio::reduce {

/// What is stored that is not the sum of the fit.
struct StoredCounts {
    std::uint64_t changed = 0;  ///< pixels whose fit is below zero somewhere and whose original is not
    std::uint64_t negative =
        0;  ///< samples below zero that a reader gets: of bins where the original has some
    std::uint64_t clamped = 0;  ///< beyond +-65504 in a half

    StoredCounts& operator+=(const StoredCounts& other);
};

/// Makes a candidate's samples of blocks of the original, as they are stored, and compares the colours that a reader gets of
/// them with the original's. For one worker.
class BlockJudge {
  public:
    /// Both outlive this.
    BlockJudge(const Subject& subject, const Candidate& candidate);

    /// Of a block whose planes are the original's columns; planes beyond those are left alone.
    void judge(const PlanarBlock& block);

    /// The stored samples of a band, pixel after pixel.
    [[nodiscard]] const std::byte* stored(std::size_t band) const { return m_stored[band].data(); }

    /// The samples of a band as a reader has them.
    [[nodiscard]] const BandView& read(std::size_t band) const { return m_bands[band]; }

    /// CIEDE2000 of the block's pixels under a demand, as of colour_differences().
    [[nodiscard]] std::span<const double> differences(std::size_t demand) const {
        return m_differences[demand];
    }

    /// Of the last block.
    [[nodiscard]] const StoredCounts& counts() const { return m_counts; }

  private:
    void keep_non_negative(std::size_t first, std::size_t count, std::span<const BandView> original);
    void store(std::size_t pixels);
    void expand(std::size_t pixels);

    const Subject& m_subject;
    const Candidate& m_candidate;
    std::vector<std::vector<float>> m_original;  ///< 3 planes a demand
    std::vector<std::vector<float>> m_reduced;
    std::vector<std::vector<float>> m_samples;  ///< a plane a band, before they are rounded
    std::vector<std::vector<std::byte>> m_stored;
    std::vector<std::vector<float>> m_expanded;  ///< a plane a band, of what is stored
    std::vector<BandView> m_bands;
    std::vector<std::vector<double>> m_differences;
    NonNegative m_non_negative;
    std::vector<double> m_pixel;
    StoredCounts m_counts;
};

}  // namespace osio::reduce
