// SPDX-License-Identifier: Apache-2.0
#include <formats/trade/all_choices.h>
#include <formats/trade/reduced_choices.h>

namespace osio::trade {

Result<AllChoices> make_all_choices(const image::CollapseJob& job, const TextLoader& load_text,
                                    Runner& runner, const Progress& progress) {
    OSIO_TRY(image::WhiteLuminance white, image::white_luminance_of(job, load_text, runner, {}));
    OSIO_TRY(Choices choices, make_choices(job, white.y, load_text));
    OSIO_TRY(files::TemporaryFolder folder, files::TemporaryFolder::create("trade"));
    OSIO_CHECK_OK(add_reduced_choices(job, folder, load_text, runner, progress, choices));
    return AllChoices{std::move(white), std::move(choices), std::move(folder)};
}

}  // namespace osio::trade
