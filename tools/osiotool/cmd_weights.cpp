// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/commands.h>
#include <tools/osiotool/host_loader.h>
#include <tools/osiotool/request_words.h>

#include <formats/exr/exr_file.h>
#include <formats/files/text_file.h>
#include <formats/image/collapse_job.h>

#include <osio/base/text.h>
#include <osio/collapse/pixel_stage.h>

#include <fmt/format.h>

#include <map>

namespace osio::tool {

namespace {

/// Something comes after the sums that a matrix cannot say.
bool goes_on(const CollapsePlan& plan) {
    return PixelStage(plan.space, plan.white).needed() || is_polarisation(plan.space.kind);
}

std::string weights_csv(const image::CollapseJob& job) {
    const CollapsePlan& plan = job.plan;
    const bool fluorescent = plan.reradiation.has_value();
    std::string out = fluorescent ? "nm,emitted_nm" : "nm";
    for (const std::string& name : plan.weighed())
        out += "," + name;
    out += "\n";
    for (std::size_t column = 0; column < plan.columns.size(); ++column) {
        const PlanColumn& of = plan.columns[column];
        out += format_double(of.wavelength_nm);
        if (fluorescent)
            out += "," + (of.emitted_nm ? format_double(*of.emitted_nm) : std::string());
        for (std::size_t row = 0; row < plan.weights.rows(); ++row)
            out += "," + format_double(plan.weights.at(row, column));
        out += "\n";
    }
    return out;
}

/// A word of a command for a shell.
std::string quoted(const std::string& word) {
    std::string out = "'";
    for (const char c : word)
        out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

/// oiiotool's sums: --chsum leaves one channel of all, in float, and each is put beside the others.
Result<std::string> oiiotool_command(const image::CollapseJob& job, const std::string& output) {
    const CollapsePlan& plan = job.plan;
    if (goes_on(plan))
        return fail(ErrorCode::Usage,
                    "to=" + plan.space.id +
                        " is more than sums over bands, which are all that "
                        "oiiotool's --chsum has; name a linear space and convert its result");
    if (job.file->format() != "OpenEXR")
        return fail(ErrorCode::Unsupported,
                    "is " + std::string(job.file->format()) + ", which a stock oiiotool does not read",
                    job.file->path());
    if (dynamic_cast<const exr::ExrFile*>(job.file.get()) == nullptr)
        return fail(
            ErrorCode::Unsupported,
            "holds coefficients of its scene's own curves in place of bands, which a stock oiiotool does not "
            "expand; expected bands, as `osiotool convert` makes of them",
            job.file->path());
    OSIO_TRY(const host::HostModule* const module, load_host_module());
    OSIO_TRY(const auto order, module->channel_order(job.file->path(), job.part_index));
    std::map<std::string, std::size_t> columns;
    for (std::size_t column = 0; column < plan.columns.size(); ++column)
        columns[job.part().layout.channel_names[plan.columns[column].channel]] = column;
    std::string out = "oiiotool " + quoted(job.file->path());
    if (job.file->parts().size() > 1)
        out += fmt::format(" --subimage {}", job.part_index);
    const auto of_stored = [&](std::size_t row, std::size_t column) {
        return plan.weights.at(row, column) * job.part().channels[plan.columns[column].channel].scale;
    };
    std::size_t found = 0;
    for (std::size_t row = 0; row < plan.weights.rows(); ++row) {
        std::vector<std::string> weights;
        for (const std::string& name : order) {
            const auto column = columns.find(name);
            found += column != columns.end();
            weights.push_back(column == columns.end() ? "0" : format_double(of_stored(row, column->second)));
        }
        out += fmt::format(" \\\n  --dup --chsum:weight={} --swap", join(weights, ","));
    }
    if (found != plan.weights.rows() * plan.columns.size())
        return fail(ErrorCode::Unsupported, "OpenImageIO's own reader calls some of its channels otherwise",
                    job.file->path());
    out += " \\\n  --pop";
    if (plan.weights.rows() > 1)
        out += fmt::format(" --chappend:n={}", plan.weights.rows());
    return out +
           fmt::format(" --chnames {} -d float -o {}\n", join(plan.channel_names(), ","), quoted(output));
}

}  // namespace

Result<ExitCode> run_weights(const WeightsOptions& options) {
    if (!options.oiiotool && !options.output.empty())
        return fail(ErrorCode::Usage,
                    "-o is the output of the command that --oiiotool prints; the table goes to stdout");
    OSIO_TRY(const CollapseRequest request, request_of(options.request));
    OSIO_TRY(const auto job, image::open_collapse(options.input, request, files::text_loader({})));
    for (const std::string& warning : job.warnings)
        fmt::print(stderr, "warning: {}\n", warning);
    if (options.oiiotool) {
        OSIO_TRY(const std::string command,
                 oiiotool_command(job, options.output.empty() ? "out.exr" : options.output));
        fmt::print("{}", command);
        return kDone;
    }
    if (goes_on(job.plan))
        fmt::print(stderr, "note: these are the sums that {} is then made of\n", job.plan.space.id);
    fmt::print("{}", weights_csv(job));
    return kDone;
}

}  // namespace osio::tool
