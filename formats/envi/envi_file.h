// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/envi/attribute_fields.h>
#include <formats/envi/envi_header.h>
#include <formats/files/raw_file.h>
#include <formats/image/spectral_image.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace osio::envi {

/// A header and a data file. One part; a channel a band, in the file's order: bands that have a wavelength and
/// are not bad have names of the layout (T or S0, by what the header says of its numbers), the others are
/// called `band.N` and `bad.N`, counted from 1. Samples are floats: ENVI's own numbers, scaled as the header
/// says.
class EnviFile final : public image::SpectralImage, public std::enable_shared_from_this<EnviFile> {
  public:
    /// Opens by the header's path or the data file's. Io where the system refuses; NotSpectral where there
    /// is no ENVI header; Damaged where there is no data file or it is shorter than the header promises;
    /// the refusals of parse_header(), with the user's words.
    [[nodiscard]] static Result<std::shared_ptr<const EnviFile>> open(const std::string& path,
                                                                      const OpenWords& words = {});

    [[nodiscard]] std::string_view format() const override { return "ENVI"; }

    [[nodiscard]] const EnviHeader& header() const { return m_header; }

    [[nodiscard]] const std::string& data_path() const { return m_data_path; }

    /// The bytes of the data file.
    [[nodiscard]] const files::RawFile& data() const { return m_data; }

    /// Blocks of rows, read where a worker asks for them; memory is that of a block and of a row of all bands.
    [[nodiscard]] Result<std::unique_ptr<BlockSource>>
    make_block_source(std::size_t part, image::PlaneChannels planes, image::Grain grain) const override;

  private:
    EnviFile(const std::string& path, std::string data_path, EnviHeader header, files::RawFile data)
        : SpectralImage(path), m_data_path(std::move(data_path)), m_header(std::move(header)),
          m_data(std::move(data)) {}

    std::string m_data_path;
    EnviHeader m_header;
    files::RawFile m_data;
};

/// The header that a path names: the path itself where its file starts with the word ENVI, else the header
/// beside it (`cube.dat.hdr`, `cube.hdr`). Nothing where there is none. Never an error.
[[nodiscard]] std::optional<std::string> find_header(const std::string& path);

/// The data files that lie beside a header, in the order in which they are believed.
[[nodiscard]] std::vector<std::string> data_files_of(const std::string& header);

}  // namespace osio::envi
