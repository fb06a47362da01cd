// SPDX-License-Identifier: Apache-2.0
//
// Decoding and collapse against OpenEXR's own decoders, libdeflate alone and the memory's bandwidth, side
// by side: every line's contenders run once in each round.
//
//     cmake --build --preset release --target read_bench
//     build/release/bench/read_bench [--threads 2] [--rounds 7] [--size 1920x1080]
#include <tools/osiotool/thread_runner.h>

#include <formats/exr/block_readers.h>
#include <formats/exr/block_source.h>
#include <formats/image/collapse_job.h>

#include <osio/collapse/collapse_stream.h>
#include <osio/collapse/kernel.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfThreading.h>
#include <OpenEXR/openexr_chunkio.h>
#include <OpenEXR/openexr_part.h>

#include <algorithm>
#include <atomic>
#include <chrono>
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
using test::must;

unsigned g_threads = 2;
int g_rounds = 7;
int g_width = 1920, g_height = 1080;

tool::ThreadRunner threads() {
    return tool::ThreadRunner(g_threads);
}

/// Calls `body` with 0, 1, ... count - 1 from all threads.
void spread(std::size_t count, const std::function<void(unsigned worker, std::size_t index)>& body) {
    std::atomic<std::size_t> next = 0;
    threads().run([&](unsigned worker) {
        for (std::size_t i = next++; i < count; i = next++)
            body(worker, i);
    });
}

using Contender = std::pair<std::string, std::function<void()>>;

/// Medians in ms, one for each contender; every contender once in each round, after one to warm up.
std::vector<double> medians(const std::vector<Contender>& contenders) {
    std::vector<std::vector<double>> times(contenders.size());
    for (int round = -1; round < g_rounds; ++round)
        for (std::size_t i = 0; i < contenders.size(); ++i) {
            const auto start = std::chrono::steady_clock::now();
            contenders[i].second();
            const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
            if (round >= 0)
                times[i].push_back(taken.count());
        }
    std::vector<double> out;
    for (auto& series : times) {
        std::nth_element(series.begin(), series.begin() + g_rounds / 2, series.end());
        out.push_back(series[static_cast<std::size_t>(g_rounds / 2)]);
    }
    return out;
}

/// Smooth spectra with 2 % of noise: what a camera or a path tracer leaves.
void write_image(const std::string& path, int bands, Imf::PixelType type, Imf::Compression compression) {
    Imf::Header header(g_width, g_height);
    header.compression() = compression;
    Imf::FrameBuffer buffer;
    const std::size_t pixels = static_cast<std::size_t>(g_width) * static_cast<std::size_t>(g_height);
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
            const float x =
                static_cast<float>(i % static_cast<std::size_t>(g_width)) / static_cast<float>(g_width);
            const float y =
                static_cast<float>(i / static_cast<std::size_t>(g_width)) / static_cast<float>(g_height);
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
    file.writePixels(g_height);
}

image::PlaneChannels every_channel(const exr::ExrPart& part) {
    image::PlaneChannels out;
    for (std::size_t c = 0; c < part.channels.size(); ++c)
        out.emplace_back(c);
    return out;
}

/// OpenEXR's C++ API with its own threads, 128 lines at a time into one block.
void decode_by_cpp_api(const std::string& path, std::vector<char>& memory) {
    constexpr int kLines = 128;
    Imf::InputFile file(path.c_str(), static_cast<int>(g_threads));
    const std::size_t plane_bytes = static_cast<std::size_t>(g_width) * kLines * 4;
    for (int first = 0; first < g_height; first += kLines) {
        Imf::FrameBuffer buffer;
        std::size_t at = 0;
        for (auto c = file.header().channels().begin(); c != file.header().channels().end(); ++c) {
            memory.resize(std::max(memory.size(), at + plane_bytes));
            at += plane_bytes;
        }
        at = 0;
        for (auto c = file.header().channels().begin(); c != file.header().channels().end(); ++c) {
            buffer.insert(c.name(), Imf::Slice::Make(c.channel().type, memory.data() + at,
                                                     Imath::V2i(0, first), g_width, kLines));
            at += plane_bytes;
        }
        file.setFrameBuffer(buffer);
        file.readPixels(first, std::min(first + kLines, g_height) - 1);
    }
}

/// OpenEXRCore's own stages, a reader and a block for each thread.
void decode_by_core(const std::string& path) {
    const auto file = must(exr::ExrFile::open(path));
    const exr::ExrPart& part = file->parts()[0];
    const exr::BlockJob job{file, 0, every_channel(part), exr::block_grid(part)};
    std::vector<std::unique_ptr<BlockReader>> readers(g_threads);
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
    for (int y = 0; y < g_height;) {
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
    std::vector<libdeflate_decompressor*> decompressors(g_threads);
    std::vector<std::vector<std::uint8_t>> memory(g_threads);
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
    must(collapse_stream(*source, targets, false, {0, g_height - 1}, runner, {}));
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

/// Reads every byte, as fast as a loop of loads can.
__attribute__((target_clones("avx512f", "avx2", "default"))) std::uint64_t read_all(const std::uint64_t* data,
                                                                                    std::size_t count) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < count; ++i)
        sum ^= data[i];
    return sum;
}

