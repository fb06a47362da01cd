// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>
#include <osio/collapse/collapse_stream.h>
#include <osio/collapse/plan.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

/// How far the pixels of a collapse can be from what was asked for: bounds for every pixel, taken while it is
/// made.
namespace osio {

/// Where a difference comes from.
enum class ErrorSource {
    Arithmetic,     ///< rounding of products, sums and of the result to float
    Plan,           ///< other weights than the reference plan's
    InputStorage,   ///< the file's samples are halves, rounded from whatever they were
    OutputStorage,  ///< rounding of the result to the type that it is stored in, or clamping
};

inline constexpr std::array kErrorSources{ErrorSource::Arithmetic, ErrorSource::Plan,
                                          ErrorSource::InputStorage, ErrorSource::OutputStorage};

/// "arithmetic", "plan", "input storage", "output storage".
[[nodiscard]] std::string_view error_source_name(ErrorSource source);

/// How a bound is obtained, in words.
[[nodiscard]] std::string_view error_source_method(ErrorSource source);

/// The type of a stored result.
enum class StoredDepth { Float, Half, Uint8, Uint16 };

/// The largest over all pixels.
struct ErrorBound {
    Vector3 xyz{};            ///< of X, Y and Z, as shares of the white's
    double delta_e_2000 = 0;  ///< not exceeded by the CIEDE2000 of any pixel

    void widen(const ErrorBound& other);
};

/// What a budget found.
struct BudgetResult {
    std::array<ErrorBound, kErrorSources.size()> terms;  ///< by ErrorSource
    ErrorBound total;      ///< of all terms together, pixel by pixel: never below a term
    double indicator = 0;  ///< CIEDE2000 to the farthest alternative, largest over the pixels: not a bound
    double with_indicator = 0;  ///< largest of total plus indicator
    std::uint64_t pixels = 0;
    std::uint64_t undefined = 0;  ///< NaN or infinite results, which go into nothing else
    std::uint64_t clamped = 0;    ///< pixels beyond what the stored type holds
    std::uint64_t beyond = 0;     ///< pixels whose total plus indicator exceeds the tolerance

    [[nodiscard]] const ErrorBound& term(ErrorSource source) const {
        return terms[static_cast<std::size_t>(source)];
    }

    void add(const BudgetResult& other);
};

/// What a budget is of.
struct BudgetSubject {
    const CollapsePlan& plan;
    std::vector<SampleType> types;  ///< of the samples of the plan's columns
    StoredDepth depth = StoredDepth::Float;
    bool has_alpha = false;
    /// The plan that is the truth; null: the plan itself. For the same bands and space.
    const CollapsePlan* reference = nullptr;
    /// Plans that take the bands for other curves, for the indicator.
    std::vector<const CollapsePlan*> alternatives = {};
    double white_luminance = 1;            ///< Y of the white, in the units of the plan's Y
    std::optional<double> tolerance = {};  ///< CIEDE2000 that `beyond` counts against
};

/// Bounds the error of every pixel of a collapse that it is a witness of: for each output
///
///     arithmetic      g(n) SUM|w s| + 2^-24 |v|,  g(n) = n u / (1 - n u), u = 2^-53, n terms in the sum
///                     (Higham, Accuracy and Stability of Numerical Algorithms, 2002, 3.1)
///     plan            |v - v'| and the arithmetic of v', the sum with the reference's weights
///     input storage   SUM |w| (half a unit in the last place of each half)
///     output storage  half a unit in the last place of the stored type, or what clamping took
///
/// carried to X, Y, Z by the absolute values of the space's matrix and to CIEDE2000 by lab_bound.h.
/// Memory is a few kB a worker.
class ErrorBudget final : public CollapseWitness {
  public:
    /// The refusals of output_colour(); Usage for an encoded space with alpha, whose samples are products.
    [[nodiscard]] static Result<std::unique_ptr<ErrorBudget>> create(BudgetSubject subject);

    ErrorBudget(const ErrorBudget&) = delete;
    ErrorBudget& operator=(const ErrorBudget&) = delete;
    ~ErrorBudget() override;

    [[nodiscard]] std::unique_ptr<WitnessWorker> start_worker() override;

    /// When the collapse has ended.
    [[nodiscard]] const BudgetResult& result() const { return m_result; }

  private:
    struct Setup;
    class Worker;
    explicit ErrorBudget(std::unique_ptr<Setup> setup);

    std::unique_ptr<Setup> m_setup;
    BudgetResult m_result;
};

}  // namespace osio
