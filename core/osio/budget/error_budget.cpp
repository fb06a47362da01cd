// SPDX-License-Identifier: Apache-2.0
#include <osio/budget/error_budget.h>
#include <osio/budget/lab_bound.h>
#include <osio/budget/magnitude.h>
#include <osio/budget/output_colour.h>
#include <osio/budget/stored_error.h>
#include <osio/collapse/kernel.h>
#include <osio/colour/difference.h>

#include <algorithm>
#include <cmath>

namespace osio {

namespace {

/// Pixels at a time.
constexpr std::size_t kRun = 256;

/// u / (1 - n u) n of n roundings in double.
double double_roundings(std::size_t n) {
    const double nu = static_cast<double>(n) * 0x1p-53;
    return nu / (1 - nu);
}

/// Half a unit in the last place of a half: 2^-11 of its binade, 2^-25 where it is subnormal (IEEE 754-2019, 3.6).
constexpr float kHalfUnit = 0x1p-11F;
constexpr double kLeastHalfUnit = 0x1p-25;

/// The weights of some bands, the others' set to zero.
WeightMatrix of_bands(const WeightMatrix& weights, const std::vector<bool>& wanted) {
    WeightMatrix out(weights.rows(), weights.bands());
    for (std::size_t row = 0; row < weights.rows(); ++row)
        for (std::size_t band = 0; band < weights.bands(); ++band)
            out.at(row, band) = wanted[band] ? weights.at(row, band) : 0;
    return out;
}

bool any_weight(const MagnitudeWeights& weights) {
    for (std::size_t row = 0; row < weights.rows(); ++row)
        for (std::size_t band = 0; band < weights.bands(); ++band)
            if (weights.at(row, band) != 0)
                return true;
    return false;
}

using Run = std::array<float, kRun>;
using Planes = std::array<Run, 3>;

/// More than a dozen roundings of positive floats take away.
constexpr double kFloatSlack = 1 + 0x1p-19;

std::array<float*, 3> pointers(Planes& planes) {
    return {planes[0].data(), planes[1].data(), planes[2].data()};
}

std::array<std::array<float, 3>, 3> as_floats(const Matrix3& m, bool absolute) {
    std::array<std::array<float, 3>, 3> out{};
    for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c)
            out[r][c] = static_cast<float>(absolute ? std::abs(m.rows[r][c]) : m.rows[r][c]);
    return out;
}

}  // namespace

std::string_view error_source_name(ErrorSource source) {
    switch (source) {
    case ErrorSource::Arithmetic: return "arithmetic";
    case ErrorSource::Plan: return "plan";
    case ErrorSource::InputStorage: return "input storage";
    case ErrorSource::OutputStorage: break;
    }
    return "output storage";
}

std::string_view error_source_method(ErrorSource source) {
    switch (source) {
    case ErrorSource::Arithmetic:
        return "forward error bound against the sum of |weight x sample|, at every pixel";
    case ErrorSource::Plan: return "comparison with the reference plan, at every pixel";
    case ErrorSource::InputStorage: return "half a unit in the last place of every half that was read";
    case ErrorSource::OutputStorage: break;
    }
    return "half a unit in the last place of every stored value, and what clamping took";
}

void ErrorBound::widen(const ErrorBound& other) {
    for (std::size_t c = 0; c < xyz.size(); ++c)
        xyz[c] = std::max(xyz[c], other.xyz[c]);
    delta_e_2000 = std::max(delta_e_2000, other.delta_e_2000);
}

void BudgetResult::add(const BudgetResult& other) {
    for (std::size_t i = 0; i < terms.size(); ++i)
        terms[i].widen(other.terms[i]);
    total.widen(other.total);
    indicator = std::max(indicator, other.indicator);
    with_indicator = std::max(with_indicator, other.with_indicator);
    pixels += other.pixels;
    undefined += other.undefined;
    clamped += other.clamped;
    beyond += other.beyond;
}

