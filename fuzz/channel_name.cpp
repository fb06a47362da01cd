// SPDX-License-Identifier: Apache-2.0
//
// A name that is a band's is written so that it reads back as the same band.
#include <osio/layout/channel_layout.h>
#include <osio/layout/channel_name.h>

#include <fuzz/target.h>
#include <string>
#include <string_view>
#include <vector>

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
    using osio::DecimalMark;
    using osio::fuzz::require;
    const std::string_view text(reinterpret_cast<const char*>(bytes), count);
    for (const DecimalMark mark : {DecimalMark::Comma, DecimalMark::Point}) {
        const auto name = osio::parse_channel_name(text, mark);
        if (!name)
            continue;
        require(name->wavelength_nm > 0);
        require(osio::parse_channel_name(osio::format_channel_name(*name, mark), mark) == name);
    }
    const std::vector<std::string> names{std::string(text), "T.500nm", "R"};
    const auto layout = osio::parse_channel_layout(names, DecimalMark::Comma);
    require(layout.channel_names.size() == 3);
    return 0;
}
