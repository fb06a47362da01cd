// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/layout/writer.h>

#include <algorithm>
#include <array>
#include <optional>

namespace osio {

namespace {

constexpr std::string_view kReference = "the layout's reference library";
constexpr std::string_view kColour = "colour-science";
constexpr std::string_view kPbrt = "pbrt-v4";
constexpr std::string_view kArt = "ART";
constexpr std::string_view kTinyExr = "tinyexr";

bool has(const WrittenPart& part, std::string_view attribute) {
    return part.attributes.find(attribute) != part.attributes.end();
}

bool has_all(const WrittenPart& part, std::initializer_list<std::string_view> attributes) {
    return std::all_of(attributes.begin(), attributes.end(),
                       [&part](std::string_view name) { return has(part, name); });
}

std::optional<std::string> text_of(const WrittenPart& part, std::string_view name) {
    const auto found = part.header.texts.find(name);
    return found == part.header.texts.end() ? std::nullopt : std::optional(found->second);
}

bool radiant(const WrittenPart& part) {
    const auto& sets = part.layout.sets;
    return std::any_of(sets.begin(), sets.end(),
                       [](const SpectralSet& set) { return set.quantity() == Quantity::Radiance; });
}

bool fluorescent(const WrittenPart& part) {
    const auto& sets = part.layout.sets;
    return std::any_of(sets.begin(), sets.end(),
                       [](const SpectralSet& set) { return !set.reradiation.empty(); });
}

bool has_preview(const WrittenPart& part) {
    return part.layout.find_channel("R") && part.layout.find_channel("G") && part.layout.find_channel("B");
}

/// "%f" of C: six digits behind the comma of every band.
bool six_digits(const ChannelLayout& layout) {
    for (const SpectralSet& set : layout.sets)
        for (const Band& band : set.bands) {
            const std::string& name = layout.channel_names[band.channel];
            const auto comma = name.rfind(',');
            if (comma == std::string::npos || name.size() != comma + 9 || !name.ends_with("nm"))
                return false;
        }
    return !layout.sets.empty();
}

/// Of files in the spectral EXR layout, in the order in which one header excludes another.
Writer layout_writer(const WrittenPart& part) {
    if (has(part, "spectral:checksum"))
        return {"OpenSpectralIO", "attribute spectral:checksum"};
    if (has_all(part, {"renderTimeSeconds", "samplesPerPixel"}))
        return {std::string(kPbrt), "attributes renderTimeSeconds and samplesPerPixel"};
    if (has_all(part, {"fileCreatedBy", "commandLine"}))
        return {std::string(kArt), "attributes fileCreatedBy \"" +
                                       text_of(part, "fileCreatedBy").value_or("").substr(0, 60) +
                                       "\" and commandLine"};
    if (has_all(part, {"X", "Y", "Z", "illuminant"}))
        return {std::string(kColour), "attributes X, Y, Z and illuminant"};
    if (has(part, "ROOT/units") || part.metadata.emissive_units == "W.m^-2.sr^-1.nm^-1")
        return {std::string(kTinyExr) + " or a program of its habits",
                has(part, "ROOT/units") ? "attribute ROOT/units" : "emissiveUnits with .nm^-1"};
    if (has_all(part, {attribute::kLayoutVersion, attribute::kExposureValue}) && six_digits(part.layout) &&
        has_preview(part))
        return {std::string(kReference), "EV, R, G, B and six digits behind every comma"};
    return {};
}

bool written_by(const Writer& writer, std::string_view program) {
    return writer.name.starts_with(program);
}

/// Attributes that are curves over wavelength: the layout's, and what colour-science saves of its preview.
bool is_curve(std::string_view name) {
    constexpr std::array<std::string_view, 6> kCurves{
        attribute::kCameraResponse, attribute::kLensTransmission, "X", "Y", "Z", "illuminant"};
    return std::find(kCurves.begin(), kCurves.end(), name) != kCurves.end() ||
           parse_channel_name(name, DecimalMark::Comma);
}

/// Curves whose last sample has no ';'.
std::vector<std::string> open_ended_curves(const WrittenPart& part) {
    std::vector<std::string> out;
    for (const auto& [name, value] : part.header.texts) {
        const std::string_view text = trim(value);
        if (is_curve(name) && !text.empty() && text.back() != ';' && text.find(':') != std::string_view::npos)
            out.push_back(name);
    }
    return out;
}

void add_quirks_of_layout(const WrittenPart& part, const Writer& writer, std::vector<Quirk>& out) {
    if (written_by(writer, kPbrt)) {
        out.push_back({"pbrt-v4 writes radiance times CIE_Y_integral, 106.856895, in every band",
                       "bands are read as stored; exposure=-6.7395 divides a collapse by it"});
        out.push_back(
            {"with a realistic camera pbrt-v4 writes exposure, J.m^-2, under the same emissiveUnits",
             "emissiveUnits are believed"});
    }
    if (const auto curves = open_ended_curves(part); !curves.empty())
        out.push_back({"\"" + curves.front() + "\"" +
                           (curves.size() > 1 ? " and " + std::to_string(curves.size() - 1) + " more" : "") +
                           " end without ';': the layout's reference library loses their last sample",
                       "every sample is read"});
    if (fluorescent(part))
        out.push_back({"the layout's reference library reads reradiation mirrored about the anti-diagonal",
                       "channels are read by their names, which are right in files that it wrote"});
    if (written_by(writer, kTinyExr) && part.metadata.handedness)
        out.push_back({"tinyexr says left handedness where nobody chose, others right",
                       "polarisationHandedness is read as it stands"});
    if (written_by(writer, kColour) && part.metadata.handedness && radiant(part))
        out.push_back({"colour-science states a handedness for every radiance, polarised or not",
                       "it is kept, and means nothing without S1, S2 and S3"});
}

}  // namespace

Writer find_writer(const WrittenPart& part) {
    for (const char* key : {"generated-by", "generatedBy"})
        if (const auto by = text_of(part, key); by && by->starts_with("Mitsuba"))
            return {by->starts_with("Mitsuba version 3") ? "Mitsuba 3" : "Mitsuba 0.x",
                    std::string(key) + " \"" + by->substr(0, 60) + "\""};
    const std::string& dialect = part.layout.dialect.name;
    if (dialect == kLayoutDialect)
        return layout_writer(part);
    constexpr std::array<std::array<std::string_view, 2>, 6> kByDialect{
        {{"Ocean channels", "Ocean"},
         {"Mitsuba 0.x bins", "Mitsuba 0.x"},
         {"Indigo buckets", "Indigo"},
         {"ISET3D bands", "ISET3D's pbrt"},
         {"GDAL bands", "GDAL"},
         {"OpenCV's numbered channels", "OpenCV"}}};
    for (const auto& [name, program] : kByDialect)
        if (dialect == name)
            return {std::string(program), "names and attributes of its dialect"};
    return {};
}

std::vector<Quirk> find_quirks(const WrittenPart& part) {
    std::vector<Quirk> out;
    const Writer writer = find_writer(part);
    if (part.layout.dialect.name == kLayoutDialect)
        add_quirks_of_layout(part, writer, out);
    if (const auto ev = part.header.numbers.find(attribute::kExposureValue);
        ev != part.header.numbers.end() && parse_double(ev->second).value_or(0) != 0)
        out.push_back({"EV is " + ev->second +
                           ", the exposure of R, G, B: the layout's reference library stores them times "
                           "2^EV, colour-science divided by it",
                       "EV is not applied; bands have none"});
    if (part.half_bands)
        out.push_back(
            {"bands are halves: the largest is 65504, and writers make brighter samples 65504 or infinite",
             "they are read as stored; what is infinite is counted"});
    if (part.scale != 1)
        out.push_back(
            {"numbers are per metre of wavelength", "they are read times " + format_double(part.scale)});
    if (part.layout.find_channel(""))
        out.push_back(
            {"a channel without a name, as ART's writer leaves one behind", "it is kept and is no band"});
    return out;
}

std::vector<std::string> find_assumptions(const WrittenPart& part) {
    std::vector<std::string> out;
    if (part.layout.sets.empty())
        return out;
    if (radiant(part) && part.metadata.emissive_units)
        out.push_back("radiance in " + *part.metadata.emissive_units +
                      " is per nm of wavelength, as every known writer means it");
    if (has_preview(part))
        out.emplace_back("R, G, B are a preview; no number of a collapse comes from them");
    const bool alpha = std::any_of(part.layout.sets.begin(), part.layout.sets.end(),
                                   [&part](const SpectralSet& set) { return part.layout.alpha_of(set); });
    if (alpha)
        out.emplace_back("bands are multiplied by alpha, as OpenEXR's channels are");
    return out;
}

}  // namespace osio
