// SPDX-License-Identifier: Apache-2.0
#include <formats/files/sequence.h>

#include <osio/base/text.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <unordered_set>

namespace osio::files {

namespace {

constexpr std::int64_t kMostFrames = 1000000;
/// More digits than this are not a frame's.
constexpr std::size_t kMostDigits = 20;

tl::unexpected<Error> no_frames(std::string_view text) {
    return fail(ErrorCode::Usage, "found frames \"" + std::string(text) +
                                      "\", expected numbers and ranges between commas, such as 1-10x2,15");
}

struct Piece {
    int first = 0, last = 0, step = 1;
    bool others = false;  ///< those that the step leaves out
};

/// A number at the start of `text`, which is advanced past it.
std::optional<int> take_int(std::string_view& text) {
    std::size_t end = !text.empty() && text[0] == '-' ? 1 : 0;
    while (end < text.size() && text[end] >= '0' && text[end] <= '9')
        ++end;
    const auto out = parse_int(text.substr(0, end));
    text.remove_prefix(end);
    return out;
}

std::optional<Piece> parse_piece(std::string_view text) {
    Piece out;
    const auto first = take_int(text);
    if (!first)
        return std::nullopt;
    out.first = out.last = *first;
    if (text.empty())
        return out;
    if (text[0] != '-')
        return std::nullopt;
    text.remove_prefix(1);
    const auto last = take_int(text);
    if (!last)
        return std::nullopt;
    out.last = *last;
    if (text.empty())
        return out;
    out.others = text[0] == 'y';
    if (text[0] != 'x' && text[0] != 'y')
        return std::nullopt;
    text.remove_prefix(1);
    const auto step = take_int(text);
    if (!step || !text.empty() || *step == 0)
        return std::nullopt;
    out.step = std::abs(*step);
    return out;
}

/// A place for a number: where it ends, and how many digits it has at least.
struct Place {
    std::size_t end = 0;
    std::size_t digits = 0;
};

std::optional<Place> place_at(std::string_view text, std::size_t at) {
    const char mark = text[at];
    std::size_t end = at + 1;
    if (mark == '#' || mark == '@') {
        while (end < text.size() && text[end] == mark)
            ++end;
        const std::size_t length = std::min(end - at, kMostDigits);
        return Place{end, mark == '#' && length == 1 ? 4 : length};
    }
    if (mark != '%')
        return std::nullopt;
    while (end < text.size() && text[end] >= '0' && text[end] <= '9')
        ++end;
    if (end == text.size() || text[end] != 'd')
        return std::nullopt;
    if (end == at + 1)
        return Place{end + 1, 0};
    const auto width = parse_int(text.substr(at + 1, end - at - 1));
    // Without a zero in front printf pads with spaces, which no file's number has.
    if (!width || *width > static_cast<int>(kMostDigits) || text[at + 1] != '0')
        return std::nullopt;
    return Place{end + 1, static_cast<std::size_t>(*width)};
}

std::string padded(int frame, std::size_t digits) {
    const std::string number = std::to_string(std::abs(std::int64_t{frame}));
    const std::string sign = frame < 0 ? "-" : "";
    const std::size_t length = sign.size() + number.size(), wanted = digits;
    return sign + std::string(wanted > length ? wanted - length : 0, '0') + number;
}

}  // namespace

Result<std::vector<int>> parse_frames(std::string_view text) {
    std::vector<int> out;
    std::unordered_set<int> seen;
    for (const std::string_view word : split(text, ',')) {
        const auto piece = parse_piece(trim(word));
        if (!piece)
            return no_frames(text);
        const std::int64_t count = std::abs(std::int64_t{piece->last} - piece->first) + 1;
        if (count > kMostFrames)
            return no_frames(text);
        const int direction = piece->last < piece->first ? -1 : 1;
        for (std::int64_t i = 0; i < count; ++i) {
            const auto frame = static_cast<int>(piece->first + direction * i);
            if ((i % piece->step == 0) != piece->others && seen.insert(frame).second)
                out.push_back(frame);
        }
        if (out.size() > static_cast<std::size_t>(kMostFrames))
            return no_frames(text);
    }
    if (out.empty())
        return no_frames(text);
    return out;
}

bool has_frame_place(std::string_view pattern) {
    for (std::size_t at = 0; at < pattern.size(); ++at)
        if (place_at(pattern, at))
            return true;
    return false;
}

std::string frame_name(std::string_view pattern, int frame) {
    std::string out;
    for (std::size_t at = 0; at < pattern.size();) {
        if (const auto place = place_at(pattern, at)) {
            out += padded(frame, place->digits);
            at = place->end;
        } else {
            out += pattern[at++];
        }
    }
    return out;
}

}  // namespace osio::files
