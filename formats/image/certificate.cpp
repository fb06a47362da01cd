// SPDX-License-Identifier: Apache-2.0
#include <formats/image/certificate.h>
#include <formats/image/white_luminance.h>

#include <osio/base/text.h>
#include <osio/budget/basis_alternatives.h>
#include <osio/collapse/basis_spread.h>

#include <algorithm>
#include <cmath>

namespace osio::image {

namespace {

/// Digits of a CIEDE2000 in a sentence.
constexpr int kDigits = 3;

/// Takes rows and forgets them.
class NoSink final : public RowSink {
  public:
    [[nodiscard]] Result<void> write_rows(int, int, std::span<const float* const>) override { return {}; }
};

RowRange all_rows(const CollapseJob& job) {
    return {job.part().data_window.min_y, job.part().data_window.max_y};
}

std::string delta_text(double delta_e) {
    return format_fixed(delta_e, kDigits);
}

std::string remedy(ErrorSource source) {
    switch (source) {
    case ErrorSource::Arithmetic: return "the sums cancel: no executor of ours is more exact";
    case ErrorSource::Plan: return "use the reference's own weights";
    case ErrorSource::InputStorage:
        return "the file's halves are too coarse: render or convert to float bands";
    case ErrorSource::OutputStorage: break;
    }
    return "store more digits: -d float";
}

}  // namespace

std::string Certificate::failure(const CollapseJob& job) const {
    if (budget.undefined > 0)
        return std::to_string(budget.undefined) + " of " + std::to_string(budget.pixels) +
               " pixels are NaN or infinite, of which nothing can be certified; expected numbers";
    std::string out = "the error of " + std::to_string(budget.beyond) + " of " +
                      std::to_string(budget.pixels) + " pixels is not shown to be within CIEDE2000 " +
                      format_double(*max_delta_e) + ": at most " + delta_text(budget.total.delta_e_2000) +
                      " is proved, and the indicator is " + delta_text(budget.indicator) + "; ";
    const auto largest =
        std::max_element(kErrorSources.begin(), kErrorSources.end(), [this](ErrorSource a, ErrorSource b) {
            return budget.term(a).delta_e_2000 < budget.term(b).delta_e_2000;
        });
    if (budget.indicator >= budget.total.delta_e_2000)
        return out + "the indicator fails: " + std::to_string(job.plan.distinct.grid.size()) + " bands of " +
               format_double(std::round(10 * job.plan.distinct.grid.mean_step_nm()) / 10) +
               " nm mean one colour with basis " + std::string(basis_name(job.plan.basis.basis)) +
               " and another with " + join(alternatives, ", ") +
               (job.plan.illuminant ? " under " + job.plan.illuminant->id : std::string()) +
               "; expected narrower bands, or a file that states its basis (spectral:basis)";
    return out + "the term that fails is " + std::string(error_source_name(*largest)) + ", " +
           delta_text(budget.term(*largest).delta_e_2000) + ": " + remedy(*largest);
}

Result<std::unique_ptr<Certifier>> Certifier::create(const CollapseJob& job, StoredDepth depth,
                                                     const TextLoader& load_text, Runner& runner,
                                                     const Progress& progress) {
    std::unique_ptr<Certifier> out(new Certifier);
    Certificate& certificate = out->m_certificate;
    const CollapseRequest& request = job.plan.request;
    certificate.depth = depth;
    certificate.max_delta_e = request.max_delta_e;
    certificate.assumption = alternatives_assumption(job.plan);
    BudgetSubject subject{job.plan, job.column_types(), depth, job.alpha.has_value()};
    for (const PlanColumn& column : job.plan.columns)
        if (const Channel& channel = job.part().channels[column.channel];
            channel.type == SampleType::Half && channel.scale != 1)
            return fail(ErrorCode::Unsupported,
                        "bands are halves that are read times " + format_double(channel.scale) +
                            ", and no bound counts how they were rounded; expected floats",
                        job.file->path());
    // What is refused is refused before the image is read for its white.
    OSIO_CHECK_OK(ErrorBudget::create(subject));
    OSIO_TRY(const WhiteLuminance white, white_luminance_of(job, load_text, runner, progress));
    certificate.white_luminance = white.y;
    certificate.white_reason = white.reason;
    if (request.max_delta_e)
        out->compare_everywhere(job, load_text, subject);
    else
        out->compare_patches(job);
    subject.white_luminance = certificate.white_luminance;
    subject.tolerance = request.max_delta_e;
    OSIO_TRY(out->m_budget, ErrorBudget::create(std::move(subject)));
    return out;
}

void Certifier::compare_everywhere(const CollapseJob& job, const TextLoader& load_text,
                                   BudgetSubject& subject) {
    m_alternatives = basis_alternatives(job.plan, job.set(), job.part().metadata, load_text);
    for (const CollapsePlan& plan : m_alternatives) {
        m_certificate.alternatives.emplace_back(basis_name(plan.basis.basis));
        subject.alternatives.push_back(&plan);
    }
    m_certificate.indicator_over = "every pixel";
}

void Certifier::compare_patches(const CollapseJob& job) {
    for (const BasisSpread& spread : basis_spread(job.plan)) {
        if (!is_alternative(job.plan, spread.basis))
            continue;
        m_certificate.alternatives.emplace_back(basis_name(spread.basis));
        m_patch_indicator = std::max(m_patch_indicator, spread.residual.max);
    }
    m_certificate.indicator_over = std::string("the 24 patches of the ColorChecker") +
                                   (job.plan.reradiation ? ", which do not fluoresce" : "");
}

Certificate Certifier::certificate(std::string output, const CollapseCounts& counts) const {
    Certificate out = m_certificate;
    out.output = std::move(output);
    out.budget = m_budget->result();
    if (!out.max_delta_e) {
        out.budget.indicator = m_patch_indicator;
        out.budget.with_indicator = out.budget.total.delta_e_2000 + m_patch_indicator;
    }
    out.counts = counts;
    return out;
}

Result<Certificate> certify_for_host(const CollapseJob& job, const TextLoader& load_text, Runner& runner) {
    OSIO_TRY(const auto certifier, Certifier::create(job, StoredDepth::Float, load_text, runner, {}));
    OSIO_TRY(const auto source, open_source({&job, 1}, certifier->alternatives()));
    NoSink nothing;
    const CollapseTarget target{job.plan, nothing, &certifier->witness()};
    OSIO_TRY(const auto counts,
             collapse_stream(*source, {&target, 1}, job.alpha.has_value(), all_rows(job), runner, {}));
    Certificate out = certifier->certificate({}, counts.front());
    if (!out.holds())
        return fail(ErrorCode::NotCertified, out.failure(job), job.file->path());
    return out;
}

}  // namespace osio::image
