// SPDX-License-Identifier: Apache-2.0
//
// One answer: collapses generated files with 1 to 8 threads on every instruction set of this machine,
// and by the obvious loop, and prints the hash of the pixels that all of them gave:
//
//     one_answer        lines of FILE TARGET THREADS HASH, then: answer HASH
//
// Fails where two differ. scripts/one_answer.sh compares the answers of two compilers.
#include <tools/osiotool/thread_runner.h>

#include <formats/exr/exr_writer.h>
#include <formats/image/collapse_job.h>

#include <osio/base/fingerprint.h>
#include <osio/base/half.h>
#include <osio/collapse/collapse_stream.h>
#include <osio/collapse/kernel.h>

#include <OpenEXR/ImfHeader.h>
#include <hwy/highway.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <tests/support/must.h>
#include <unistd.h>
#include <vector>

namespace {

using namespace osio;
using test::must;

constexpr int kWidth = 97, kHeight = 61, kBands = 31;

/// Samples of all bands, as their file will hold them.
struct Picture {
    explicit Picture(bool in_half) : type(in_half ? SampleType::Half : SampleType::Float) {
        std::mt19937 random(7);
        std::uniform_real_distribution<float> sample(-0.1F, 1.1F);
        for (std::vector<float>& plane : floats)
            for (float& value : plane)
                value = sample(random);
        for (int band = 0; band < kBands; ++band)
            for (std::size_t i = 0; in_half && i < floats[0].size(); ++i) {
                auto& value = floats[static_cast<std::size_t>(band)][i];
                halves[static_cast<std::size_t>(band)][i] =
                    static_cast<std::uint16_t>(0x3000 + static_cast<int>(value * 2000));
                value = float_from_half(halves[static_cast<std::size_t>(band)][i]);
            }
    }

    void write(const std::string& path, Imf::Compression compression) const {
        std::vector<exr::OutputChannel> channels;
        std::vector<exr::ChannelRows> rows;
        const auto bytes = static_cast<std::ptrdiff_t>(sample_bytes(type));
        for (std::size_t band = 0; band < floats.size(); ++band) {
            channels.push_back({"S0." + std::to_string(400 + 10 * band) + ",0nm", type});
            const void* const data = type == SampleType::Half ? static_cast<const void*>(halves[band].data())
                                                              : floats[band].data();
            rows.push_back({static_cast<const std::byte*>(data), bytes, bytes * kWidth});
        }
        Imf::Header header(kWidth, kHeight);
        header.compression() = compression;
        const auto writer = must(exr::ExrWriter::create(path, header, channels));
        must(writer->write_rows(kHeight, rows));
        must(writer->finish());
    }

    SampleType type;
    std::vector<std::vector<float>> floats{kBands, std::vector<float>(kWidth* kHeight)};
    std::vector<std::vector<std::uint16_t>> halves{kBands, std::vector<std::uint16_t>(kWidth* kHeight)};
};

class HashSink final : public RowSink {
  public:
    [[nodiscard]] Result<void> write_rows(int, int row_count, std::span<const float* const> planes) override {
        for (int pixel = 0; pixel < row_count * kWidth; ++pixel)
            for (const float* plane : planes)
                add(plane[pixel]);
        return {};
    }

    void add(float value) { m_hash.add(static_cast<double>(value)); }

    [[nodiscard]] std::string hex() const { return m_hash.hex(); }

  private:
    Fingerprint m_hash;
};

image::CollapseJob job_for(const std::string& path) {
    CollapseRequest request;
    must(set_option(request, "to", "lin_rec709"));
    return must(image::open_collapse(path, request, [](std::string_view name) -> Result<std::string> {
        return fail(ErrorCode::Io, std::string(name));
    }));
}

std::string streamed(const image::CollapseJob& job, unsigned threads) {
    const auto source = must(job.open_source());
    HashSink sink;
    tool::ThreadRunner workers(threads);
    must(collapse_stream(*source, job.plan, false, {0, kHeight - 1}, sink, workers, {}));
    return sink.hex();
}

std::string by_reference(const image::CollapseJob& job, const Picture& picture) {
    std::vector<BandView> bands;
    for (const std::vector<float>& plane : picture.floats)
        bands.push_back({reinterpret_cast<const std::byte*>(plane.data()), SampleType::Float, sizeof(float)});
    std::vector<std::vector<float>> out(3, std::vector<float>(kWidth * kHeight));
    std::vector<float*> pointers;
    for (std::vector<float>& plane : out)
        pointers.push_back(plane.data());
    collapse_run_reference(bands, job.plan.weights, kWidth * kHeight, pointers);
    HashSink sink;
    for (std::size_t pixel = 0; pixel < out[0].size(); ++pixel)
        for (const std::vector<float>& plane : out)
            sink.add(plane[pixel]);
    return sink.hex();
}

}  // namespace

int main() {
    const std::string path =
        (std::filesystem::temp_directory_path() / ("one_answer_" + std::to_string(::getpid()) + ".exr"))
            .string();
    Fingerprint answer;
    bool one = true;
    for (const bool in_half : {true, false})
        for (const Imf::Compression compression :
             {Imf::ZIP_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::NO_COMPRESSION, Imf::PIZ_COMPRESSION}) {
            const Picture picture(in_half);
            picture.write(path, compression);
            const image::CollapseJob job = job_for(path);
            const std::string name =
                std::string(in_half ? "half" : "float") + "-" + std::to_string(static_cast<int>(compression));
            const std::string expected = by_reference(job, picture);
            std::printf("%s reference 1 %s\n", name.c_str(), expected.c_str());
            answer.add(expected);
            for (std::int64_t targets = hwy::SupportedTargets(); targets != 0; targets &= targets - 1) {
                const std::int64_t target = targets & -targets;
                if (hwy::TargetName(target) == std::string("Unknown"))  // bits that are reserved
                    continue;
                hwy::SetSupportedTargetsForTest(target);
                hwy::GetChosenTarget().Update(hwy::SupportedTargets());
                for (unsigned threads = 1; threads <= 8; ++threads) {
                    const std::string found = streamed(job, threads);
                    std::printf("%s %s %u %s\n", name.c_str(), hwy::TargetName(target), threads,
                                found.c_str());
                    one = one && found == expected;
                }
                hwy::SetSupportedTargetsForTest(0);
                hwy::GetChosenTarget().Update(hwy::SupportedTargets());
            }
        }
    std::filesystem::remove(path);
    std::printf("answer %s\n", one ? answer.hex().c_str() : "differs");
    return one ? 0 : 1;
}
