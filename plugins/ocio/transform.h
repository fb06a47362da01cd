// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/colour/colour_transform.h>

#include <OpenColorIO/OpenColorIO.h>

namespace osio::ocio {

namespace OCIO = OCIO_NAMESPACE;

/// OpenColorIO's processor for the CPU, with its default optimisation: what hosts use too.
class CpuTransform final : public ColourTransform {
  public:
    /// Throws OCIO::Exception where the processor cannot be made for the CPU.
    CpuTransform(const OCIO::ConstProcessorRcPtr& processor, TransformSource source);

    void apply(std::span<float* const, 3> planes, std::size_t pixels) const override;

    [[nodiscard]] bool is_linear() const override { return m_linear; }

    [[nodiscard]] const TransformSource& source() const override { return m_source; }

  private:
    OCIO::ConstCPUProcessorRcPtr m_cpu;
    bool m_linear;
    TransformSource m_source;
};

}  // namespace osio::ocio
