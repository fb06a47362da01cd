// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/base64.h>
#include <tools/osiotool/report_trade_json.h>
#include <tools/osiotool/trade_page.h>
#include <tools/osiotool/trade_page_text.h>

#include <algorithm>

namespace osio::tool {

namespace {

Json grid_json(const image::BlockGrid& grid) {
    return {{"side", grid.side}, {"columns", grid.columns()}, {"rows", grid.rows()}};
}

Json spectra_json(const image::CollapseJob& job, const trade::PageContent& content) {
    const SpectralSet& set = job.set();
    Json out = grid_json(content.spectra_grid);
    out["set"] = set.name();
    out["pairs"] = set.reradiation.size();
    out["wavelengths_nm"] = set.wavelengths_nm();
    out["quantity"] = quantity_name(set.quantity());
    out["units"] = set.quantity() == Quantity::Radiance
                       ? Json(job.part().metadata.emissive_units.value_or(std::string(kWrittenEmissiveUnits)))
                       : Json(nullptr);
    out["factor"] = content.spectra_unit;
    out["codes"] = base64(content.spectra);
    return out;
}

/// In the order of the table.
Json views_json(const trade::Table& table, const trade::PageContent& content) {
    Json out = Json::array();
    for (const trade::Offer& offer : table.offers) {
        const auto view =
            std::find_if(content.choices.begin(), content.choices.end(),
                         [&offer](const trade::ChoiceView& one) { return one.name == offer.name; });
        out.push_back({{"picture", view->picture},
                       {"clipped", view->clipped},
                       {"factor", view->delta_e_unit},
                       {"codes", base64(view->delta_e)}});
    }
    return out;
}

/// JSON that no parser of HTML can take for markup.
std::string without_markup(const std::string& json) {
    std::string out;
    out.reserve(json.size());
    for (const char c : json)
        if (c == '<')
            out += "\\u003c";
        else
            out += c;
    return out;
}

}  // namespace

std::string trade_page(const image::CollapseJob& job, const trade::Table& table,
                       const trade::PageContent& content) {
    Json pictures = Json::array();
    for (const std::string& png : content.pictures)
        pictures.push_back("data:image/png;base64," + base64(png));
    const image::Window& window = job.part().data_window;
    Json page = grid_json(content.grid);
    page["window"] = {window.min_x, window.min_y, window.max_x, window.max_y};
    page["pictures"] = std::move(pictures);
    page["choices"] = views_json(table, content);
    page["spectra"] = spectra_json(job, content);
    Json all = trade_object(job.file->path(), table);
    all["page"] = std::move(page);
    std::string out(kTradePage);
    const std::size_t place = out.find(kTradePageData);
    return out.replace(place, kTradePageData.size(), without_markup(dump(all)));
}

}  // namespace osio::tool
