// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/exr_writer.h>

#include <Imath/half.h>

#include <cmath>

namespace osio::exr {

namespace {

/// The largest finite half.
constexpr float kHalfMax = 65504.0F;

}  // namespace

/// A worker's rows, converted and packed.
class ExrSink::Worker final : public RowWorker {
  public:
    explicit Worker(ExrSink& sink) : m_sink(sink), m_packer(sink.m_writer->start_packer(sink.m_part)) {}

    [[nodiscard]] Result<void> prepare(int first_row, int row_count,
                                       std::span<const float* const> planes) override {
        const std::size_t samples = static_cast<std::size_t>(row_count) * m_sink.m_width;
        const bool half = m_sink.m_type == SampleType::Half;
        const auto bytes = static_cast<std::ptrdiff_t>(sample_bytes(m_sink.m_type));
        m_clamped = 0;
        m_channels.clear();
        if (half)
            m_halves.resize(samples * planes.size());
        for (std::size_t c = 0; c < planes.size(); ++c) {
            const void* data = planes[c];
            if (half) {
                std::uint16_t* const halves = m_halves.data() + c * samples;
                to_halves(planes[c], samples, halves);
                data = halves;
            }
            m_channels.push_back({static_cast<const std::byte*>(data), bytes,
                                  bytes * static_cast<std::ptrdiff_t>(m_sink.m_width)});
        }
        return m_packer->pack(first_row, row_count, m_channels);
    }

    [[nodiscard]] Result<void> deliver() override {
        m_sink.m_clamped += m_clamped;
        return m_packer->write();
    }

  private:
    void to_halves(const float* from, std::size_t count, std::uint16_t* to) {
        for (std::size_t i = 0; i < count; ++i) {
            const bool clamped = std::abs(from[i]) > kHalfMax;
            m_clamped += clamped;
            to[i] = Imath::half(clamped ? std::copysign(kHalfMax, from[i]) : from[i]).bits();
        }
    }

    ExrSink& m_sink;
    std::unique_ptr<ExrWriter::Packer> m_packer;
    std::vector<std::uint16_t> m_halves;
    std::vector<ChannelRows> m_channels;
    std::uint64_t m_clamped = 0;
};

ExrSink::ExrSink(std::shared_ptr<ExrWriter> writer, SampleType type, int width, std::size_t part)
    : m_writer(std::move(writer)), m_part(part), m_type(type), m_width(static_cast<std::size_t>(width)) {}

std::unique_ptr<RowWorker> ExrSink::start_worker() {
    return std::make_unique<Worker>(*this);
}

Result<void> ExrSink::write_rows(int first_row, int row_count, std::span<const float* const> planes) {
    Worker worker(*this);
    OSIO_CHECK_OK(worker.prepare(first_row, row_count, planes));
    return worker.deliver();
}

}  // namespace osio::exr
