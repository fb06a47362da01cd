// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/report.h>

#include <osio/base/text.h>

#include <fmt/format.h>

#include <algorithm>

namespace osio::tool {

namespace {

std::string part_line(const exr::PartSoundness& part) {
    if (!part.decoded)
        return "not decoded: it is deep (several samples a pixel), of which this reader checks the header "
               "only";
    std::string line =
        part.sound() ? "sound"
                     : fmt::format("damaged: {} rows cannot be decoded ({}); first: {}",
                                   exr::row_count(part.bad), exr::rows_text(part.bad), part.bad.front().why);
    if (!part.not_decoded.empty())
        line += "; not decoded: " + join(part.not_decoded, "; ");
    return line;
}

}  // namespace

bool FileSoundness::damaged() const {
    const auto code = failure ? std::optional(failure->code) : std::nullopt;
    return code == ErrorCode::Damaged || code == ErrorCode::NotSpectral ||
           std::any_of(parts.begin(), parts.end(),
                       [](const exr::PartSoundness& part) { return !part.sound(); });
}

std::string_view FileSoundness::checksum() const {
    if (file == nullptr)
        return "unknown";
    switch (file->chunks().checksum()) {
    case exr::ChunkMap::Sum::None: return "none";
    case exr::ChunkMap::Sum::Foreign: return "foreign";
    case exr::ChunkMap::Sum::Own: break;
    }
    return "own";
}

std::string verify_text(const FileSoundness& file) {
    std::string out = fmt::format("{}: ", file.path);
    if (file.file == nullptr)
        return out + (file.damaged() ? "damaged: " : "not examined: ") + file.failure->what + "\n";
    const std::string_view sum = file.checksum();
    out +=
        fmt::format("{} part{}, {}\n", file.file->parts().size(), file.file->parts().size() == 1 ? "" : "s",
                    sum == "own"       ? "with a checksum"
                    : sum == "foreign" ? "with a checksum of another file: other software wrote it again"
                                       : "without a checksum");
    for (std::size_t part = 0; part < file.parts.size(); ++part)
        out += fmt::format("  part {}: {}\n", part, part_line(file.parts[part]));
    if (file.failure)
        out += fmt::format("  part {}: {}\n", file.parts.size(), file.failure->what);
    return out;
}

}  // namespace osio::tool
