// SPDX-License-Identifier: Apache-2.0
#include <formats/convert/cube_output.h>

#include <algorithm>

namespace osio::convert {

std::vector<double> widths_of(const Choice& choice) {
    std::vector<double> out;
    if (const auto& fwhm = choice.part().metadata.fwhm)
        for (const double nm : choice.set.wavelengths_nm())
            out.push_back(fwhm->held_at(nm));
    return out;
}

bool is_stated(const std::string& name, const Imf::Header& header, bool with_fwhm) {
    if (name == "pixelAspectRatio")
        return header.pixelAspectRatio() == 1;
    if (name == "screenWindowWidth")
        return header.screenWindowWidth() == 1;
    if (name == "screenWindowCenter")
        return header.screenWindowCenter() == Imath::V2f(0, 0);
    return name == attribute::kLayoutVersion || (with_fwhm && name == attribute::kFwhm);
}

void note_cube_losses(const Choice& choice, std::vector<std::string>& lost) {
    const image::Part& part = choice.part();
    const image::Window whole{0, 0, part.data_window.width() - 1, part.data_window.height() - 1};
    if (part.data_window != whole || part.display_window != whole)
        lost.emplace_back("the place of the data window in the display window");
    if (choice.set.family != Family::T && choice.set.family != Family::S0)
        lost.push_back("that the bands are the Stokes component " +
                       std::string(family_name(choice.set.family)));
    if (!choice.set.root.empty())
        lost.push_back("the name \"" + choice.set.root + "\" of the set");
    if (std::any_of(choice.channels.begin(), choice.channels.end(),
                    [&part](std::size_t c) { return part.channels[c].type == SampleType::Uint; }))
        lost.emplace_back("digits of unsigned integers beyond the 24 bits of a float");
}

void note_lost_attributes(const std::vector<std::string>& names, std::vector<std::string>& lost) {
    if (!names.empty())
        lost.push_back((names.size() > 1 ? "attributes " : "attribute ") + names_text(names));
}

}  // namespace osio::convert
