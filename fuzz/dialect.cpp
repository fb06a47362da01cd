// SPDX-License-Identifier: Apache-2.0
//
// Lines of channel names, then behind a line "--" attributes NAME=TEXT, then behind another what a user says of the
// wavelengths. Whatever they are, every channel appears once and written names are distinct, or the words are refused.
#include <osio/base/text.h>
#include <osio/layout/part_layout.h>
#include <osio/layout/presentation.h>

#include <algorithm>
#include <fuzz/target.h>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace {

struct Input {
    std::vector<std::string> names;
    osio::HeaderAttributes header;
    std::string map;
};

Input input_of(std::string_view text) {
    constexpr std::size_t kMostNames = 64;
    Input out;
    int section = 0;
    for (const std::string_view line : osio::split(text, '\n')) {
        if (line == "--") {
            ++section;
        } else if (section == 0) {
            const bool known = std::find(out.names.begin(), out.names.end(), line) != out.names.end();
            if (!known && out.names.size() < kMostNames)
                out.names.emplace_back(line);
        } else if (section == 1) {
            const auto equals = std::min(line.find('='), line.size());
            const std::string value(line.substr(std::min(equals + 1, line.size())));
            out.header.texts.emplace(line.substr(0, equals), value);
            out.header.numbers.emplace(line.substr(0, equals), value);
        } else {
            out.map += std::string(line) + "\n";
        }
    }
    return out;
}

void check(const osio::PartLayout& part, std::size_t channels) {
    using osio::fuzz::require;
    const auto written = osio::written_names(part.layout);
    require(written.size() == channels);
    require(std::set<std::string>(written.begin(), written.end()).size() == channels);
    require(osio::present_channels(part.layout, osio::BandNames::CommaFree).size() == channels);
    for (const osio::SpectralSet& set : part.layout.sets)
        for (const osio::Band& band : set.bands)
            require(band.wavelength_nm > 0);
    require(osio::read_spectral_metadata(part.layout, part.attributes).bin_edges_nm.size() != 1);
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
    const Input input = input_of({reinterpret_cast<const char*>(bytes), count});
    const auto part = osio::read_part_layout(input.names, input.header, {});
    osio::fuzz::require(part.has_value());
    check(*part, input.names.size());
    for (auto map :
         {osio::parse_band_steps(osio::trim(input.map)), osio::parse_band_table(input.map, "map")}) {
        if (!map)
            continue;
        const auto mapped =
            osio::read_part_layout(input.names, input.header, {std::move(*map), std::nullopt});
        if (mapped)
            check(*mapped, input.names.size());
    }
    return 0;
}