/// What all workers share.
struct ErrorBudget::Setup {
    Setup(BudgetSubject what, OutputColour output)
        : subject(std::move(what)), colour(output),
          share_from_output(as_floats(output.share_from_output, false)),
          error_from_output(as_floats(output.share_from_output, true)),
          storage(subject.depth, subject.plan.space.transfer) {
        const WeightMatrix& weights = subject.plan.weights;
        std::vector<bool> half, other;
        for (const SampleType type : subject.types) {
            half.push_back(type == SampleType::Half);
            other.push_back(type != SampleType::Half);
        }
        halves = MagnitudeWeights(of_bands(weights, half));
        others = MagnitudeWeights(of_bands(weights, other));
        if (subject.reference != nullptr)
            reference = MagnitudeWeights(subject.reference->weights);
        has_halves = any_weight(halves);
        has_others = any_weight(others);
        present = {true, subject.reference != nullptr, has_halves, storage.any()};
        // Rounded up to float by a term more than there are.
        rounding = static_cast<float>(double_roundings(weights.bands() + 2));
        for (std::size_t row = 0; row < weights.rows(); ++row) {
            double least = 0;
            for (std::size_t band = 0; band < weights.bands(); ++band)
                least += static_cast<double>(halves.at(row, band)) * kLeastHalfUnit;
            subnormal[row] = static_cast<float>(least);
        }
    }

    BudgetSubject subject;
    OutputColour colour;
    std::array<std::array<float, 3>, 3> share_from_output, error_from_output;
    StoredError storage;
    LabSlope slope;
    MagnitudeWeights halves, others, reference;
    bool has_halves = false, has_others = false;
    std::array<bool, kErrorSources.size()> present{};  ///< by ErrorSource: there is such an error at all
    float rounding = 0;                                ///< of all sums, relative to the sum of magnitudes
    std::array<float, 3> subnormal{};                  ///< of halves below 2^-14
};

/// Works on whole runs: loops of a constant length, over pixels, become vectors. Behind the last pixel lie
/// zeros, which have no error. Errors are floats; what their own few roundings lose is in kFloatSlack.
class ErrorBudget::Worker final : public WitnessWorker {
  public:
    explicit Worker(ErrorBudget& budget) : m_budget(budget), m_setup(*budget.m_setup) {}

    void look(std::span<const BandView> bands, std::size_t count,
              std::span<const float* const> sums) override {
        m_bands.assign(bands.begin(), bands.end());
        for (std::size_t first = 0; first < count; first += kRun) {
            m_pixels = std::min(kRun, count - first);
            for (std::size_t band = 0; band < bands.size(); ++band)
                m_bands[band] = bands[band].advanced(first);
            take_sums(sums, first);
            measure();
            bound_outputs();
            bound_colours();
            m_seen.pixels += m_pixels;
        }
    }

    void deliver() override {
        m_budget.m_result.add(m_seen);
        m_seen = {};
    }

  private:
    [[nodiscard]] std::size_t rows() const { return m_setup.subject.plan.weights.rows(); }

    /// The run's sums; those of pixels without a colour as zeros, and counted.
    void take_sums(std::span<const float* const> sums, std::size_t first) {
        m_defined.fill(0);
        std::fill_n(m_defined.begin(), m_pixels, 1.0F);
        for (std::size_t row = 0; row < rows(); ++row)
            for (std::size_t i = 0; i < m_pixels; ++i)
                if (!std::isfinite(sums[row][first + i]))
                    m_defined[i] = 0;
        for (std::size_t row = 0; row < rows(); ++row) {
            m_sums[row].fill(0);
            for (std::size_t i = 0; i < m_pixels; ++i)
                m_sums[row][i] = m_defined[i] != 0 ? sums[row][first + i] : 0;
        }
        m_seen.undefined += m_pixels - static_cast<std::size_t>(std::count(
                                           m_defined.begin(),
                                           m_defined.begin() + static_cast<std::ptrdiff_t>(m_pixels), 1.0F));
    }

    /// Everything about the run's bands that needs them all.
    void measure() {
        const BudgetSubject& subject = m_setup.subject;
        if (m_setup.has_halves)
            magnitude_run(m_bands, m_setup.halves, SampleMeasure::Binade, m_pixels, pointers(m_halves));
        if (m_setup.has_others)
            magnitude_run(m_bands, m_setup.others, SampleMeasure::Magnitude, m_pixels, pointers(m_others));
        if (subject.reference != nullptr) {
            collapse_run(m_bands, subject.reference->weights, m_pixels, pointers(m_reference));
            magnitude_run(m_bands, m_setup.reference, SampleMeasure::Magnitude, m_pixels,
                          pointers(m_reference_magnitudes));
        }
        m_alternatives.resize(subject.alternatives.size());
        for (std::size_t i = 0; i < m_alternatives.size(); ++i)
            collapse_run(m_bands, subject.alternatives[i]->weights, m_pixels, pointers(m_alternatives[i]));
    }

