// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/files/temporary_folder.h>
#include <formats/trade/choice.h>

namespace osio::trade {

/// Adds the image as osiotool reduce makes it, for some tolerances: of reflectances under the job's light and those that
/// many a scene is seen under, of radiance for the job's observer. The files lie in the folder. An image that cannot
/// be reduced so (fluorescent, a light of the user's filters, ...) gets none; the errors of reading and writing.
[[nodiscard]] Result<void> add_reduced_choices(const image::CollapseJob& job,
                                               const files::TemporaryFolder& folder,
                                               const TextLoader& load_text, Runner& runner,
                                               const Progress& progress, Choices& choices);

}  // namespace osio::trade
