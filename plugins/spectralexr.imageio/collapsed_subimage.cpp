// SPDX-License-Identifier: Apache-2.0
#include <plugins/common/exr_metadata.h>
#include <plugins/spectralexr.imageio/spec.h>
#include <plugins/spectralexr.imageio/subimage.h>

#include <formats/exr/output_header.h>
#include <formats/image/certificate.h>

#include <osio/collapse/collapse_stream.h>

namespace osio::plugin {

namespace {

/// Writes planar rows of floats as interleaved pixels.
class InterleavedSink final : public RowSink {
  public:
    InterleavedSink(int first_row, std::size_t width, float* out)
        : m_first_row(first_row), m_width(width), m_out(out) {}

    [[nodiscard]] Result<void> write_rows(int first_row, int row_count,
                                          std::span<const float* const> planes) override {
        const std::size_t channels = planes.size();
        const std::size_t count = static_cast<std::size_t>(row_count) * m_width;
        float* out = m_out + static_cast<std::size_t>(first_row - m_first_row) * m_width * channels;
        for (std::size_t c = 0; c < channels; ++c)
            for (std::size_t i = 0; i < count; ++i)
                out[i * channels + c] = planes[c][i];
        return {};
    }

  private:
    int m_first_row;
    std::size_t m_width;
    float* m_out;
};

class CollapsedSubimage final : public Subimage {
  public:
    CollapsedSubimage(OIIO::ImageSpec spec, std::unique_ptr<BlockSource> source, image::CollapseJob job)
        : Subimage(std::move(spec), std::move(source)), m_job(std::move(job)) {}

    [[nodiscard]] Result<void> read_rows(RowRange rows, std::byte* out, Runner& runner) override {
        InterleavedSink sink(rows.first, static_cast<std::size_t>(spec().width),
                             reinterpret_cast<float*>(out));
        const auto counts =
            collapse_stream(source(), m_job.plan, m_job.alpha.has_value(), rows, sink, runner, {});
        if (!counts)
            return tl::unexpected(counts.error());
        return {};
    }

  private:
    image::CollapseJob m_job;
};

}  // namespace

Result<std::unique_ptr<Subimage>> make_collapsed_subimage(image::CollapseJob job, int subimage_count,
                                                          const std::string& certificate) {
    OIIO::ImageSpec spec = spec_of_windows(job.part());
    spec.format = OIIO::TypeFloat;
    spec.channelnames = job.channel_names();
    spec.nchannels = static_cast<int>(spec.channelnames.size());
    if (job.alpha)
        spec.alpha_channel = spec.nchannels - 1;
    add_metadata(exr::collapsed_header(job), spec);
    if (!certificate.empty())
        spec.attribute(image::attribute::kCertificate, certificate);
    spec.attribute("oiio:subimages", subimage_count);
    if (subimage_count > 1)
        spec.attribute("oiio:subimagename", job.plan.request.illuminant);
    OSIO_TRY(auto source, job.open_source());
    return std::make_unique<CollapsedSubimage>(std::move(spec), std::move(source), std::move(job));
}

}  // namespace osio::plugin