    /// Of a sum in double of terms of some magnitude, rounded to float.
    void bound_rounding(const Run& sums, const Run& magnitudes, Run& out) const {
        for (std::size_t i = 0; i < kRun; ++i)
            out[i] = m_setup.rounding * magnitudes[i] + 0x1p-24F * std::abs(sums[i]) + 0x1p-149F;
    }

    /// The errors of the outputs, source by source.
    void bound_outputs() {
        for (std::size_t row = 0; row < rows(); ++row) {
            // A sample is below twice its binade.
            Run magnitudes{};
            if (m_setup.has_others)
                magnitudes = m_others[row];
            if (m_setup.has_halves)
                for (std::size_t i = 0; i < kRun; ++i)
                    magnitudes[i] += 2 * m_halves[row][i];
            bound_rounding(m_sums[row], magnitudes, errors(ErrorSource::Arithmetic)[row]);
            if (m_setup.subject.reference != nullptr) {
                Run& plan = errors(ErrorSource::Plan)[row];
                bound_rounding(m_reference[row], m_reference_magnitudes[row], plan);
                for (std::size_t i = 0; i < kRun; ++i)
                    plan[i] += std::abs(m_sums[row][i] - m_reference[row][i]);
            }
            if (m_setup.has_halves)
                for (std::size_t i = 0; i < kRun; ++i)
                    errors(ErrorSource::InputStorage)[row][i] =
                        kHalfUnit * m_halves[row][i] + m_setup.subnormal[row];
            if (m_setup.storage.any())
                bound_storage(m_sums[row], errors(ErrorSource::OutputStorage)[row]);
        }
        if (m_setup.storage.any())
            count_clamped();
    }

    void bound_storage(const Run& sums, Run& out) const {
        for (std::size_t i = 0; i < m_pixels; ++i)
            out[i] = m_setup.storage.of(sums[i]);
    }

    void count_clamped() {
        for (std::size_t i = 0; i < m_pixels; ++i) {
            bool clamped = false;
            for (std::size_t row = 0; row < rows(); ++row)
                clamped = clamped || m_setup.storage.clamps(m_sums[row][i]);
            m_seen.clamped += clamped;
        }
    }

