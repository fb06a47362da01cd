// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/colour/adaptation.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace osio {

namespace {

/// A response below this share of the largest is rounding: the matrices have four to six digits.
constexpr double kSmallestResponse = 1e-12;

constexpr Matrix3 kVonKries{{{{0.40024, 0.70760, -0.08081}, {-0.22630, 1.16532, 0.04570}, {0, 0, 0.91822}}}};
constexpr Matrix3 kBradford{
    {{{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}}};
constexpr Matrix3 kCat02{{{{0.7328, 0.4296, -0.1624}, {-0.7036, 1.6975, 0.0061}, {0.0030, 0.0136, 0.9834}}}};
constexpr Matrix3 kCat16{
    {{{0.401288, 0.650173, -0.051461}, {-0.250268, 1.204414, 0.045854}, {-0.002079, 0.048952, 0.953127}}}};

constexpr std::array<std::pair<std::string_view, Adaptation>, 6> kNames{
    {{"none", Adaptation::None},
     {"xyz-scaling", Adaptation::XyzScaling},
     {"von-kries", Adaptation::VonKries},
     {"bradford", Adaptation::Bradford},
     {"cat02", Adaptation::Cat02},
     {"cat16", Adaptation::Cat16}}};

}  // namespace

Matrix3 response_matrix(Adaptation adaptation) {
    switch (adaptation) {
    case Adaptation::VonKries: return kVonKries;
    case Adaptation::Bradford: return kBradford;
    case Adaptation::Cat02: return kCat02;
    case Adaptation::Cat16: return kCat16;
    case Adaptation::None:
    case Adaptation::XyzScaling: break;
    }
    return Matrix3::identity();
}

Result<Matrix3> adaptation_matrix(Adaptation adaptation, const Vector3& from_white, const Vector3& to_white) {
    if (adaptation == Adaptation::None || from_white == to_white)
        return Matrix3::identity();  // exactly, not to rounding
    const Matrix3 responses = response_matrix(adaptation);
    const Vector3 from = responses * from_white;
    const Vector3 to = responses * to_white;
    const double largest = std::max({std::abs(from[0]), std::abs(from[1]), std::abs(from[2])});
    Vector3 gain{};
    for (std::size_t c = 0; c < 3; ++c) {
        if (!(std::abs(from[c]) > kSmallestResponse * largest))
            return fail(ErrorCode::InvalidGrid,
                        "the white XYZ " + format_double(from_white[0]) + ", " +
                            format_double(from_white[1]) + ", " + format_double(from_white[2]) +
                            " has no response " + std::to_string(c + 1) +
                            " that adapt=" + std::string(adaptation_name(adaptation)) +
                            " could scale; use adapt=none, to=xyz, or name another white");
        gain[c] = to[c] / from[c];
    }
    return inverse(responses) * (Matrix3::diagonal(gain) * responses);
}

std::string_view adaptation_name(Adaptation adaptation) {
    for (const auto& [name, known] : kNames)
        if (known == adaptation)
            return name;
    return {};
}

Result<Adaptation> find_adaptation(std::string_view name) {
    std::vector<std::string> names;
    for (const auto& [word, adaptation] : kNames) {
        if (iequals(word, name))
            return adaptation;
        names.emplace_back(word);
    }
    return fail(ErrorCode::UnknownName,
                "no adaptation is called \"" + std::string(name) + "\"" + suggestion(name, names));
}

}  // namespace osio
