// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/convert/choice.h>
#include <formats/convert/samples.h>
#include <formats/exr/exr_writer.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace osio::convert {

/// A part of the output and which of the choice's channels it holds.
struct PartPlan {
    exr::OutputPart part;
    std::vector<std::size_t> planes;
};

/// Names and types of a choice's channels as an EXR stores them; says in the outcome what that loses.
[[nodiscard]] std::vector<exr::OutputChannel> stored_channels(const Request& request, const Choice& choice,
                                                              Outcome& outcome);

/// The header of a choice's channels: its attributes, with the request's compression and tiles, and what the layout of
/// such channels asks for. UnknownName for a compression that there is not.
[[nodiscard]] Result<Imf::Header> stored_header(const Request& request, const Choice& choice,
                                                const std::vector<exr::OutputChannel>& channels);

/// A worker's blocks, converted and packed, for parts of a file that are made of the same blocks.
class Packing final : public BlockVisitor {
  public:
    /// `parts` are the file's from `first_part` on.
    Packing(exr::ExrWriter& writer, std::span<const PartPlan> parts, std::size_t first_part,
            std::size_t width, std::uint64_t& clamped);

    void process(const PlanarBlock& block) override;
    [[nodiscard]] Result<void> deliver(const PlanarBlock& block) override;

  private:
    std::span<const PartPlan> m_parts;
    std::vector<std::unique_ptr<exr::ExrWriter::Packer>> m_packers;
    std::vector<std::vector<SampleBuffer>> m_buffers;  // of each part's channels
    std::vector<Result<void>> m_packed;
    std::size_t m_width;
    std::uint64_t& m_clamped;
    std::uint64_t m_told = 0;  // of m_buffers' counts
};

}  // namespace osio::convert
