// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/layout/channel_layout.h>
#include <osio/layout/dialect.h>
#include <osio/layout/spectral_metadata.h>

#include <set>
#include <string>
#include <vector>

/// Which program wrote a part, and what is known of that program's files.
namespace osio {

/// A part as the rules about writers see it.
struct WrittenPart {
    const ChannelLayout& layout;
    const SpectralMetadata& metadata;
    HeaderAttributes header;
    std::set<std::string, std::less<>> attributes;  ///< names of all, of whatever type
    bool half_bands = false;                        ///< some band is stored in 16 bits
    double scale = 1;                               ///< samples are read times this
};

/// A program, as far as a header tells. The name is empty where it tells nothing.
struct Writer {
    std::string name;
    std::string evidence;
};

[[nodiscard]] Writer find_writer(const WrittenPart& part);

/// Something that files of a writer have, and what is done about it here.
struct Quirk {
    std::string what;
    std::string done;
};

/// The known quirks that this part can have.
[[nodiscard]] std::vector<Quirk> find_quirks(const WrittenPart& part);

/// What is taken to be so without being stated, a sentence each: quantity, unit, preview, alpha.
[[nodiscard]] std::vector<std::string> find_assumptions(const WrittenPart& part);

}  // namespace osio
