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
/// With which the fewest curves of a scene are looked for.
constexpr double kSceneFidelity = 0.1;
/// The curves of so many bands take seconds, of twice as many eight times that.
constexpr std::size_t kMostSceneBands = 512;

/// The fewest for which a test holds, by steps that grow, then by halving: more hold wherever fewer do, but for what a
/// search misses.
template <class Holds>
Result<std::optional<std::size_t>> fewest(std::size_t least, std::size_t most, const Holds& holds) {
    std::size_t fails = least - 1;
    for (std::size_t count = least; count <= most;) {
        OSIO_TRY(const bool held, holds(count));
        if (held) {
            while (count - fails > 1) {
                const std::size_t middle = (count + fails) / 2;
                OSIO_TRY(const bool fewer, holds(middle));
                (fewer ? count : fails) = middle;
            }
            return std::optional(count);
        }
        if (count == most)
            break;
        fails = count;
        count = std::min(most, count + std::max<std::size_t>(1, count / 2));
    }
    return std::optional<std::size_t>();
}

bool holds_on(const Subject& subject, const Candidate& candidate, const SpectrumSample& sample,
              double tolerance) {
    const auto largest = largest_differences(subject, candidate, sample);
    return *std::max_element(largest.begin(), largest.end()) <= kSampleShare * tolerance;
}

/// Bytes of a pixel's bands in the original.
std::size_t original_bytes(const Subject& subject) {
    std::size_t out = 0;
    for (const SampleType type : subject.job().column_types())
        out += sample_bytes(type);
    return out;
}

class Finder {
  public:
    Finder(const Subject& subject, const BinFit& fit, const SpectrumSample& sample, double tolerance,
           const TextLoader& load_text)
        : m_subject(subject), m_fit(fit), m_sample(sample), m_tolerance(tolerance), m_load_text(load_text),
          m_search(subject.demands, fit) {}

    Result<std::optional<Candidate>> find() {
        std::size_t bytes = original_bytes(m_subject);  // a pixel, that must not be reached
        std::optional<Candidate> best;
        for (const SampleType type : {SampleType::Half, SampleType::Float}) {
            const std::size_t most = most_bins(bytes, type);
            OSIO_TRY(const auto count,
                     fewest(kFewest, most, [&](std::size_t bins) { return do_hold(bins, type); }));
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
        return holds_on(m_subject, candidate, m_sample, m_tolerance);
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

Result<std::optional<Candidate>> find_scene_candidate(const Subject& subject, const BinFit& fit,
                                                      const SpectrumSample& sample, double tolerance,
                                                      const TextLoader& load_text) {
    if (subject.columns() > kMostSceneBands)
        return fail(ErrorCode::Unsupported,
                    "--per-scene-basis is for " + std::to_string(kMostSceneBands) + " bands at most, found " +
                        std::to_string(subject.columns()) + "; leave it out, or convert --resample first",
                    subject.job().file->path());
    std::map<double, SceneFit> fits;  // by fidelity
    const auto make = [&](std::size_t count, double fidelity, SampleType type) {
        auto found = fits.find(fidelity);
        if (found == fits.end())
            found = fits.emplace(fidelity, SceneFit(subject.demands, fit, fidelity, sample)).first;
        return scene_candidate(subject, found->second, count, fidelity, type, load_text);
    };
    const auto holds = [&](std::size_t count, double fidelity, SampleType type) -> Result<bool> {
        OSIO_TRY(const Candidate one, make(count, fidelity, type));
        return holds_on(subject, one, sample, tolerance);
    };
    std::size_t bytes = original_bytes(subject);
    std::optional<Candidate> best;
    for (const SampleType type : {SampleType::Half, SampleType::Float}) {
        const std::size_t most = std::min((bytes - 1) / sample_bytes(type), subject.weighed() - 1);
        OSIO_TRY(const auto count,
                 fewest(1, most, [&](std::size_t curves) { return holds(curves, kSceneFidelity, type); }));
        if (!count)
            continue;
        bytes = *count * sample_bytes(type);
        for (const double fidelity : kFidelities) {
            OSIO_TRY(Candidate one, make(*count, fidelity, type));
            best = std::move(one);
            if (holds_on(subject, *best, sample, tolerance))
                break;
        }
    }
    return best;
}

}  // namespace osio::reduce
