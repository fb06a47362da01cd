// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/layout/bin_dialects.h>
#include <osio/spectra/decimal_nm.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace osio {

namespace {

/// Names state edges to 0.01 nm: two roundings of one edge differ by that much.
constexpr double kSameEdgeNm = 0.011;

/// Differences of two such edges.
constexpr double kSameWidthNm = 0.02;

constexpr double kPerNmOfPerMetre = 1e-9;

struct Bin {
    double low_nm = 0;
    double high_nm = 0;
};

/// A bin's place: its layer and its channel.
using Bins = std::map<std::string, std::vector<std::pair<Bin, std::size_t>>>;

std::string_view take_number(std::string_view& text, char mark) {
    const auto digit = [](char c) { return c >= '0' && c <= '9'; };
    std::size_t end = 0;
    while (end < text.size() && digit(text[end]))
        ++end;
    if (end > 0 && end + 1 < text.size() && text[end] == mark && digit(text[end + 1])) {
        ++end;
        while (end < text.size() && digit(text[end]))
            ++end;
    }
    const std::string_view out = text.substr(0, end);
    text.remove_prefix(end);
    return out;
}

/// The whole of `395.00-405.00nm`.
std::optional<Bin> parse_bin(std::string_view text) {
    const auto low = parse_double(take_number(text, '.'));
    if (!low || !text.starts_with('-'))
        return std::nullopt;
    text.remove_prefix(1);
    const auto high = parse_double(take_number(text, '.'));
    if (!high || text != "nm" || *high <= *low || *low <= 0)
        return std::nullopt;
    return Bin{*low, *high};
}

Bins sorted_by_edge(Bins bins) {
    for (auto& [root, list] : bins)
        std::stable_sort(list.begin(), list.end(),
                         [](const auto& a, const auto& b) { return a.first.low_nm < b.first.low_nm; });
    return bins;
}

Bins find_bins(std::span<const std::string> names) {
    Bins out;
    for (std::size_t channel = 0; channel < names.size(); ++channel)
        for (std::size_t start = 0; start != std::string::npos;) {
            if (const auto bin = parse_bin(std::string_view(names[channel]).substr(start))) {
                out[names[channel].substr(0, start > 0 ? start - 1 : 0)].emplace_back(*bin, channel);
                break;
            }
            const auto dot = names[channel].find('.', start);
            start = dot == std::string::npos ? dot : dot + 1;
        }
    return sorted_by_edge(std::move(out));
}

/// The edges of bins that follow each other; nothing where some do not.
std::optional<std::vector<double>> edges_of(const std::vector<std::pair<Bin, std::size_t>>& bins) {
    std::vector<double> out{bins.front().first.low_nm};
    for (std::size_t i = 1; i < bins.size(); ++i) {
        const double below = bins[i - 1].first.high_nm, above = bins[i].first.low_nm;
        if (std::abs(below - above) > kSameEdgeNm)
            return std::nullopt;
        out.push_back(decimal_nm((below + above) / 2));
    }
    out.push_back(bins.back().first.high_nm);
    return out;
}

std::string edges_text(const std::vector<double>& edges_nm) {
    std::vector<std::string> words;
    for (const double nm : edges_nm)
        words.push_back(format_double(nm));
    return join(words, ";");
}

std::size_t count_of(const Bins& bins) {
    std::size_t out = 0;
    for (const auto& [root, list] : bins)
        out += list.size();
    return out;
}

/// Bands in the middle of the bins, and what the layout says about their edges.
void add_bins(const Bins& bins, DialectReading& out) {
    std::optional<std::vector<double>> edges;
    bool follow = true, same = true;
    for (const auto& [root, list] : bins) {
        for (const auto& [bin, channel] : list)
            out.bands[channel] =
                ChannelName{root, Family::S0, decimal_nm((bin.low_nm + bin.high_nm) / 2), std::nullopt};
        const auto own = edges_of(list);
        follow = follow && own;
        same = same && (!edges || edges == own);
        edges = own;
    }
    if (follow && same) {
        out.attributes.emplace(attribute::kBinEdges, edges_text(*edges));
        return;
    }
    out.attributes.emplace(attribute::kBasis, "bins");
    out.warnings.emplace_back(follow ? "layers have bins of their own: bins are taken to end midway between "
                                       "their middles"
                                     : "bins leave gaps or overlap: they are taken to end midway between "
                                       "their middles");
}

DialectReading reading_of(std::span<const std::string> names, const Bins& bins, std::string dialect) {
    DialectReading out;
    out.quantity = Quantity::Radiance;
    out.bands.resize(names.size());
    out.dialect.name = std::move(dialect);
    out.dialect.evidence = std::to_string(count_of(bins)) + " names such as \"" +
                           names[bins.begin()->second.front().second] + "\"";
    return out;
}

/// wavelength430_25, behind an optional "spectral."
std::optional<double> parse_bucket(std::string_view name) {
    for (const std::string_view word : {"spectral.", "wavelength"})
        if (name.starts_with(word))
            name.remove_prefix(word.size());
        else if (word == "wavelength")
            return std::nullopt;
    std::string number(take_number(name, '_'));
    std::replace(number.begin(), number.end(), '_', '.');
    const auto nm = parse_double(number);
    return name.empty() && nm && *nm > 0 ? nm : std::nullopt;
}

/// Upper edges for buckets that are sorted by their lower ones; true where they are equally wide.
bool close_buckets(std::vector<std::pair<Bin, std::size_t>>& buckets) {
    const std::size_t last = buckets.size() - 1;
    const double mean = (buckets[last].first.low_nm - buckets[0].first.low_nm) / static_cast<double>(last);
    bool equal = true;
    double width = 0;
    for (std::size_t i = 0; i < last; ++i) {
        buckets[i].first.high_nm = buckets[i + 1].first.low_nm;
        width = buckets[i].first.high_nm - buckets[i].first.low_nm;
        equal = equal && std::abs(width - mean) <= kSameWidthNm;
    }
    buckets[last].first.high_nm = decimal_nm(buckets[last].first.low_nm + (equal ? mean : width));
    return equal;
}

}  // namespace

std::optional<DialectReading> read_mitsuba_bins(std::span<const std::string> channel_names) {
    const Bins bins = find_bins(channel_names);
    if (count_of(bins) < 2)
        return std::nullopt;
    DialectReading out = reading_of(channel_names, bins, "Mitsuba 0.x bins");
    add_bins(bins, out);
    return out;
}

std::optional<DialectReading> read_indigo_buckets(std::span<const std::string> channel_names) {
    Bins bins;
    for (std::size_t channel = 0; channel < channel_names.size(); ++channel)
        if (const auto low = parse_bucket(channel_names[channel]))
            bins[{}].emplace_back(Bin{*low, 0}, channel);
    if (count_of(bins) < 2)
        return std::nullopt;
    bins = sorted_by_edge(std::move(bins));
    DialectReading out = reading_of(channel_names, bins, "Indigo buckets");
    out.scale = kPerNmOfPerMetre;
    out.attributes.emplace(attribute::kEmissiveUnits, kWrittenEmissiveUnits);
    out.warnings.emplace_back("numbers are W/(sr m3), as Indigo writes them: times 1e-9 they are "
                              "W.m^-2.sr^-1 per nm, which is what is read");
    if (!close_buckets(bins.begin()->second))
        out.warnings.emplace_back("buckets are not equally wide, as Indigo's are: the last is taken to be as "
                                  "wide as the one before it");
    add_bins(bins, out);
    return out;
}

}  // namespace osio
