// SPDX-License-Identifier: Apache-2.0
#include <formats/reduce/search.h>

#include <algorithm>
#include <array>
#include <map>

namespace osio::reduce {

namespace {

/// With which edges are looked for: a fault of a tenth in a bin weighs as much as a CIEDE2000 of about 0.002.
constexpr double kFidelity = 0.02;
/// Tried for the edges that were found, the nearest to the spectrum first.
constexpr std::array kFidelities{30.0, 10.0, 3.0, 1.0, 0.3, 0.1};
/// What is judged on a sample must leave something for the pixels that it does not have.
constexpr double kSampleShare = 0.95;
constexpr std::size_t kFewest = 2, kMost = 64;

class Finder {
  public:
    Finder(const Subject& subject, const BinFit& fit, const SpectrumSample& sample, double tolerance,
           const TextLoader& load_text)
        : m_subject(subject), m_fit(fit), m_sample(sample), m_tolerance(tolerance), m_load_text(load_text),
          m_search(subject.demands, fit) {}

    Result<std::optional<Candidate>> find() {
        const std::vector<SampleType> types = m_subject.job().column_types();
        std::size_t bytes = 0;  // a pixel, that must not be reached
        for (const SampleType type : types)
            bytes += sample_bytes(type);
        std::optional<Candidate> best;
        for (const SampleType type : {SampleType::Half, SampleType::Float}) {
            const std::size_t most = most_bins(bytes, type);
            OSIO_TRY(const auto count, fewest_bins(most, type));
            if (!count)
                continue;
            OSIO_TRY(best, truest(*count, type));
            bytes = *count * sample_bytes(type);
        }
        const std::size_t whole = m_subject.columns() * sample_bytes(SampleType::Half);
        if (whole < bytes) {
            // Attributes that count bands can make a plan impossible where some bands are left out.
            if (auto all = whole_candidate(m_subject, SampleType::Half, m_load_text); all && holds(*all))
                best = std::move(*all);
        }
        return best;
    }

  private:
    /// The most bins of a type that take less than `bytes` a pixel.
    [[nodiscard]] std::size_t most_bins(std::size_t bytes, SampleType type) const {
        const auto nanometres = static_cast<std::size_t>(std::max(m_fit.last_nm() - m_fit.first_nm(), 1.0));
        return std::min({(bytes - 1) / sample_bytes(type), m_subject.columns() - 1, kMost, nanometres});
    }

    [[nodiscard]] bool holds(const Candidate& candidate) const {
        const auto largest = largest_differences(m_subject, candidate, m_sample);
        return *std::max_element(largest.begin(), largest.end()) <= kSampleShare * m_tolerance;
    }

    const std::vector<double>& edges(std::size_t count) {
        const auto found = m_edges.find(count);
        if (found != m_edges.end())
            return found->second;
        return m_edges.emplace(count, m_search.place(count, kFidelity, m_sample)).first->second;
    }

    [[nodiscard]] Result<Candidate> candidate(std::size_t count, double fidelity, SampleType type) {
        return bin_candidate(m_subject, m_fit, edges(count), fidelity, type, m_load_text);
    }

    [[nodiscard]] Result<bool> do_hold(std::size_t count, SampleType type) {
        OSIO_TRY(const Candidate one, candidate(count, kFidelity, type));
        return holds(one);
    }

    /// By steps that grow, then by halving: more bins hold wherever fewer do, but for what a descent misses.
    Result<std::optional<std::size_t>> fewest_bins(std::size_t most, SampleType type) {
        std::size_t fails = kFewest - 1;
        for (std::size_t count = kFewest;;
             count = std::min(most, count + std::max<std::size_t>(1, count / 2))) {
            if (count > most)
                return std::optional<std::size_t>();
            OSIO_TRY(const bool held, do_hold(count, type));
            if (held) {
                while (count - fails > 1) {
                    const std::size_t middle = (count + fails) / 2;
                    OSIO_TRY(const bool fewer, do_hold(middle, type));
                    (fewer ? count : fails) = middle;
                }
                return std::optional(count);
            }
            if (count == most)
                return std::optional<std::size_t>();
            fails = count;
        }
    }

    /// The samples that are nearest to the spectrum among those that hold.
    Result<std::optional<Candidate>> truest(std::size_t count, SampleType type) {
        for (const double fidelity : kFidelities) {
            OSIO_TRY(Candidate one, candidate(count, fidelity, type));
            if (holds(one))
                return std::optional(std::move(one));
        }
        OSIO_TRY(Candidate one, candidate(count, kFidelity, type));
        return std::optional(std::move(one));
    }

    const Subject& m_subject;
    const BinFit& m_fit;
    const SpectrumSample& m_sample;
    double m_tolerance;
    const TextLoader& m_load_text;
    BinSearch m_search;
    std::map<std::size_t, std::vector<double>> m_edges;  ///< by how many bins
};

}  // namespace

Result<std::optional<Candidate>> find_candidate(const Subject& subject, const BinFit& fit,
                                                const SpectrumSample& sample, double tolerance,
                                                const TextLoader& load_text) {
    return Finder(subject, fit, sample, tolerance, load_text).find();
}

}  // namespace osio::reduce
