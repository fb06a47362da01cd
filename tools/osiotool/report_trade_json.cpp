// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/report_trade.h>
#include <tools/osiotool/report_trade_json.h>

namespace osio::tool {

Json trade_object(const std::string& input, const trade::Table& table) {
    Json choices = Json::array();
    for (const trade::Offer& offer : table.offers) {
        const trade::Cost& cost = offer.cost;
        const trade::Worth& worth = offer.worth;
        choices.push_back({{"choice", offer.name},
                           {"meaning", offer.meaning},
                           {"bands", offer.bands},
                           {"seconds", cost.all.median},
                           {"fastest", cost.all.fastest},
                           {"slowest", cost.all.slowest},
                           {"predicted", cost.forecast.times.total()},
                           {"predicted_from_rows", cost.forecast.rows_run},
                           {"against_exact", time_against_exact(table, offer)},
                           {"decode", cost.middle.decode},
                           {"collapse", cost.middle.collapse},
                           {"write", cost.middle.write},
                           {"bytes_read", cost.bytes_read},
                           {"bytes_written", cost.bytes_written},
                           {"peak_mb", cost.peak_mb},
                           {"undefined_pixels", worth.undefined_pixels},
                           {"delta_e_mean", worth.delta_e_mean},
                           {"delta_e_95", worth.delta_e_95},
                           {"delta_e_99_9", worth.delta_e_99_9},
                           {"delta_e_max", worth.delta_e_max},
                           {"largest_xyz", worth.largest_xyz},
                           {"front", offer.on_front}});
    }
    return {{"input", input},
            {"recipe", table.recipe},
            {"white_luminance", table.white_luminance},
            {"white_luminance_from", table.white_reason},
            {"runs", table.runs},
            {"workers", table.workers},
            {"choices", std::move(choices)}};
}

std::string trade_json(const std::string& input, const trade::Table& table) {
    return dump(trade_object(input, table));
}

}  // namespace osio::tool
