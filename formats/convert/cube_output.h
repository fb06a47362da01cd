// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/convert/choice.h>
#include <formats/convert/samples.h>

#include <osio/collapse/stream.h>

#include <string>
#include <string_view>
#include <vector>

/// What outputs have in common that hold one set's bands as floats, and attributes as text.
namespace osio::convert {

/// A block's planes as floats; for one worker.
class FloatPlanes {
  public:
    explicit FloatPlanes(std::size_t planes) : m_buffers(planes), m_planes(planes) {}

    /// They live until the next call, or as long as the block's.
    [[nodiscard]] std::span<const float* const> of(const PlanarBlock& block) {
        for (std::size_t p = 0; p < m_planes.size(); ++p)
            m_planes[p] = reinterpret_cast<const float*>(m_buffers[p].convert(block, p, SampleType::Float));
        return m_planes;
    }

  private:
    std::vector<SampleBuffer> m_buffers;
    std::vector<const float*> m_planes;
};

/// Widths of the choice's bands; none where the part does not say them.
[[nodiscard]] std::vector<double> widths_of(const Choice& choice);

/// Attributes that a cube states by its own means, or that every header of OpenEXR has.
[[nodiscard]] bool is_stated(const std::string& name, const Imf::Header& header, bool with_fwhm);

/// Says what such an output does not hold of a choice, but its attributes.
void note_cube_losses(const Choice& choice, std::vector<std::string>& lost);

/// The same of the attributes of these names.
void note_lost_attributes(const std::vector<std::string>& names, std::vector<std::string>& lost);

}  // namespace osio::convert
