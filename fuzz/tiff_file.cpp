// SPDX-License-Identifier: Apache-2.0
//
// Any bytes as a TIFF file: refused, or every row of every part read or refused.
#include <formats/tiff/tiff_file.h>

#include <fuzz/temporary_file.h>

namespace {

/// Parts beyond are left out: a small file may claim many empty samples.
constexpr std::uint64_t kMostSamples = std::uint64_t{1} << 22;

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
    const osio::fuzz::TemporaryFile temporary(bytes, count);
    const auto file = osio::tiff::TiffFile::open(temporary.path());
    if (!file)
        return 0;
    for (std::size_t index = 0; index < (*file)->parts().size(); ++index) {
        const osio::image::Part& part = (*file)->parts()[index];
        const auto pixels = static_cast<std::uint64_t>(part.data_window.width()) *
                            static_cast<std::uint64_t>(part.data_window.height());
        osio::fuzz::require((*file)->planes(index).size() == part.channels.size());
        if (pixels * part.channels.size() > kMostSamples)
            continue;
        osio::image::PlaneChannels planes;
        for (std::size_t channel = 0; channel < part.channels.size(); ++channel)
            planes.emplace_back(channel);
        const auto source = (*file)->make_block_source(index, std::move(planes), osio::image::Grain::Block);
        if (!source)
            continue;
        const auto reader = (*source)->start_reader();
        for (std::size_t block = 0; reader && block < (*source)->block_count(); ++block)
            if (!(*reader)->read(block))
                break;
    }
    return 0;
}
