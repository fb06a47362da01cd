// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>
#include <osio/colour/illuminant.h>

#include <functional>
#include <string>
#include <string_view>

namespace osio {

/// Gives the text of a file that a request names (a light of the user's). Core opens no file itself.
using TextLoader = std::function<Result<std::string>(std::string_view path)>;

/// The light of that name, formula or table: find_illuminant(), or illuminant_from_csv() of what is
/// loaded.
[[nodiscard]] Result<Illuminant> load_illuminant(const std::string& name, const TextLoader& load_text);

}  // namespace osio
