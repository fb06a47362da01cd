// SPDX-License-Identifier: Apache-2.0
#include <plugins/ocio/transform.h>

#include <algorithm>
#include <array>

namespace osio::ocio {

namespace {

/// Planes are packed as RGBA, 16 bytes a pixel, inside OpenColorIO: a run stays in a core's cache.
constexpr std::size_t kRun = 4096;

bool has_offset(const OCIO::MatrixTransform& matrix) {
    std::array<double, 4> offset{};
    matrix.getOffset(offset.data());
    return std::any_of(offset.begin(), offset.end(), [](double value) { return value != 0; });
}

/// True where all that is left after optimisation are matrices without offsets.
bool is_matrix(const OCIO::ConstProcessorRcPtr& processor) {
    const auto steps = processor->getOptimizedProcessor(OCIO::OPTIMIZATION_DEFAULT)->createGroupTransform();
    for (int i = 0; i < steps->getNumTransforms(); ++i) {
        const auto matrix = OCIO_DYNAMIC_POINTER_CAST<OCIO::MatrixTransform>(steps->getTransform(i));
        if (!matrix || has_offset(*matrix))
            return false;
    }
    return true;
}

}  // namespace

CpuTransform::CpuTransform(const OCIO::ConstProcessorRcPtr& processor, TransformSource source)
    : m_cpu(processor->getDefaultCPUProcessor()), m_linear(is_matrix(processor)),
      m_source(std::move(source)) {
    m_source.processor = processor->getCacheID();
}

void CpuTransform::apply(std::span<float* const, 3> planes, std::size_t pixels) const {
    for (std::size_t first = 0; first < pixels; first += kRun) {
        const auto run = static_cast<long>(std::min(kRun, pixels - first));
        OCIO::PlanarImageDesc image(planes[0] + first, planes[1] + first, planes[2] + first, nullptr, run, 1);
        m_cpu->apply(image);
    }
}

}  // namespace osio::ocio
