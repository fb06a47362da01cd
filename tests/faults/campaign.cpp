// SPDX-License-Identifier: Apache-2.0
//
// Damages a file in many ways and counts what comes of it:
//
//     fault_campaign truncate|flip COUNT SEED FILE...
//
// For each FILE, a spectral OpenEXR scanline file of one part, COUNT damaged copies are opened, planned
// and collapsed, as osiotool collapse does, in this process. Prints one line a file:
//
//     FILE REGION COPIES REFUSED SAME SILENT
//
// for each region that was hit: header, table, chunkheader, deflated, stored (a chunk that compression
// did not shrink, and NONE), packed (all other payload), tail. Silent: no error, and colour unlike the
// undamaged file's. A silent flip in deflated bytes that unpack to other bytes of the same Adler-32
// counts as "collision": zlib's own check passes, so no reader could tell.
#include <formats/exr/chunk_geometry.h>
#include <formats/exr/header_bytes.h>
#include <formats/image/collapse_job.h>

#include <osio/collapse/collapse_stream.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <libdeflate.h>
#include <map>
#include <random>
#include <string>
#include <string_view>
#include <sys/mman.h>
#include <unistd.h>
#include <vector>

namespace {

using namespace osio;

class OneWorker final : public Runner {
  public:
    [[nodiscard]] unsigned worker_count() const override { return 1; }

    void run(const std::function<void(unsigned worker)>& body) override { body(0); }
};

class Keep final : public RowSink {
  public:
    explicit Keep(std::size_t width) : m_width(width) {}

    [[nodiscard]] Result<void> write_rows(int, int row_count, std::span<const float* const> planes) override {
        const std::size_t samples = static_cast<std::size_t>(row_count) * m_width;
        for (const float* plane : planes)
            pixels.append(reinterpret_cast<const char*>(plane), samples * sizeof(float));
        return {};
    }

    std::string pixels;

  private:
    std::size_t m_width;
};

/// The collapse of a file, with its windows and channels, as bytes.
Result<std::string> collapse(const std::string& path) {
    CollapseRequest request;
    OSIO_CHECK_OK(set_option(request, "to", "lin_rec709"));
    request.illuminant = "D65";
    const auto no_text = [](std::string_view name) -> Result<std::string> {
        return fail(ErrorCode::Io, std::string(name));
    };
    OSIO_TRY(const image::CollapseJob job, image::open_collapse(path, request, no_text));
    OSIO_TRY(const auto source, job.open_source());
    const image::Window& window = job.part().data_window;
    Keep sink(static_cast<std::size_t>(window.width()));
    OneWorker runner;
    OSIO_TRY(const CollapseCounts counts, collapse_stream(*source, job.plan, job.alpha.has_value(),
                                                          {window.min_y, window.max_y}, sink, runner, {}));
    return std::to_string(counts.pixels) + "," + std::to_string(window.min_x) + "," +
           std::to_string(window.min_y) + "," + std::to_string(window.width()) + ":" + sink.pixels;
}

/// Where a byte of a file lies.
class Regions {
  public:
    explicit Regions(const std::string& path) {
        const auto file = files::RawFile::open(path).value();
        std::string bytes, number;
        m_headers_end = exr::read_raw_headers(file, bytes).value().end;
        const auto opened = exr::ExrFile::open(path).value();
        const image::Part& part = opened->parts()[0];
        const std::uint64_t count = exr::full_resolution_chunks(part);
        const auto height = static_cast<std::uint64_t>(part.data_window.height());
        const exr::ChunkSize size = exr::chunk_size(part);
        m_table_end = m_headers_end + count * 8;
        const auto compression = part.header.compression();
        const bool deflate = compression == Imf::ZIP_COMPRESSION || compression == Imf::ZIPS_COMPRESSION ||
                             compression == Imf::PXR24_COMPRESSION;
        for (std::uint64_t i = 0; i < count; ++i) {
            if (!file.read(m_headers_end + i * 8, 8, number))
                std::abort();
            const std::uint64_t at = exr::little_endian(number, 0, 8);
            if (!file.read(at, 8, number))
                std::abort();
            const std::uint64_t bytes_stored = exr::little_endian(number, 4, 4);
            const std::uint64_t rows = std::min(size.height, height - i * size.height);
            const bool raw = bytes_stored == exr::sample_bytes_of(part, size.width, rows);
            m_chunks[at] = {at + 8 + bytes_stored, raw ? "stored" : deflate ? "deflated" : "packed"};
        }
    }

