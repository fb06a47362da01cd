// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/spectral_image.h>

#include <osio/base/result.h>
#include <osio/layout/open_words.h>

#include <OpenEXR/ImfPixelType.h>
#include <OpenEXR/openexr_context.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace osio::exr {

class ChunkMap;

using image::Grain;
using image::PlaneChannels;
using image::Window;

/// An OpenEXR file, headers read.
class ExrFile final : public image::SpectralImage, public std::enable_shared_from_this<ExrFile> {
  public:
    /// Io where the system refuses, NotSpectral where it is no OpenEXR file, Damaged where headers
    /// contradict themselves, the file's length or our limits, Contradiction where the user's words fit no part.
    [[nodiscard]] static Result<std::shared_ptr<const ExrFile>> open(const std::string& path,
                                                                     const OpenWords& words = {});

    ~ExrFile() override;

    [[nodiscard]] std::string_view format() const override { return "OpenEXR"; }

    /// exr::make_block_source() of this file.
    [[nodiscard]] Result<std::unique_ptr<BlockSource>>
    make_block_source(std::size_t part, PlaneChannels planes, Grain grain) const override;

    /// Where the chunks lie, and their checksums where the file has some.
    [[nodiscard]] const ChunkMap& chunks() const { return *m_chunks; }

    /// For OpenEXRCore's functions; null where Core cannot read the file and the C++ API can.
    [[nodiscard]] exr_const_context_t context() const { return m_context; }

  private:
    explicit ExrFile(std::string path) : SpectralImage(std::move(path)) {}

    [[nodiscard]] Result<void> check_chunks(std::uint64_t file_bytes) const;
    [[nodiscard]] Result<void> read_headers(std::uint64_t file_bytes, const OpenWords& words);
    [[nodiscard]] std::vector<std::uint64_t> chunk_counts() const;

    exr_context_t m_context = nullptr;
    std::shared_ptr<const ChunkMap> m_chunks;
};

/// True where the file exists and starts with OpenEXR's magic number. Never an error.
[[nodiscard]] bool starts_like_exr(const std::string& path);

/// The last message of OpenEXRCore on this thread, as an Error; the message is then forgotten.
[[nodiscard]] tl::unexpected<Error> core_failure(exr_result_t code, const std::string& path);

/// The word for a compression, and the compression for a word (case ignored).
[[nodiscard]] std::string compression_name(Imf::Compression compression);
[[nodiscard]] Result<Imf::Compression> find_compression(std::string_view name);

/// OpenEXR's word for a sample's type.
[[nodiscard]] Imf::PixelType pixel_type(SampleType type);

/// The version of the OpenEXR library that is running, such as "3.1.5".
[[nodiscard]] std::string library_version();

}  // namespace osio::exr
