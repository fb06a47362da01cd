// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tools/osiotool/thread_runner.h>

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

/// Contenders side by side on the same threads.
namespace osio::bench {

struct Contest {
    unsigned threads = 2;
    int rounds = 7;
    int width = 1920, height = 1080;
};

[[nodiscard]] const Contest& contest();

/// [--threads 2] [--rounds 7] [--size 1920x1080]
void read_options(int argc, char** argv);

[[nodiscard]] tool::ThreadRunner threads();

/// Calls `body` with 0, 1, ... count - 1 from all threads.
void spread(std::size_t count, const std::function<void(unsigned worker, std::size_t index)>& body);

using Contender = std::pair<std::string, std::function<void()>>;

/// Medians in ms, one for each contender; every contender once in each round, after one to warm up.
[[nodiscard]] std::vector<double> medians(const std::vector<Contender>& contenders);

}  // namespace osio::bench
