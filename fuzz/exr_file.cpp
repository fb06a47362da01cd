// SPDX-License-Identifier: Apache-2.0
//
// Any bytes as a file: refused, or every row of every part decoded or refused, of coefficients also the bands that they
// stand for.
#include <formats/exr/exr_file.h>
#include <formats/exr/soundness.h>
#include <formats/image/scene_basis.h>

#include <fuzz/temporary_file.h>

namespace {

class OneWorker final : public osio::Runner {
  public:
    [[nodiscard]] unsigned worker_count() const override { return 1; }

    void run(const std::function<void(unsigned worker)>& body) override { body(0); }
};

/// Blocks beyond this many are left out: a small file may claim many empty ones.
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 22;

bool is_small(const osio::image::Part& part) {
    const auto pixels = static_cast<std::uint64_t>(part.data_window.width()) *
                        static_cast<std::uint64_t>(part.data_window.height());
    return pixels * part.channels.size() <= kMostBytes;
}

void expand(const std::shared_ptr<const osio::image::SpectralImage>& file) {
    const auto expanded = osio::image::expand_scene_basis(file);
    if (!expanded || *expanded == file || !is_small((*expanded)->parts()[0]))
        return;
    osio::image::PlaneChannels planes;
    for (std::size_t channel = 0; channel < (*expanded)->parts()[0].channels.size(); ++channel)
        planes.emplace_back(channel);
    const auto source = (*expanded)->make_block_source(0, planes, osio::image::Grain::Block);
    if (!source)
        return;
    const auto reader = (*source)->start_reader();
    for (std::size_t block = 0; reader && block < (*source)->block_count(); ++block)
        if (const auto read = (*reader)->read(block))
            osio::fuzz::require(read->planes.size() == planes.size());
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
    const osio::fuzz::TemporaryFile temporary(bytes, count);
    const auto file = osio::exr::ExrFile::open(temporary.path());
    if (!file)
        return 0;
    OneWorker runner;
    for (std::size_t index = 0; index < (*file)->parts().size(); ++index) {
        const osio::image::Part& part = (*file)->parts()[index];
        if (!is_small(part))
            continue;
        const auto result = osio::exr::examine_part(*file, index, runner, {});
        if (result)
            osio::fuzz::require(osio::exr::row_count(result->bad) <=
                                static_cast<std::size_t>(part.data_window.height()));
    }
    expand(*file);
    return 0;
}