    /// From outputs to X, Y, Z, and to colour differences.
    void bound_colours() {
        Planes& total = m_errors.back();
        for (Run& plane : total)
            plane.fill(0);
        for (const ErrorSource source : kErrorSources) {
            if (!m_setup.present[static_cast<std::size_t>(source)])
                continue;
            to_colour(m_setup.error_from_output, errors(source));
            for (std::size_t c = 0; c < 3; ++c)
                for (std::size_t i = 0; i < kRun; ++i)
                    total[c][i] += errors(source)[c][i];
        }
        m_share = m_sums;
        to_colour(m_setup.share_from_output, m_share);
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t i = 0; i < kRun; ++i)
                m_slopes[c][i] = m_setup.slope.at_and_above(m_share[c][i] - total[c][i]);
        for (const ErrorSource source : kErrorSources)
            if (m_setup.present[static_cast<std::size_t>(source)])
                widen(m_seen.terms[static_cast<std::size_t>(source)], errors(source));
        widen(m_seen.total, total);  // last: m_squared is the total's from here on
        compare();
    }

    void to_colour(const std::array<std::array<float, 3>, 3>& matrix, Planes& planes) const {
        if (rows() == 1)
            planes[1] = planes[2] = Run{};
        for (std::size_t i = 0; i < kRun; ++i) {
            const float a = planes[0][i], b = planes[1][i], c = planes[2][i];
            for (std::size_t r = 0; r < 3; ++r)
                planes[r][i] = matrix[r][0] * a + matrix[r][1] * b + matrix[r][2] * c;
        }
    }

    /// The largest of a run's errors.
    void widen(ErrorBound& bound, const Planes& error) {
        std::array<float, 3> largest{};
        float squared = 0;
        const bool grey = m_setup.colour.achromatic;
        for (std::size_t i = 0; i < kRun; ++i) {
            const float l = 116 * m_slopes[1][i] * error[1][i];  // S_L of CIEDE2000 is 1 or more
            m_squared[i] = grey ? l * l
                                : squared_delta_e_bound({m_slopes[0][i], m_slopes[1][i], m_slopes[2][i]},
                                                        {error[0][i], error[1][i], error[2][i]});
        }
        for (std::size_t i = 0; i < kRun; ++i) {
            const float defined = m_defined[i];
            squared = std::max(squared, m_squared[i] * defined);
            for (std::size_t c = 0; c < 3; ++c)
                largest[c] = std::max(largest[c], error[c][i] * defined);
        }
        ErrorBound seen;
        for (std::size_t c = 0; c < 3; ++c)
            seen.xyz[c] = static_cast<double>(largest[c]) * kFloatSlack;
        seen.delta_e_2000 = std::sqrt(static_cast<double>(squared)) * kFloatSlack;
        bound.widen(seen);
    }

    /// The alternatives, and the total together with them.
    void compare() {
        const auto& tolerance = m_setup.subject.tolerance;
        if (m_alternatives.empty() && !tolerance) {
            m_seen.with_indicator = m_seen.total.delta_e_2000;
            return;
        }
        for (std::size_t i = 0; i < m_pixels; ++i) {
            if (m_defined[i] == 0)
                continue;
            const double total = std::sqrt(static_cast<double>(m_squared[i])) * kFloatSlack;
            const double away = farthest(i);
            m_seen.indicator = std::max(m_seen.indicator, away);
            m_seen.with_indicator = std::max(m_seen.with_indicator, total + away);
            m_seen.beyond += tolerance && !(total + away <= *tolerance);
        }
    }

    /// CIEDE2000 to the farthest alternative.
    [[nodiscard]] double farthest(std::size_t pixel) const {
        const auto lab_at = [&](const Planes& planes) {
            Vector3 outputs{};
            for (std::size_t row = 0; row < rows(); ++row)
                outputs[row] = static_cast<double>(planes[row][pixel]);
            return lab_of(m_setup.colour.share_from_output * outputs, {1, 1, 1});
        };
        double out = 0;
        const Lab here = lab_at(m_sums);
        for (const Planes& planes : m_alternatives)
            out = std::max(out, delta_e_2000(here, lab_at(planes)));
        return out;
    }

    Planes& errors(ErrorSource source) { return m_errors[static_cast<std::size_t>(source)]; }

    ErrorBudget& m_budget;
    const Setup& m_setup;
    BudgetResult m_seen;
    std::vector<BandView> m_bands;  ///< of the run
    std::size_t m_pixels = 0;
    Run m_defined{};  ///< 1 or 0
    Planes m_sums{}, m_halves{}, m_others{}, m_reference{}, m_reference_magnitudes{};
    std::array<Planes, kErrorSources.size() + 1> m_errors{};  ///< by ErrorSource, then all together
    Planes m_share{}, m_slopes{};
    Run m_squared{};
    std::vector<Planes> m_alternatives;
};

ErrorBudget::ErrorBudget(std::unique_ptr<Setup> setup) : m_setup(std::move(setup)) {}

ErrorBudget::~ErrorBudget() = default;

Result<std::unique_ptr<ErrorBudget>> ErrorBudget::create(BudgetSubject subject) {
    OSIO_TRY(const OutputColour colour, output_colour(subject.plan, subject.white_luminance));
    if (subject.has_alpha && subject.plan.space.transfer != Transfer::Linear)
        return fail(ErrorCode::Usage,
                    "the error of to=" + subject.plan.space.id +
                        " is not bounded for an image with alpha, whose encoded colour is divided "
                        "and multiplied by it; use a linear space");
    return std::unique_ptr<ErrorBudget>(new ErrorBudget(std::make_unique<Setup>(std::move(subject), colour)));
}

std::unique_ptr<WitnessWorker> ErrorBudget::start_worker() {
    return std::make_unique<Worker>(*this);
}

}  // namespace osio
