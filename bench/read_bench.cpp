// SPDX-License-Identifier: Apache-2.0
//
// Decoding and collapse against OpenEXR's own decoders and libdeflate alone.
//
//     cmake --build --preset release --target read_bench
//     build/release/bench/read_bench [--threads 2] [--rounds 7] [--size 1920x1080]
#include <formats/exr/block_readers.h>
#include <formats/exr/block_source.h>
#include <formats/image/collapse_job.h>

#include <osio/collapse/collapse_stream.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfThreading.h>
#include <OpenEXR/openexr_chunkio.h>
#include <OpenEXR/openexr_part.h>

#include <algorithm>
#include <atomic>
#include <bench/contest.h>
#include <bench/core_reader.h>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <libdeflate.h>
#include <random>
#include <string>
#include <tests/support/must.h>

namespace {

using namespace osio;
using namespace osio::bench;
using test::must;

/// Smooth spectra with 2 % of noise: what a camera or a path tracer leaves.
void write_image(const std::string& path, int bands, Imf::PixelType type, Imf::Compression compression) {
    Imf::Header header(contest().width, contest().height);
    header.compression() = compression;
    Imf::FrameBuffer buffer;
    const std::size_t pixels =
        static_cast<std::size_t>(contest().width) * static_cast<std::size_t>(contest().height);
    std::vector<std::vector<float>> floats(static_cast<std::size_t>(bands), std::vector<float>(pixels));
    std::vector<std::vector<Imath::half>> halves(static_cast<std::size_t>(bands));
    std::minstd_rand random(1);
    std::normal_distribution<float> normal(1.0F, 0.02F);
    std::vector<float> noise(65536);
    std::generate(noise.begin(), noise.end(), [&] { return normal(random); });
    for (int b = 0; b < bands; ++b) {
        const float u = static_cast<float>(b) / static_cast<float>(bands);
        auto& plane = floats[static_cast<std::size_t>(b)];
        for (std::size_t i = 0; i < pixels; ++i) {
            const float x = static_cast<float>(i % static_cast<std::size_t>(contest().width)) /
                            static_cast<float>(contest().width);
            const float y = static_cast<float>(i / static_cast<std::size_t>(contest().width)) /
                            static_cast<float>(contest().height);
            plane[i] =
                (0.45F + 0.3F * std::sin(6 * (u + x)) * std::cos(5 * (y - u))) * noise[random() % 65536];
        }
        const double nm = 380 + 400.0 * b / std::max(bands - 1, 1);
        char name[32];
        std::snprintf(name, sizeof name, "S0.%d,%03dnm", static_cast<int>(nm),
                      static_cast<int>(std::fmod(nm, 1.0) * 1000));
        header.channels().insert(name, Imf::Channel(type));
        void* data = plane.data();
        if (type == Imf::HALF) {
            halves[static_cast<std::size_t>(b)].assign(plane.begin(), plane.end());
            data = halves[static_cast<std::size_t>(b)].data();
        }
        buffer.insert(name, Imf::Slice::Make(type, data, header.dataWindow()));
    }
    Imf::OutputFile file(path.c_str(), header, Imf::globalThreadCount());
    file.setFrameBuffer(buffer);
    file.writePixels(contest().height);
}

image::PlaneChannels every_channel(const image::Part& part) {
    image::PlaneChannels out;
    for (std::size_t c = 0; c < part.channels.size(); ++c)
        out.emplace_back(c);
    return out;
}

/// OpenEXR's C++ API with its own threads, 128 lines at a time into one block.
void decode_by_cpp_api(const std::string& path, std::vector<char>& memory) {
    constexpr int kLines = 128;
    Imf::InputFile file(path.c_str(), static_cast<int>(contest().threads));
    const std::size_t plane_bytes = static_cast<std::size_t>(contest().width) * kLines * 4;
    for (int first = 0; first < contest().height; first += kLines) {
        Imf::FrameBuffer buffer;
        std::size_t at = 0;
        for (auto c = file.header().channels().begin(); c != file.header().channels().end(); ++c) {
            memory.resize(std::max(memory.size(), at + plane_bytes));
            at += plane_bytes;
        }
        at = 0;
        for (auto c = file.header().channels().begin(); c != file.header().channels().end(); ++c) {
            buffer.insert(c.name(), Imf::Slice::Make(c.channel().type, memory.data() + at,
                                                     Imath::V2i(0, first), contest().width, kLines));
            at += plane_bytes;
        }
        file.setFrameBuffer(buffer);
        file.readPixels(first, std::min(first + kLines, contest().height) - 1);
    }
}

/// OpenEXRCore's own stages, a reader and a block for each thread.
void decode_by_core(const std::string& path) {
    const auto file = must(exr::ExrFile::open(path));
    const image::Part& part = file->parts()[0];
    const exr::BlockJob job{file, 0, every_channel(part), exr::block_grid(part)};
    std::vector<std::unique_ptr<BlockReader>> readers(contest().threads);
    spread(job.grid.block_count(), [&](unsigned worker, std::size_t block) {
        auto& reader = readers[worker];
        if (!reader)
            reader = must(exr::make_core_reader(job));
        must(reader->read(block));
    });
}

struct PackedChunk {
    std::vector<std::uint8_t> bytes;
    std::size_t unpacked_bytes = 0;
};

std::vector<PackedChunk> packed_chunks(const std::string& path) {
    const auto file = must(exr::ExrFile::open(path));
    std::vector<PackedChunk> out;
    for (int y = 0; y < contest().height;) {
        exr_chunk_info_t info{};
        exr_read_scanline_chunk_info(file->context(), 0, y, &info);
        PackedChunk chunk{std::vector<std::uint8_t>(info.packed_size), info.unpacked_size};
        exr_read_chunk(file->context(), 0, &info, chunk.bytes.data());
        out.push_back(std::move(chunk));
        y += info.height;
    }
    return out;
}

void inflate(const std::vector<PackedChunk>& chunks) {
    std::vector<libdeflate_decompressor*> decompressors(contest().threads);
    std::vector<std::vector<std::uint8_t>> memory(contest().threads);
    spread(chunks.size(), [&](unsigned worker, std::size_t i) {
        if (decompressors[worker] == nullptr)
            decompressors[worker] = libdeflate_alloc_decompressor();
        memory[worker].resize(chunks[i].unpacked_bytes);
        if (chunks[i].bytes.size() != chunks[i].unpacked_bytes)
            libdeflate_zlib_decompress(decompressors[worker], chunks[i].bytes.data(), chunks[i].bytes.size(),
                                       memory[worker].data(), memory[worker].size(), nullptr);
    });
    for (auto* decompressor : decompressors)
        libdeflate_free_decompressor(decompressor);
}

class NoSink final : public RowSink {
  public:
    Result<void> write_rows(int, int, std::span<const float* const>) override { return {}; }
};

/// Plans of one file under several whites, which are as much work as several lights.
std::vector<image::CollapseJob> jobs_for(const std::string& path, const std::vector<const char*>& whites) {
    std::vector<image::CollapseJob> out;
    for (const char* white : whites) {
        CollapseRequest request;
        must(set_option(request, "to", "lin_rec709"));
        must(set_option(request, "white", white));
        out.push_back(must(image::open_collapse(path, request, [](std::string_view) -> Result<std::string> {
            return fail(ErrorCode::Io, "no file is read here");
        })));
    }
    return out;
}

void read_and_collapse(const std::string& path, const std::vector<image::CollapseJob>& jobs) {
    const auto file = must(exr::ExrFile::open(path));
    const auto source = must(exr::make_block_source(file, 0, every_channel(file->parts()[0])));
    NoSink sink;
    std::vector<CollapseTarget> targets;
    for (const image::CollapseJob& job : jobs)
        targets.push_back({job.plan, sink});
    auto runner = threads();
    must(collapse_stream(*source, targets, false, {0, contest().height - 1}, runner, {}));
}

void bench_file(const std::string& folder, const char* title, int bands, Imf::PixelType type,
                Imf::Compression compression, bool lights = false) {
    const std::string path = folder + "/image.exr";
    write_image(path, bands, type, compression);
    const auto one = jobs_for(path, {"D65"});
    const auto four = jobs_for(path, {"D65", "A", "D50", "E"});
    const bool zip = compression == Imf::ZIP_COMPRESSION || compression == Imf::ZIPS_COMPRESSION;
    const bool dwa = compression == Imf::DWAA_COMPRESSION || compression == Imf::DWAB_COMPRESSION;
    std::vector<char> memory;
    std::vector<PackedChunk> chunks;
    if (zip)
        chunks = packed_chunks(path);
    std::vector<Contender> contenders{{"C++ API", [&] { decode_by_cpp_api(path, memory); }},
                                      {"read + collapse", [&] { read_and_collapse(path, one); }}};
    const std::size_t core = contenders.size();
    if (!dwa)
        contenders.push_back({"Core", [&] { decode_by_core(path); }});
    const std::size_t inflated = contenders.size();
    if (zip)
        contenders.push_back({"inflate", [&] { inflate(chunks); }});
    const std::size_t several = contenders.size();
    if (lights)
        contenders.push_back({"four lights", [&] { read_and_collapse(path, four); }});
    const auto ms = medians(contenders);
    const double stock = dwa ? ms[0] : std::min(ms[0], ms[core]);
    std::printf("| %s | %.0f | %.0f | %s | %.0f | **%.2f** |", title,
                static_cast<double>(std::filesystem::file_size(path)) / 1e6, ms[0],
                dwa ? "-" : std::to_string(static_cast<int>(std::lround(ms[core]))).c_str(), ms[1],
                ms[1] / stock);
    if (zip)
        std::printf(" %.0f | %.2f |", ms[inflated], ms[1] / ms[inflated]);
    else
        std::printf(" - | - |");
    if (lights)
        std::printf(" %.0f | %.2f |\n", ms[several], ms[several] / ms[1]);
    else
        std::printf(" - | - |\n");
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    read_options(argc, argv);
    Imf::setGlobalThreadCount(static_cast<int>(contest().threads));
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "osio-read-bench";
    std::filesystem::create_directories(folder);
    std::printf("%dx%d, %u threads, medians of %d, ms\n\n", contest().width, contest().height,
                contest().threads, contest().rounds);
    std::printf("| file | MB | C++ API | Core | read + collapse | / stock | inflate | / inflate | 4 lights | "
                "/ 1 light |\n"
                "|---|---|---|---|---|---|---|---|---|---|\n");
    const std::string f = folder.string();
    bench_file(f, "31 half zip", 31, Imf::HALF, Imf::ZIP_COMPRESSION, true);
    bench_file(f, "31 float zip", 31, Imf::FLOAT, Imf::ZIP_COMPRESSION, true);
    bench_file(f, "81 half zip", 81, Imf::HALF, Imf::ZIP_COMPRESSION, true);
    bench_file(f, "31 half zips", 31, Imf::HALF, Imf::ZIPS_COMPRESSION);
    bench_file(f, "31 half none", 31, Imf::HALF, Imf::NO_COMPRESSION);
    bench_file(f, "31 float none", 31, Imf::FLOAT, Imf::NO_COMPRESSION);
    bench_file(f, "31 half rle", 31, Imf::HALF, Imf::RLE_COMPRESSION);
    bench_file(f, "31 half piz", 31, Imf::HALF, Imf::PIZ_COMPRESSION);
    bench_file(f, "31 half pxr24", 31, Imf::HALF, Imf::PXR24_COMPRESSION);
    bench_file(f, "31 half b44", 31, Imf::HALF, Imf::B44_COMPRESSION);
    bench_file(f, "31 half b44a", 31, Imf::HALF, Imf::B44A_COMPRESSION);
    bench_file(f, "31 half dwaa", 31, Imf::HALF, Imf::DWAA_COMPRESSION);
    bench_file(f, "31 half dwab", 31, Imf::HALF, Imf::DWAB_COMPRESSION);
    std::filesystem::remove_all(folder);
    return 0;
}
