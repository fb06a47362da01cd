// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/block_buffer.h>
#include <formats/exr/block_readers.h>

#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>

#include <exception>

namespace osio::exr {

namespace {

class ImfReader final : public BlockReader {
  public:
    explicit ImfReader(const BlockJob& job)
        : m_job(job), m_part(job.file->parts()[job.part]), m_buffer(m_part, job.planes, job.grid),
          m_file(job.file->path().c_str(), 0, false), m_input(m_file, static_cast<int>(job.part)) {}

    [[nodiscard]] Result<PlanarBlock> read(std::size_t block) override {
        const int first = m_job.grid.first_row(block);
        const int count = m_job.grid.row_count(block);
        try {
            m_input.setFrameBuffer(frame_buffer(first));
            m_input.readPixels(first, first + count - 1);
        } catch (const std::bad_alloc&) {
            return fail(ErrorCode::Io, "out of memory", m_job.file->path());
        } catch (const std::exception& error) {
            return fail(ErrorCode::Damaged, error.what(), m_job.file->path());
        }
        return m_buffer.block(first, count);
    }

  private:
    Imf::FrameBuffer frame_buffer(int first_row) {
        const Window& window = m_job.grid.window;
        Imf::FrameBuffer out;
        for (std::size_t plane = 0; plane < m_job.planes.size(); ++plane) {
            if (!m_job.planes[plane])
                continue;
            const image::Channel& channel = m_part.channels[*m_job.planes[plane]];
            out.insert(channel.name, Imf::Slice::Make(pixel_type(channel.type), m_buffer.plane(plane),
                                                      Imath::V2i(window.min_x, first_row), window.width(),
                                                      m_job.grid.rows_per_block));
        }
        return out;
    }

    BlockJob m_job;
    const image::Part& m_part;
    BlockBuffer m_buffer;
    Imf::MultiPartInputFile m_file;
    Imf::InputPart m_input;
};

}  // namespace

Result<std::unique_ptr<BlockReader>> make_imf_reader(const BlockJob& job) {
    try {
        return std::make_unique<ImfReader>(job);
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::Io, "out of memory", job.file->path());
    } catch (const std::exception& error) {
        return fail(ErrorCode::Damaged, error.what(), job.file->path());
    }
}

}  // namespace osio::exr
