// SPDX-License-Identifier: Apache-2.0
#include <support/exr_files.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineOutputPart.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTiledOutputPart.h>

#include <cmath>
#include <cstring>
#include <random>

namespace osio::test {

namespace {

std::size_t bytes_of(Imf::PixelType type) {
    return type == Imf::HALF ? 2 : 4;
}

void put(Imf::PixelType type, double value, char* at) {
    if (type == Imf::HALF) {
        const Imath::half h(static_cast<float>(value));
        std::memcpy(at, &h, sizeof h);
    } else if (type == Imf::FLOAT) {
        const auto f = static_cast<float>(value);
        std::memcpy(at, &f, sizeof f);
    } else {
        const auto u = static_cast<std::uint32_t>(std::abs(value) * 1000);
        std::memcpy(at, &u, sizeof u);
    }
}

Imf::Header header_of(const TestPart& part, bool several) {
    Imf::Header header(part.display_window.value_or(part.data_window), part.data_window);
    header.compression() = part.compression;
    header.lineOrder() = part.line_order;
    for (const TestChannel& channel : part.channels)
        header.channels().insert(
            channel.name, Imf::Channel(channel.type, channel.sampling, channel.sampling, channel.perceptual));
    if (part.tiles)
        header.setTileDescription(Imf::TileDescription(static_cast<unsigned>(part.tiles->x),
                                                       static_cast<unsigned>(part.tiles->y),
                                                       part.mipmaps ? Imf::MIPMAP_LEVELS : Imf::ONE_LEVEL));
    header.setType(part.deep ? Imf::DEEPSCANLINE : part.tiles ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE);
    if (part.deep)
        header.setVersion(1);
    if (several || !part.name.empty())
        header.setName(part.name);
    if (part.attributes)
        part.attributes(header);
    return header;
}

/// A plane for each channel, and a frame buffer over them.
class Frame {
  public:
    explicit Frame(const TestPart& part) {
        const Imath::Box2i& w = part.data_window;
        for (std::size_t c = 0; c < part.channels.size(); ++c) {
            const TestChannel& channel = part.channels[c];
            const int s = channel.sampling;
            const int width = w.max.x / s - w.min.x / s + 1, height = w.max.y / s - w.min.y / s + 1;
            const std::size_t bytes = bytes_of(channel.type);
            m_planes.emplace_back(static_cast<std::size_t>(width * height) * bytes);
            char* at = m_planes.back().data();
            const TestPattern& pattern = part.pattern ? part.pattern : smooth;
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x, at += bytes)
                    put(channel.type, pattern(c, w.min.x + x * s, w.min.y + y * s), at);
            buffer.insert(channel.name,
                          Imf::Slice::Make(channel.type, m_planes.back().data(), w.min, width, height, bytes,
                                           bytes * static_cast<std::size_t>(width), s, s));
        }
    }

    Imf::FrameBuffer buffer;

  private:
    std::vector<std::vector<char>> m_planes;
};

void write_deep(Imf::MultiPartOutputFile& file, int index, const TestPart& part) {
    const Imath::Box2i& w = part.data_window;
    const int width = w.max.x - w.min.x + 1, height = w.max.y - w.min.y + 1;
    std::vector<unsigned> counts(static_cast<std::size_t>(width * height), 1);
    std::vector<std::vector<float>> samples(part.channels.size(), std::vector<float>(counts.size(), 0.5F));
    std::vector<std::vector<float*>> pointers(part.channels.size());
    Imf::DeepFrameBuffer buffer;
    const auto row = static_cast<std::size_t>(width);
    buffer.insertSampleCountSlice(Imf::Slice::Make(Imf::UINT, counts.data(), w.min, width, height));
    for (std::size_t c = 0; c < part.channels.size(); ++c) {
        for (float& sample : samples[c])
            pointers[c].push_back(&sample);
        auto* const base = reinterpret_cast<char*>(pointers[c].data()) -
                           (w.min.x + w.min.y * static_cast<std::ptrdiff_t>(row)) *
                               static_cast<std::ptrdiff_t>(sizeof(float*));
        buffer.insert(part.channels[c].name,
                      Imf::DeepSlice(Imf::FLOAT, base, sizeof(float*), sizeof(float*) * row, sizeof(float)));
    }
    Imf::DeepScanLineOutputPart output(file, index);
    output.setFrameBuffer(buffer);
    output.writePixels(height);
}

}  // namespace

TestFolder::TestFolder() {
    std::random_device random;
    do
        m_path = std::filesystem::temp_directory_path() / ("osio-test-" + std::to_string(random()));
    while (!std::filesystem::create_directory(m_path));
}

TestFolder::~TestFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(m_path, ignored);
}

std::vector<std::string> TestFolder::files() const {
    std::vector<std::string> out;
    for (const auto& entry : std::filesystem::directory_iterator(m_path))
        out.push_back(entry.path().filename().string());
    return out;
}

double smooth(std::size_t channel, int x, int y) {
    return 0.5 + 0.3 * std::sin(0.1 * x + 0.7 * static_cast<double>(channel)) +
           0.2 * std::cos(0.13 * y - 0.2 * static_cast<double>(channel));
}

void write_exr(const std::string& path, const std::vector<TestPart>& parts) {
    std::vector<Imf::Header> headers;
    for (const TestPart& part : parts)
        headers.push_back(header_of(part, parts.size() > 1));
    Imf::MultiPartOutputFile file(path.c_str(), headers.data(), static_cast<int>(headers.size()));
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const int index = static_cast<int>(i);
        if (parts[i].deep) {
            write_deep(file, index, parts[i]);
            continue;
        }
        const Frame frame(parts[i]);
        if (parts[i].tiles) {
            Imf::TiledOutputPart output(file, index);
            output.setFrameBuffer(frame.buffer);
            output.writeTiles(0, output.numXTiles(0) - 1, 0, output.numYTiles(0) - 1, 0);
            // Smaller levels: any pixels will do, they are not read.
            for (int level = 1; level < output.numLevels(); ++level)
                output.writeTiles(0, output.numXTiles(level) - 1, 0, output.numYTiles(level) - 1, level);
        } else {
            Imf::OutputPart output(file, index);
            output.setFrameBuffer(frame.buffer);
            output.writePixels(parts[i].data_window.max.y - parts[i].data_window.min.y + 1);
        }
    }
}

std::vector<TestChannel> band_channels(const std::string& family, int first, int step, int last,
                                       Imf::PixelType type) {
    std::vector<TestChannel> out;
    for (int nm = first; nm <= last; nm += step)
        out.push_back({family + "." + std::to_string(nm) + "nm", type});
    return out;
}

std::vector<char> read_with_openexr(const std::string& path, int part, const std::string& channel) {
    Imf::MultiPartInputFile file(path.c_str());
    Imf::InputPart input(file, part);
    const Imath::Box2i w = input.header().dataWindow();
    const int width = w.max.x - w.min.x + 1, height = w.max.y - w.min.y + 1;
    const Imf::PixelType type = input.header().channels().findChannel(channel)->type;
    std::vector<char> out(static_cast<std::size_t>(width * height) * bytes_of(type));
    Imf::FrameBuffer buffer;
    buffer.insert(channel, Imf::Slice::Make(type, out.data(), w.min, width, height));
    input.setFrameBuffer(buffer);
    input.readPixels(w.min.y, w.max.y);
    return out;
}

}  // namespace osio::test
