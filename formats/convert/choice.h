// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/convert/convert.h>
#include <formats/image/spectral_image.h>

#include <functional>
#include <memory>
#include <set>

namespace osio::convert {

/// What goes over: one part of an image, which of its channels, and what it says about them.
struct Choice {
    std::shared_ptr<const image::SpectralImage> image;
    std::size_t part_index = 0;
    SpectralSet set;                    ///< the chosen set, with the bands that go over
    std::vector<std::size_t> channels;  ///< of the part, in its order
    Imf::Header attributes;             ///< its windows and every attribute that is still true
    std::vector<std::string> lost;
    std::set<std::size_t> spoken_of;  ///< channels that do not go over, and that is known

    [[nodiscard]] const image::Part& part() const { return image->parts()[part_index]; }

    [[nodiscard]] image::PlaneChannels planes() const { return {channels.begin(), channels.end()}; }
};

/// The channels that go over by default: all of the part, or the bands of the set in order of wavelength.
[[nodiscard]] Choice choose(std::shared_ptr<const image::SpectralImage> image, const Selection& selection,
                            bool everything);

/// Leaves bands out, of every set, and what showed or counted them: a preview R, G, B, bin edges. Unsupported where
/// nothing of the set is left; `wanted` says in words what was.
[[nodiscard]] Result<void> leave_out(const std::function<bool(double nm)>& keep, const std::string& wanted,
                                     Choice& choice);

/// A choice of one set's bands, and no other set's.
void leave_out_other_sets(Choice& choice);

/// Says in `lost` which channels of the part do not go over and were not spoken of.
void note_lost_channels(Choice& choice);

/// The part's attributes without its structure.
[[nodiscard]] Imf::Header attributes_of(const image::Part& part);

/// Names of the picture that goes with a set, R, G, B behind its root.
[[nodiscard]] std::vector<std::string> picture_names(const std::string& root);

/// Appends the texts that are not there yet.
void add_unique(std::vector<std::string> from, std::vector<std::string>& to);

/// "R, G, B and 4 more".
[[nodiscard]] std::string names_text(const std::vector<std::string>& names);

}  // namespace osio::convert
