// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>
#include <osio/collapse/request.h>
#include <osio/colour/illuminant.h>
#include <osio/layout/open_words.h>

#include <functional>
#include <string>
#include <string_view>

namespace osio {

/// Gives the text of a file that a request names (a light of the user's). Core opens no file itself.
using TextLoader = std::function<Result<std::string>(std::string_view path)>;

/// The light of that name, formula or table: find_illuminant(), or illuminant_from_csv() of what is
/// loaded.
[[nodiscard]] Result<Illuminant> load_illuminant(const std::string& name, const TextLoader& load_text);

/// The map of wavelengths that words mean: parse_band_steps(), or parse_band_table() of what is loaded.
[[nodiscard]] Result<BandMap> load_band_map(const std::string& words, const TextLoader& load_text);

/// What a request says of the file that it is for.
[[nodiscard]] Result<OpenWords> load_open_words(const CollapseRequest& request, const TextLoader& load_text);

}  // namespace osio