    [[nodiscard]] std::string of(std::uint64_t byte) const {
        if (byte < m_headers_end)
            return "header";
        if (byte < m_table_end)
            return "table";
        auto chunk = m_chunks.upper_bound(byte);
        if (chunk == m_chunks.begin())
            return "tail";
        --chunk;
        if (byte < chunk->first + 8)
            return "chunkheader";
        return byte < chunk->second.end ? chunk->second.kind : "tail";
    }

    /// True where the chunk that holds `byte` unpacks, without a look at its check, to bytes that have
    /// the Adler-32 that the chunk states.
    [[nodiscard]] bool adler_agrees(std::string_view file, std::uint64_t byte) const {
        const auto chunk = std::prev(m_chunks.upper_bound(byte));
        const std::string_view stream = file.substr(chunk->first + 8, chunk->second.end - chunk->first - 8);
        std::vector<char> bytes(std::size_t{1} << 20);
        std::size_t size = 0;
        libdeflate_decompressor* const inflate = libdeflate_alloc_decompressor();
        const auto outcome = libdeflate_deflate_decompress(inflate, stream.data() + 2, stream.size() - 6,
                                                           bytes.data(), bytes.size(), &size);
        libdeflate_free_decompressor(inflate);
        std::uint32_t stated = 0;
        for (const char c : stream.substr(stream.size() - 4))
            stated = stated << 8 | static_cast<unsigned char>(c);
        return outcome == LIBDEFLATE_SUCCESS && libdeflate_adler32(1, bytes.data(), size) == stated;
    }

  private:
    struct Chunk {
        std::uint64_t end = 0;
        std::string kind;
    };

    std::uint64_t m_headers_end = 0, m_table_end = 0;
    std::map<std::uint64_t, Chunk> m_chunks;
};

struct Tally {
    std::size_t copies = 0, refused = 0, same = 0, silent = 0;
};

void damage_file(const std::string& path, bool truncate, std::size_t count, std::mt19937_64& random) {
    std::ifstream in(path, std::ios::binary);
    const std::string whole((std::istreambuf_iterator<char>(in)), {});
    const auto expected = collapse(path);
    if (!expected) {
        std::fprintf(stderr, "%s\n", expected.error().text().c_str());
        std::exit(1);
    }
    const Regions regions(path);
    std::map<std::string, Tally> tallies;
    const int memory = ::memfd_create("damaged", 0);
    const std::string copy = "/proc/self/fd/" + std::to_string(memory);
    const auto store = [&](std::string_view bytes, std::uint64_t at) {
        if (::pwrite(memory, bytes.data(), bytes.size(), static_cast<off_t>(at)) !=
            static_cast<ssize_t>(bytes.size()))
            std::abort();
    };
    store(whole, 0);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint64_t byte = random() % whole.size();
        std::string damaged;
        if (truncate) {
            if (::ftruncate(memory, static_cast<off_t>(byte)) != 0)
                std::abort();
        } else {
            const char flipped = static_cast<char>(whole[byte] ^ (1 << (random() % 8)));
            store({&flipped, 1}, byte);
            damaged = whole;
            damaged[byte] = flipped;
        }
        const auto found = collapse(copy);
        const bool silent = found && *found != *expected;
        std::string region = regions.of(byte);
        if (silent && region == "deflated" && !truncate && regions.adler_agrees(damaged, byte))
            region = "collision";
        Tally& tally = tallies[region];
        ++tally.copies;
        ++(silent ? tally.silent : found ? tally.same : tally.refused);
        if (truncate)
            store(std::string_view(whole).substr(byte), byte);
        else
            store(std::string_view(whole).substr(byte, 1), byte);
    }
    ::close(memory);
    for (const auto& [region, tally] : tallies)
        std::printf("%s %s %zu %zu %zu %zu\n", path.c_str(), region.c_str(), tally.copies, tally.refused,
                    tally.same, tally.silent);
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 5)
        return 2;
    const bool truncate = std::string_view(argv[1]) == "truncate";
    const auto number = [&](int i) { return std::strtoull(argv[i], nullptr, 10); };
    for (int i = 4; i < argc; ++i) {
        std::mt19937_64 random(number(3));  // the same places in every run
        damage_file(argv[i], truncate, number(2), random);
    }
    return 0;
}
