// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/text.h>
#include <osio/collapse/plan.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace osio::test {

/// A set with bands at these wavelengths, in this channel order (any order).
inline SpectralSet set_of(Family family, const std::vector<double>& wavelengths_nm) {
    std::vector<std::string> names;
    for (const double nm : wavelengths_nm)
        names.push_back(format_channel_name({"", family, nm, {}}, DecimalMark::Comma));
    return parse_channel_layout(names, DecimalMark::Comma).sets.at(0);
}

/// Every channel lies in one set or among the others, once.
inline void expect_each_channel_once(const ChannelLayout& layout) {
    std::vector<std::size_t> seen(layout.others);
    for (const SpectralSet& set : layout.sets) {
        for (const Band& band : set.bands)
            seen.push_back(band.channel);
        for (const Reradiation& pair : set.reradiation)
            seen.push_back(pair.channel);
    }
    std::sort(seen.begin(), seen.end());
    ASSERT_EQ(seen.size(), layout.channel_names.size());
    for (std::size_t channel = 0; channel < seen.size(); ++channel)
        ASSERT_EQ(seen[channel], channel);
}

inline std::vector<double> steps(double first, double step, double last) {
    std::vector<double> out;
    for (int i = 0; first + step * i <= last + step / 1000; ++i)
        out.push_back(first + step * i);
    return out;
}

/// A request from "key=value&key=value".
inline CollapseRequest request_of(const std::string& text) {
    CollapseRequest request;
    for (const auto option : split(text, '&')) {
        const auto equals = option.find('=');
        const auto result = set_option(request, option.substr(0, equals), option.substr(equals + 1));
        if (!result)
            throw std::runtime_error(result.error().text());
    }
    return request;
}

inline Result<std::string> no_files(std::string_view path) {
    return fail(ErrorCode::Io, "no file in this test", std::string(path));
}

inline Result<CollapsePlan> plan_of(const SpectralSet& set, const std::string& request) {
    return make_plan(set, request_of(request), no_files);
}

/// The plan's outputs for one pixel whose samples follow the set's channels (not the wavelengths).
inline std::vector<double> outputs_of(const CollapsePlan& plan, const std::vector<double>& samples) {
    std::vector<double> out;
    for (std::size_t row = 0; row < plan.weights.rows(); ++row) {
        double sum = 0;
        for (std::size_t column = 0; column < plan.columns.size(); ++column)
            sum += plan.weights.at(row, column) * samples.at(plan.columns[column].channel);
        out.push_back(sum);
    }
    return out;
}

}  // namespace osio::test
