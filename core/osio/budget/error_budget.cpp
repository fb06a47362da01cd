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

using Planes = std::array<std::array<float, kRun>, 3>;

std::array<float*, 3> pointers(Planes& planes) {
    return {planes[0].data(), planes[1].data(), planes[2].data()};
}

Matrix3 absolute(Matrix3 m) {
    for (Vector3& row : m.rows)
        for (double& value : row)
            value = std::abs(value);
    return m;
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
        : subject(std::move(what)), colour(output), error_from_output(absolute(output.share_from_output)),
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
    Matrix3 error_from_output;
    StoredError storage;
    LabSlope slope;
    MagnitudeWeights halves, others, reference;
    bool has_halves = false, has_others = false;
    float rounding = 0;                ///< of all sums, relative to the sum of magnitudes
    std::array<float, 3> subnormal{};  ///< of halves below 2^-14
};

class ErrorBudget::Worker final : public WitnessWorker {
  public:
    explicit Worker(ErrorBudget& budget) : m_budget(budget), m_setup(*budget.m_setup) {}

    void look(std::span<const BandView> bands, std::size_t count,
              std::span<const float* const> sums) override {
        std::vector<BandView> run(bands.begin(), bands.end());
        for (std::size_t first = 0; first < count; first += kRun) {
            const std::size_t pixels = std::min(kRun, count - first);
            for (std::size_t band = 0; band < bands.size(); ++band)
                run[band] = bands[band].advanced(first);
            for (std::size_t row = 0; row < sums.size(); ++row)
                m_sums[row] = sums[row] + first;
            measure(run, pixels);
            for (std::size_t pixel = 0; pixel < pixels; ++pixel)
                judge(pixel);
            m_seen.pixels += pixels;
        }
    }

    void deliver() override {
        m_budget.m_result.add(m_seen);
        m_seen = {};
    }

  private:
    [[nodiscard]] std::size_t rows() const { return m_setup.subject.plan.weights.rows(); }

    /// Everything about the run's bands that needs them all.
    void measure(std::span<const BandView> bands, std::size_t pixels) {
        const BudgetSubject& subject = m_setup.subject;
        if (m_setup.has_halves)
            magnitude_run(bands, m_setup.halves, SampleMeasure::Binade, pixels, pointers(m_halves));
        if (m_setup.has_others)
            magnitude_run(bands, m_setup.others, SampleMeasure::Magnitude, pixels, pointers(m_others));
        if (subject.reference != nullptr) {
            collapse_run(bands, subject.reference->weights, pixels, pointers(m_reference));
            magnitude_run(bands, m_setup.reference, SampleMeasure::Magnitude, pixels,
                          pointers(m_reference_magnitudes));
        }
        m_alternatives.resize(subject.alternatives.size());
        for (std::size_t i = 0; i < m_alternatives.size(); ++i)
            collapse_run(bands, subject.alternatives[i]->weights, pixels, pointers(m_alternatives[i]));
    }

    /// The errors of each output at a pixel, source by source.
    void judge(std::size_t pixel) {
        Vector3 value{};
        bool finite = true;
        for (std::size_t row = 0; row < rows(); ++row) {
            value[row] = static_cast<double>(m_sums[row][pixel]);
            finite = finite && std::isfinite(value[row]);
        }
        if (!finite) {
            ++m_seen.undefined;
            return;
        }
        std::array<Vector3, kErrorSources.size()> errors{};
        bool clamped = false;
        for (std::size_t row = 0; row < rows(); ++row) {
            const float v = m_sums[row][pixel];
            // A sample is below twice its binade.
            const float halves = m_setup.has_halves ? m_halves[row][pixel] : 0;
            const float magnitude = 2 * halves + (m_setup.has_others ? m_others[row][pixel] : 0);
            errors[0][row] = rounding_of(v, magnitude);
            if (m_setup.subject.reference != nullptr) {
                const float other = m_reference[row][pixel];
                errors[1][row] = std::abs(value[row] - static_cast<double>(other)) +
                                 rounding_of(other, m_reference_magnitudes[row][pixel]);
            }
            errors[2][row] =
                m_setup.has_halves ? static_cast<double>(kHalfUnit * halves + m_setup.subnormal[row]) : 0;
            errors[3][row] = m_setup.storage.of(v, clamped);
        }
        m_seen.clamped += clamped;
        bound(value, errors, pixel);
    }

    /// Of a sum in double of terms of this magnitude, rounded to float.
    [[nodiscard]] double rounding_of(float sum, float magnitude) const {
        return static_cast<double>(m_setup.rounding * magnitude + 0x1p-24F * std::abs(sum)) + 0x1p-149;
    }

    [[nodiscard]] double delta_e(const std::array<float, 3>& share, const Vector3& error) const {
        return delta_e_bound(
            m_setup.slope, share,
            {static_cast<float>(error[0]), static_cast<float>(error[1]), static_cast<float>(error[2])});
    }

    void bound(const Vector3& value, const std::array<Vector3, kErrorSources.size()>& errors,
               std::size_t pixel) {
        const Vector3 exact = m_setup.colour.share_from_output * value;
        const std::array<float, 3> share{static_cast<float>(exact[0]), static_cast<float>(exact[1]),
                                         static_cast<float>(exact[2])};
        Vector3 sum{};
        for (std::size_t i = 0; i < errors.size(); ++i) {
            if (errors[i] == Vector3{})
                continue;
            const Vector3 error = m_setup.error_from_output * errors[i];
            for (std::size_t c = 0; c < 3; ++c)
                sum[c] += error[c];
            m_seen.terms[i].widen({error, delta_e(share, error)});
        }
        const double total = delta_e(share, sum);
        m_seen.total.widen({sum, total});
        const double away = farthest(exact, pixel);
        m_seen.indicator = std::max(m_seen.indicator, away);
        m_seen.with_indicator = std::max(m_seen.with_indicator, total + away);
        const auto& tolerance = m_setup.subject.tolerance;
        m_seen.beyond += tolerance && !(total + away <= *tolerance);
    }

    /// CIEDE2000 to the farthest alternative.
    [[nodiscard]] double farthest(const Vector3& share, std::size_t pixel) const {
        double out = 0;
        const Lab here = lab_of(share, {1, 1, 1});
        for (const Planes& planes : m_alternatives) {
            Vector3 other{};
            for (std::size_t row = 0; row < rows(); ++row)
                other[row] = static_cast<double>(planes[row][pixel]);
            out = std::max(out,
                           delta_e_2000(here, lab_of(m_setup.colour.share_from_output * other, {1, 1, 1})));
        }
        return out;
    }

    ErrorBudget& m_budget;
    const Setup& m_setup;
    BudgetResult m_seen;
    std::array<const float*, 3> m_sums{};
    Planes m_halves{}, m_others{}, m_reference{}, m_reference_magnitudes{};
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
