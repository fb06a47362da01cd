// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/frames.h>
#include <tools/osiotool/report.h>

#include <formats/files/sequence.h>

#include <osio/base/text.h>

#include <fmt/format.h>

namespace osio::tool {

namespace {

Result<void> check_places(const FrameFiles& files) {
    std::vector<std::string> names = files.inputs;
    names.push_back(files.output);
    for (const std::string& name : names)
        if (!files::has_frame_place(name))
            return fail(ErrorCode::Usage,
                        "with --frames a name needs a place for the frame's number, such as %04d or ####",
                        name);
    return {};
}

FrameFiles files_of(const FrameFiles& files, int frame, std::size_t number, std::size_t count) {
    FrameFiles out;
    for (const std::string& input : files.inputs)
        out.inputs.push_back(files::frame_name(input, frame));
    out.output = files::frame_name(files.output, frame);
    out.frame = frame;
    out.label = fmt::format("{} ({} of {})", out.output, number, count);
    return out;
}

/// "3 of 10 frames did not go well: 4, 5, 9".
void tell_failures(const std::vector<int>& failed, std::size_t count) {
    constexpr std::size_t kNamed = 12;
    std::vector<std::string> names;
    for (const int frame : failed)
        if (names.size() < kNamed)
            names.push_back(std::to_string(frame));
    fmt::print(stderr, "osiotool: {} of {} frames did not go well: {}{}\n", failed.size(), count,
               join(names, ", "), failed.size() > kNamed ? ", ..." : "");
}

}  // namespace

Result<ExitCode> run_frames(const std::string& frames, const FrameFiles& files, bool json,
                            const RunFrame& run) {
    if (frames.empty()) {
        OSIO_TRY(const FrameOutcome one, run(files));
        if (json)
            fmt::print("{}", one.json);
        return one.code;
    }
    OSIO_TRY(const std::vector<int> numbers, files::parse_frames(frames));
    OSIO_CHECK_OK(check_places(files));
    std::vector<FrameReport> reports;
    std::vector<int> failed;
    ExitCode code = kDone;
    for (std::size_t i = 0; i < numbers.size() && code != kInterrupted; ++i) {
        FrameReport report{numbers[i], kDone, {}, {}};
        ExitCode own = kDone;
        const auto outcome = run(files_of(files, numbers[i], i + 1, numbers.size()));
        if (outcome) {
            own = outcome->code;
            report.json = outcome->json;
        } else {
            own = exit_code(outcome.error().code);
            report.error = outcome.error().text();
            fmt::print(stderr, "osiotool: frame {}: {}\n", numbers[i], report.error);
        }
        if (own != kDone)
            failed.push_back(numbers[i]);
        if (code == kDone || own == kInterrupted)
            code = own;
        report.code = own;
        reports.push_back(std::move(report));
    }
    if (!failed.empty())
        tell_failures(failed, numbers.size());
    if (json)
        fmt::print("{}", frames_json(reports));
    return code;
}

}  // namespace osio::tool
