// SPDX-License-Identifier: Apache-2.0
//
// Any bytes as a file: refused, or every row of every part decoded or refused.
#include <formats/exr/exr_file.h>
#include <formats/exr/soundness.h>

#include <fuzz/temporary_file.h>

namespace {

class OneWorker final : public osio::Runner {
  public:
    [[nodiscard]] unsigned worker_count() const override { return 1; }

    void run(const std::function<void(unsigned worker)>& body) override { body(0); }
};

/// Blocks beyond this many are left out: a small file may claim many empty ones.
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 22;

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
    const osio::fuzz::TemporaryFile temporary(bytes, count);
    const auto file = osio::exr::ExrFile::open(temporary.path());
    if (!file)
        return 0;
    OneWorker runner;
    for (std::size_t index = 0; index < (*file)->parts().size(); ++index) {
        const osio::image::Part& part = (*file)->parts()[index];
        const auto pixels = static_cast<std::uint64_t>(part.data_window.width()) *
                            static_cast<std::uint64_t>(part.data_window.height());
        if (pixels * part.channels.size() > kMostBytes)
            continue;
        const auto result = osio::exr::examine_part(*file, index, runner, {});
        if (result)
            osio::fuzz::require(osio::exr::row_count(result->bad) <=
                                static_cast<std::size_t>(part.data_window.height()));
    }
    return 0;
}
