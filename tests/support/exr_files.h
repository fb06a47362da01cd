// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfLineOrder.h>
#include <OpenEXR/ImfPixelType.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// OpenEXR files written by OpenEXR itself, for our reader.
namespace osio::test {

struct TestChannel {
    std::string name;
    Imf::PixelType type = Imf::FLOAT;
    int sampling = 1;
    bool perceptual = false;  ///< B44 keeps the logarithm of such a channel
};

/// What a sample is, by channel index and pixel of the data window.
using TestPattern = std::function<double(std::size_t channel, int x, int y)>;

struct TestPart {
    explicit TestPart(std::vector<TestChannel> part_channels) : channels(std::move(part_channels)) {}

    std::vector<TestChannel> channels;
    Imath::Box2i data_window{{0, 0}, {36, 52}};
    std::optional<Imath::Box2i> display_window;
    Imf::Compression compression = Imf::ZIP_COMPRESSION;
    Imf::LineOrder line_order = Imf::INCREASING_Y;
    std::optional<Imath::V2i> tiles;
    bool mipmaps = false;
    bool deep = false;
    std::string name;
    TestPattern pattern;  ///< default: smooth and different everywhere
    std::function<void(Imf::Header&)> attributes;
};

/// A folder that goes away with the test.
class TestFolder {
  public:
    TestFolder();
    ~TestFolder();
    TestFolder(const TestFolder&) = delete;
    TestFolder& operator=(const TestFolder&) = delete;

    [[nodiscard]] std::string path(const std::string& name) const { return (m_path / name).string(); }

    /// Names of the files in it.
    [[nodiscard]] std::vector<std::string> files() const;

  private:
    std::filesystem::path m_path;
};

/// The default pattern.
[[nodiscard]] double smooth(std::size_t channel, int x, int y);

/// Writes a file of one or several parts.
void write_exr(const std::string& path, const std::vector<TestPart>& parts);

/// Bands of a family every `step` nm.
[[nodiscard]] std::vector<TestChannel> band_channels(const std::string& family, int first, int step, int last,
                                                     Imf::PixelType type = Imf::FLOAT);

/// One channel of one part, read whole by OpenEXR's C++ API, as bytes in rows.
[[nodiscard]] std::vector<char> read_with_openexr(const std::string& path, int part,
                                                  const std::string& channel);

}  // namespace osio::test
