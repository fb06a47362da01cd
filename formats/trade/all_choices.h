// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/files/temporary_folder.h>
#include <formats/image/white_luminance.h>
#include <formats/trade/choice.h>

namespace osio::trade {

/// Every choice that one image has, and what they need while they are compared.
struct AllChoices {
    image::WhiteLuminance white;
    Choices choices;
    files::TemporaryFolder folder;  ///< the reduced images lie here
};

/// Those of make_choices() and of add_reduced_choices(). Reads the image. Their refusals.
[[nodiscard]] Result<AllChoices> make_all_choices(const image::CollapseJob& job, const TextLoader& load_text,
                                                  Runner& runner, const Progress& progress);

}  // namespace osio::trade
