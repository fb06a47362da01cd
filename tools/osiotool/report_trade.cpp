// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/report_trade.h>
#include <tools/osiotool/text_table.h>

#include <fmt/format.h>

#include <algorithm>

namespace osio::tool {

namespace {

constexpr double kMega = 1e6;

/// Three digits, or none where there is nothing.
std::string delta_text(double delta) {
    return delta == 0 ? "0" : delta < 0.0005 ? fmt::format("{:.0e}", delta) : fmt::format("{:.3f}", delta);
}

}  // namespace

std::string time_against_exact(const trade::Table& table, const trade::Offer& offer) {
    const auto exact = std::find_if(table.offers.begin(), table.offers.end(),
                                    [](const trade::Offer& other) { return other.name == "exact"; });
    if (exact == table.offers.end() || (offer.name != "exact" && offer.cost.all.same_as(exact->cost.all)))
        return "same";
    return fmt::format("{:.2f}", offer.cost.all.median / exact->cost.all.median);
}

std::string trade_text(const std::string& input, const trade::Table& table) {
    using Align = TextTable::Align;
    TextTable columns({{""},
                       {"choice"},
                       {"bands", Align::Right},
                       {"seconds", Align::Right},
                       {"min-max", Align::Right},
                       {"predicted", Align::Right},
                       {"of exact", Align::Right},
                       {"decode", Align::Right},
                       {"collapse", Align::Right},
                       {"write", Align::Right},
                       {"MB read", Align::Right},
                       {"MB out", Align::Right},
                       {"peak MB", Align::Right},
                       {"dE mean", Align::Right},
                       {"95 %", Align::Right},
                       {"99.9 %", Align::Right},
                       {"max", Align::Right},
                       {"XYZ", Align::Right}});
    for (const trade::Offer& offer : table.offers) {
        const trade::Cost& cost = offer.cost;
        const trade::Worth& worth = offer.worth;
        columns.add({offer.on_front ? "*" : "", offer.name, std::to_string(offer.bands),
                     fmt::format("{:.3f}", cost.all.median),
                     fmt::format("{:.3f}-{:.3f}", cost.all.fastest, cost.all.slowest),
                     fmt::format("{:.3f}", cost.forecast.times.total()), time_against_exact(table, offer),
                     fmt::format("{:.3f}", cost.middle.decode), fmt::format("{:.3f}", cost.middle.collapse),
                     fmt::format("{:.3f}", cost.middle.write),
                     fmt::format("{:.1f}", static_cast<double>(cost.bytes_read) / kMega),
                     fmt::format("{:.1f}", static_cast<double>(cost.bytes_written) / kMega),
                     fmt::format("{:.0f}", cost.peak_mb), delta_text(worth.delta_e_mean),
                     delta_text(worth.delta_e_95), delta_text(worth.delta_e_99_9),
                     delta_text(worth.delta_e_max), fmt::format("{:.1e}", worth.largest_xyz)});
    }
    std::string out = fmt::format("{}: {}\n", input, table.recipe);
    out += fmt::format(
        "white: Y = {:.6g}, {}; median of {} runs on {} workers; * on the Pareto front of seconds and "
        "largest CIEDE2000\n",
        table.white_luminance, table.white_reason, table.runs, table.workers);
    out += columns.text();
    const std::uint64_t undefined = table.offers.front().worth.undefined_pixels;
    if (undefined > 0)
        out += fmt::format("note: {} pixels have no colour (NaN or infinite) and enter no difference\n",
                           undefined);
    for (const trade::Offer& offer : table.offers)
        out += fmt::format("{}: {}\n", offer.name, offer.meaning);
    return out;
}

std::string trade_csv(const trade::Table& table) {
    std::string out = "choice,bands,seconds,fastest,slowest,predicted,decode,collapse,write,bytes_read,bytes_"
                      "written,peak_mb,"
                      "delta_e_mean,delta_e_95,delta_e_99_9,delta_e_max,largest_xyz,front\n";
    for (const trade::Offer& offer : table.offers) {
        const trade::Cost& cost = offer.cost;
        const trade::Worth& worth = offer.worth;
        out += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", offer.name, offer.bands,
                           cost.all.median, cost.all.fastest, cost.all.slowest, cost.forecast.times.total(),
                           cost.middle.decode, cost.middle.collapse, cost.middle.write, cost.bytes_read,
                           cost.bytes_written, cost.peak_mb, worth.delta_e_mean, worth.delta_e_95,
                           worth.delta_e_99_9, worth.delta_e_max, worth.largest_xyz, offer.on_front ? 1 : 0);
    }
    return out;
}

}  // namespace osio::tool
