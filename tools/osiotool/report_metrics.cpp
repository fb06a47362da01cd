// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/report.h>

#include <fmt/format.h>

namespace osio::tool {

std::string difference_text(const DifferenceOutcome& outcome) {
    const ValueStatistics& delta = outcome.counts.delta_e;
    std::string out = fmt::format("a            {}: {}\n", outcome.a.file->path(), outcome.a.meaning) +
                      fmt::format("b            {}: {}\n", outcome.b.file->path(), outcome.b.meaning) +
                      fmt::format("CIEDE2000    mean {:.4f}, 95 % {:.4f}, 99 % {:.4f}, max {:.4f} at {},{}\n",
                                  delta.mean(), delta.percentile(95), delta.percentile(99), delta.maximum(),
                                  outcome.counts.largest_at[0], outcome.counts.largest_at[1]) +
                      fmt::format("pixels       {}\n", delta.count() + delta.undefined_count());
    if (delta.undefined_count() > 0)
        out += fmt::format("undefined    {} (NaN or infinite colour)\n", delta.undefined_count());
    if (!outcome.verdict.empty())
        out += outcome.verdict + "\n";
    return out;
}

std::string photometry_text(const PhotometryOutcome& outcome) {
    const ValueStatistics& l = outcome.luminance;
    std::string out =
        fmt::format("{}: set {}, {} pixels\n", outcome.input, outcome.set, l.count() + l.undefined_count());
    out += fmt::format("luminance    mean {:.6g}, min {:.6g}, max {:.6g} cd/m2\n", l.mean(), l.minimum(),
                       l.maximum());
    out +=
        fmt::format("percentiles  1 % {:.5g}, 5 % {:.5g}, 50 % {:.5g}, 95 % {:.5g}, 99 % {:.5g}\n",
                    l.percentile(1), l.percentile(5), l.percentile(50), l.percentile(95), l.percentile(99));
    out += fmt::format("scotopic     mean {:.6g} scotopic cd/m2", outcome.scotopic_mean);
    if (l.mean() != 0)
        out += fmt::format(", S/P {:.5g}", outcome.scotopic_mean / l.mean());
    out += fmt::format("\nradiance     mean {:.6g} W/(sr m2) over 360-830 nm", outcome.radiance_mean);
    if (outcome.radiance_mean != 0)
        out += fmt::format(", efficacy {:.5g} lm/W", l.mean() / outcome.radiance_mean);
    out += "\n";
    if (l.undefined_count() > 0)
        out += fmt::format("undefined    {} pixels (NaN or infinite)\n", l.undefined_count());
    return out;
}

std::string light_text(const LightOutcome& outcome) {
    std::string out = fmt::format("{}: {}\n", outcome.light.id, outcome.light.source);
    out +=
        fmt::format("efficacy     {:.4f} lm/W of radiation over 360-830 nm\n", outcome.photometry.efficacy());
    out += fmt::format("scotopic     {:.4f} scotopic lm/W, S/P {:.5f}\n",
                       outcome.photometry.scotopic_efficacy(), outcome.photometry.sp_ratio());
    out += fmt::format("white        x {:.6f}, y {:.6f}\n", outcome.xy.x, outcome.xy.y);
    out += outcome.temperature ? fmt::format("temperature  {:.1f} K, Duv {:.5f}\n",
                                             outcome.temperature->cct_k, outcome.temperature->duv)
                               : std::string("temperature  none: too far from the Planckian locus\n");
    return out;
}

}  // namespace osio::tool