/// Planar data of 31 bands that no cache holds, in EXR's order of lines.
void bench_memory(SampleType type) {
    constexpr std::size_t kBands = 31;
    const auto width = static_cast<std::size_t>(g_width), height = static_cast<std::size_t>(g_height);
    const std::size_t run_bytes = width * sample_bytes(type), line_bytes = kBands * run_bytes;
    const std::size_t frames = type == SampleType::Half ? 2 : 1;
    std::vector<std::uint64_t> data(frames * height * line_bytes / 8);
    auto* const bytes = reinterpret_cast<std::byte*>(data.data());
    std::minstd_rand random(1);
    for (std::size_t i = 0; i < data.size() * 8 / sample_bytes(type); ++i) {
        const float value = static_cast<float>(random() % 1000) / 1000.0F;
        const std::uint16_t half = Imath::half(value).bits();
        std::memcpy(bytes + i * sample_bytes(type),
                    type == SampleType::Half ? static_cast<const void*>(&half) : &value, sample_bytes(type));
    }
    std::vector<WeightMatrix> weights{WeightMatrix(3, kBands), WeightMatrix(1, kBands),
                                      WeightMatrix(12, kBands)};
    for (auto& matrix : weights)
        for (std::size_t row = 0; row < matrix.rows(); ++row)
            for (std::size_t band = 0; band < kBands; ++band)
                matrix.at(row, band) = 0.01 * static_cast<double>(1 + row + band);
    std::vector<std::vector<float>> out(g_threads, std::vector<float>(12 * width));
    std::atomic<std::uint64_t> kept = 0;
    const auto collapse = [&](const WeightMatrix& matrix, std::size_t lines, std::size_t times) {
        spread(times * lines, [&](unsigned worker, std::size_t line) {
            std::vector<BandView> bands;
            for (std::size_t band = 0; band < kBands; ++band)
                bands.push_back({bytes + (line % lines) * line_bytes + band * run_bytes, type,
                                 static_cast<std::ptrdiff_t>(sample_bytes(type))});
            std::vector<float*> rows;
            for (std::size_t row = 0; row < matrix.rows(); ++row)
                rows.push_back(out[worker].data() + row * width);
            collapse_run(bands, matrix, width, rows);
        });
    };
    const std::size_t lines = frames * height;
    const auto ms =
        medians({{"read",
                  [&] {
                      spread(lines, [&](unsigned, std::size_t line) {
                          kept ^= read_all(data.data() + line * line_bytes / 8, line_bytes / 8);
                      });
                  }},
                 {"3 outputs", [&] { collapse(weights[0], lines, 1); }},
                 {"1 output", [&] { collapse(weights[1], lines, 1); }},
                 {"12 outputs", [&] { collapse(weights[2], lines, 1); }},
                 {"3 outputs in cache", [&] { collapse(weights[0], g_threads, lines / g_threads); }}});
    const double megabytes = static_cast<double>(data.size() * 8) / 1e6;
    const double pixels = static_cast<double>(lines * width);
    std::printf("| %s | %.1f |", std::string(sample_type_name(type)).c_str(), megabytes / ms[0]);
    for (std::size_t i = 1; i <= 4; ++i)
        std::printf(" %.0f %% |", 100 * ms[0] / ms[i]);
    std::printf(" %.2f |\n", ms[4] * 1e6 * g_threads / pixels);
}

}  // namespace

int main(int argc, char** argv) {
    for (int i = 1; i + 1 < argc; i += 2) {
        const std::string option = argv[i];
        if (option == "--threads")
            g_threads = static_cast<unsigned>(std::atoi(argv[i + 1]));
        else if (option == "--rounds")
            g_rounds = std::atoi(argv[i + 1]);
        else if (option == "--size")
            std::sscanf(argv[i + 1], "%dx%d", &g_width, &g_height);
    }
    Imf::setGlobalThreadCount(static_cast<int>(g_threads));
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "osio-read-bench";
    std::filesystem::create_directories(folder);
    std::printf("%dx%d, %u threads, medians of %d, ms\n\n", g_width, g_height, g_threads, g_rounds);
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
    std::printf("\nCollapse of 31 bands in memory, exact, against reading the same memory:\n\n"
                "| samples | read, GB/s | 3 outputs | 1 output | 12 outputs | 3, in cache | ns a pixel and "
                "thread, in cache |\n"
                "|---|---|---|---|---|---|---|\n");
    bench_memory(SampleType::Float);
    bench_memory(SampleType::Half);
    return 0;
}
