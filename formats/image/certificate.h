// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/collapse_job.h>

#include <osio/budget/error_budget.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace osio::image {

namespace attribute {
inline constexpr const char* kCertificate = "spectral:certificate";  ///< certificate_json() in one line
}

/// What is proved of one collapse, and what is not.
struct Certificate {
    std::string output;  ///< the file; empty: rows for a host
    StoredDepth depth = StoredDepth::Float;
    BudgetResult budget;
    CollapseCounts counts;
    double white_luminance = 1;
    std::string white_reason;               ///< where it comes from, in words
    std::string indicator_over;             ///< what the indicator was taken over, in words
    std::vector<std::string> alternatives;  ///< names of the bases that the indicator compares with
    std::string assumption;                 ///< what the indicator rests on
    std::optional<double> max_delta_e;      ///< what was asked for

    /// True where every pixel is defined and its proved total plus indicator within what was asked for.
    [[nodiscard]] bool holds() const {
        return budget.undefined == 0 && (!max_delta_e || budget.with_indicator <= *max_delta_e);
    }

    /// Why it does not hold: which term is too large, and what would help. For one that does not.
    [[nodiscard]] std::string failure(const CollapseJob& job) const;
};

/// Watches a collapse and certifies it.
class Certifier {
  public:
    /// Where the request leaves `white-luminance` open and the bands are radiance, reads the image once to find
    /// the 99th percentile of Y. With `max-delta-e` the indicator is taken at every pixel, which takes as many
    /// collapses as there are bases; else over the patches of basis_spread(). The refusals of ErrorBudget::create() and of reading;
    /// Unsupported for halves that a dialect scales.
    [[nodiscard]] static Result<std::unique_ptr<Certifier>> create(const CollapseJob& job, StoredDepth depth,
                                                                   const TextLoader& load_text,
                                                                   Runner& runner, const Progress& progress);

    [[nodiscard]] CollapseWitness& witness() { return *m_budget; }

    /// Bands that the witness looks at beside the plan's.
    [[nodiscard]] const std::vector<CollapsePlan>& alternatives() const { return m_alternatives; }

    /// When the collapse has ended with these counts.
    [[nodiscard]] Certificate certificate(std::string output, const CollapseCounts& counts) const;

  private:
    Certifier() = default;
    void compare_everywhere(const CollapseJob& job, const TextLoader& load_text, BudgetSubject& subject);
    void compare_patches(const CollapseJob& job);

    double m_patch_indicator = 0;
    std::vector<CollapsePlan> m_alternatives;
    std::unique_ptr<ErrorBudget> m_budget;
    Certificate m_certificate;  ///< without what only the collapse tells
};

/// Collapses the whole image into nothing, for the certificate of rows that a host will ask for. NotCertified
/// where it does not hold.
[[nodiscard]] Result<Certificate> certify_for_host(const CollapseJob& job, const TextLoader& load_text,
                                                   Runner& runner);

/// Everything as JSON: indented, or in one line for an attribute.
[[nodiscard]] std::string certificate_json(const CollapseJob& job, const Certificate& certificate,
                                           bool one_line);

/// Bytes that certificate_json() of the job in one line does not exceed, whatever the numbers.
[[nodiscard]] std::size_t most_certificate_bytes(const CollapseJob& job);

}  // namespace osio::image
