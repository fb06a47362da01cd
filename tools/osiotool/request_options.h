// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tools/osiotool/commands.h>

#include <osio/collapse/request.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <string>
#include <vector>

/// Options of the command line that are words of a request.
namespace osio::tool {

/// Words of a request.
using Keys = std::vector<std::string>;

[[nodiscard]] inline bool holds(const Keys& keys, const std::string& key) {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
}

/// An option for each word of a request that is wanted, so that the command line and queries never differ.
template <class Wanted>
void add_words(CLI::App& command, RequestWords& words, Wanted wanted) {
    for (const RequestOption& option : request_options()) {
        const std::string key(option.key);
        if (!wanted(key))
            continue;
        if (option.value.empty()) {
            command
                .add_flag_callback(
                    "--" + key, [&words, key] { words.emplace_back(key, "1"); }, std::string(option.help))
                ->group("Colour");
            continue;
        }
        command
            .add_option_function<std::string>(
                "--" + key, [&words, key](const std::string& value) { words.emplace_back(key, value); },
                std::string(option.help))
            ->type_name(std::string(option.value))
            ->group("Colour");
    }
}

/// All of them but some.
inline void add_request_options(CLI::App& command, RequestWords& words, const Keys& without = {}) {
    add_words(command, words, [&without](const std::string& key) { return !holds(without, key); });
}

/// The words that say what a file holds.
inline void add_open_options(CLI::App& command, RequestWords& words) {
    add_words(command, words, [](const std::string& key) { return holds({"wavelengths", "quantity"}, key); });
}

}  // namespace osio::tool
