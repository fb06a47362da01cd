// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/collapse_job.h>

#include <osio/base/matrix3.h>
#include <osio/collapse/weights.h>

#include <cstddef>
#include <string>
#include <vector>

/// The choices that a user has on one image, each really made: what it costs and what it is worth.
namespace osio::trade {

/// What a choice reads.
enum class Input {
    Image,         ///< the file itself
    HalfImage,     ///< the file converted to half bands
    ColourImage,   ///< X, Y, Z of the file under CIE D65, as a pipeline without spectra has them
    ReducedImage,  ///< a file with fewer bands, made of the image for some lights
};

/// What sums the bands.
enum class Level {
    Reference,  ///< the obvious double loop
    Exact,      ///< the product's vectors: the same bits
};

/// One way from the image to R, G, B of the job's space. Every one is linear in the image's channels, or in those of a
/// reduced image.
struct Choice {
    std::string name = {};
    std::string meaning = {};   ///< in words, for people
    WeightMatrix weights = {};  ///< 3 x planes of the image, see Choices; of a reduced image x its own
    Input input = Input::Image;
    Matrix3 from_input = {};  ///< of a colour image: what its X, Y, Z are multiplied by
    Level level = Level::Exact;
    bool half_output = false;
    int row_step = 1;                       ///< only every so many rows, each shown as often
    std::size_t bands = 0;                  ///< that have weight
    std::string path = {};                  ///< of a reduced image
    image::PlaneChannels file_planes = {};  ///< of its only part
};

/// The choices and what they have in common.
struct Choices {
    image::PlaneChannels planes;    ///< of the part: the plan's columns, then those of a preview
    std::vector<SampleType> types;  ///< of the planes
    Matrix3 share_from_output;      ///< X, Y, Z as shares of the white's, of R, G, B
    Vector3 white{};                ///< X, Y, Z of that white, Y = 1
    std::vector<Choice> list;       ///< the first is the reference
};

/// All choices that the job's image allows: levels, bases, output and band types, its own preview, fewer rows, fewer
/// bands, a 3x3 matrix in place of the spectral light, three bands taken for R, G, B, and sums as other
/// software makes them. Usage for a space that is not linear red, green and blue or X, Y, Z.
[[nodiscard]] Result<Choices> make_choices(const image::CollapseJob& job, double white_luminance,
                                           const TextLoader& load_text);

}  // namespace osio::trade
