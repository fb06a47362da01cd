// SPDX-License-Identifier: Apache-2.0
#include <formats/convert/fan_out.h>
#include <formats/convert/joined_rows.h>

#include <algorithm>

namespace osio::convert {

namespace {

/// Which of the planes that are read each output takes.
using PlanesOf = std::vector<std::vector<std::size_t>>;

/// Hands each block to all outputs.
class FanOut final : public BlockVisitor {
  public:
    FanOut(const std::vector<std::unique_ptr<Sink>>& sinks, const PlanesOf& planes) : m_planes(planes) {
        for (const auto& sink : sinks)
            m_visitors.push_back(sink->start());
        m_blocks.resize(sinks.size());
    }

    void process(const PlanarBlock& block) override {
        for (std::size_t i = 0; i < m_visitors.size(); ++i) {
            m_blocks[i] = {block.first_row, block.row_count, block.width, {}, block.row_pitch_bytes};
            for (const std::size_t plane : m_planes[i])
                m_blocks[i].planes.push_back(block.planes[plane]);
            m_visitors[i]->process(m_blocks[i]);
        }
    }

    [[nodiscard]] Result<void> deliver(const PlanarBlock&) override {
        for (std::size_t i = 0; i < m_visitors.size(); ++i)
            OSIO_CHECK_OK(m_visitors[i]->deliver(m_blocks[i]));
        return {};
    }

  private:
    const PlanesOf& m_planes;
    std::vector<std::unique_ptr<BlockVisitor>> m_visitors;
    std::vector<PlanarBlock> m_blocks;
};

}  // namespace

Result<void> write_outputs(const Request& request, const Target& target, std::span<const Output> outputs,
                           Runner& runner, const Progress& progress, Outcome& outcome) {
    const Choice& first = outputs.front().choice;
    image::PlaneChannels read;
    PlanesOf planes;
    for (const Output& output : outputs) {
        planes.emplace_back();
        for (const std::size_t channel : output.choice.channels) {
            const auto found = std::find(read.begin(), read.end(), std::optional(channel));
            planes.back().push_back(static_cast<std::size_t>(found - read.begin()));
            if (found == read.end())
                read.emplace_back(channel);
        }
    }
    OSIO_TRY(auto source,
             first.image->make_block_source(first.part_index, std::move(read), image::Grain::Block));
    std::vector<std::unique_ptr<Sink>> sinks;
    for (const Output& output : outputs) {
        Request one = request;
        one.output = output.path;
        OSIO_TRY(auto sink, target.open(one, output.choice, outcome));
        sinks.push_back(std::move(sink));
    }
    const image::Window& window = first.part().data_window;
    const RowRange rows{window.min_y, window.max_y};
    int together = 0;
    for (const auto& sink : sinks)
        together = std::max(together, sink->rows_together());
    if (together > 0)
        source = regroup(std::move(source), rows, together);
    const auto start = [&] { return std::make_unique<FanOut>(sinks, planes); };
    OSIO_CHECK_OK(visit_blocks(*source, rows, runner, start, progress));
    for (std::size_t i = 0; i < sinks.size(); ++i) {
        OSIO_CHECK_OK(sinks[i]->finish(request.durability, outcome));
        outcome.outputs.push_back(outputs[i].path);
    }
    return {};
}

std::string split_path(const std::string& pattern, std::string_view mark, const std::string& name,
                       const std::string& otherwise) {
    std::string out = pattern;
    if (out.find(mark) == std::string::npos)
        return out.insert(out.rfind('.'), otherwise);
    for (std::size_t at = 0; (at = out.find(mark, at)) != std::string::npos; at += name.size())
        out.replace(at, mark.size(), name);
    return out;
}

}  // namespace osio::convert
