// SPDX-License-Identifier: Apache-2.0
#include <formats/image/grey_budget.h>

#include <osio/collapse/kernel.h>

#include <Imath/half.h>

#include <cstring>

namespace osio::image {

namespace {

constexpr std::size_t kGreys = 101;

/// All greys as samples of one type.
std::vector<std::byte> samples_of(SampleType type) {
    const std::size_t size = sample_bytes(type);
    std::vector<std::byte> out(kGreys * size);
    for (std::size_t i = 0; i < kGreys; ++i) {
        const float grey = static_cast<float>(i) / (kGreys - 1);
        if (type == SampleType::Half) {
            const std::uint16_t bits = Imath::half(grey).bits();
            std::memcpy(out.data() + i * size, &bits, size);
        } else {
            std::memcpy(out.data() + i * size, &grey, size);
        }
    }
    return out;
}

}  // namespace

Result<BudgetResult> grey_budget(const CollapseJob& job) {
    if (job.plan.request.scale != Scale::Relative)
        return fail(ErrorCode::Usage, "greys have a budget with scale=relative only");
    std::vector<SampleType> types = job.column_types();
    for (SampleType& type : types)
        if (type == SampleType::Uint)
            type = SampleType::Float;
    OSIO_TRY(const auto budget, ErrorBudget::create({job.plan, types, StoredDepth::Float}));

    const std::vector<std::byte> half = samples_of(SampleType::Half), whole = samples_of(SampleType::Float);
    const std::vector<std::byte> none(whole.size());
    std::vector<BandView> bands;
    for (std::size_t column = 0; column < types.size(); ++column) {
        const bool band = column < job.plan.bands.size();
        const std::vector<std::byte>& samples = !band                               ? none
                                                : types[column] == SampleType::Half ? half
                                                                                    : whole;
        bands.push_back(
            {samples.data(), types[column], static_cast<std::ptrdiff_t>(sample_bytes(types[column]))});
    }
    std::vector<std::vector<float>> planes(job.plan.weights.rows(), std::vector<float>(kGreys));
    std::vector<float*> out;
    for (std::vector<float>& plane : planes)
        out.push_back(plane.data());
    collapse_run(bands, job.plan.weights, kGreys, out);
    const auto worker = budget->start_worker();
    worker->look(bands, kGreys, std::vector<const float*>(out.begin(), out.end()));
    worker->deliver();
    return budget->result();
}

}  // namespace osio::image
