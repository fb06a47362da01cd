// SPDX-License-Identifier: Apache-2.0
#include <formats/trade/rows_beside.h>

#include <osio/collapse/kernel.h>

namespace osio::trade {

Result<std::span<const BandView>> RowsBeside::read(RowRange rows) {
    if (m_reader == nullptr) {
        OSIO_TRY(m_reader, m_source.start_reader());
    }
    const auto width = static_cast<std::size_t>(m_source.width());
    const std::size_t pixels = static_cast<std::size_t>(rows.last - rows.first + 1) * width;
    for (std::size_t block = m_source.block_of_row(rows.first); block <= m_source.block_of_row(rows.last);
         ++block) {
        OSIO_TRY(const PlanarBlock whole, m_reader->read(block));
        const PlanarBlock part = whole.among(rows);
        const std::size_t at = static_cast<std::size_t>(part.first_row - rows.first) * width;
        m_planes.resize(part.planes.size());
        for (std::vector<float>& plane : m_planes)
            plane.resize(pixels);
        const auto wanted = static_cast<std::size_t>(part.row_count) * width;
        part.for_each_run([&](std::size_t first, std::size_t count, std::span<const BandView> views) {
            for (std::size_t p = 0; p < views.size(); ++p)
                for (std::size_t i = 0; views[p].data != nullptr && i < count && first + i < wanted; ++i)
                    m_planes[p][at + first + i] = static_cast<float>(sample_at(views[p], i));
        });
    }
    m_views.clear();
    for (const std::vector<float>& plane : m_planes)
        m_views.push_back(
            {reinterpret_cast<const std::byte*>(plane.data()), SampleType::Float, sizeof(float)});
    return std::span<const BandView>(m_views);
}

}  // namespace osio::trade
