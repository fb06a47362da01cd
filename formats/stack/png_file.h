// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/files/raw_file.h>
#include <formats/image/spectral_image.h>
#include <formats/stack/png_pixels.h>

#include <memory>
#include <optional>
#include <string>

namespace osio::stack {

/// A PNG file as one channel, Y. Its numbers count as shares of the largest of their type, as PNG defines them, or of
/// `scale`. Nothing says what they hold, so no set has it. Its pixels are unpacked once for each source, and held.
class PngFile final : public image::SpectralImage, public std::enable_shared_from_this<PngFile> {
  public:
    /// Io where the system refuses, and the refusals of read_png_header().
    [[nodiscard]] static Result<std::shared_ptr<const PngFile>> open(const std::string& path,
                                                                     std::optional<double> scale);

    [[nodiscard]] std::string_view format() const override { return "PNG"; }

    [[nodiscard]] Result<std::unique_ptr<BlockSource>>
    make_block_source(std::size_t part, image::PlaneChannels planes, image::Grain grain) const override;

  private:
    class Rows;
    class Reader;

    PngFile(const std::string& path, files::RawFile file, PngHeader header, double divisor)
        : SpectralImage(path), m_file(std::move(file)), m_header(std::move(header)), m_divisor(divisor) {}

    files::RawFile m_file;
    PngHeader m_header;
    double m_divisor;
};

/// True where a file exists and starts as PNG files do.
[[nodiscard]] bool starts_like_png(const std::string& path);

}  // namespace osio::stack
