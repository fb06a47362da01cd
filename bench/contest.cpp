// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <bench/contest.h>
#include <chrono>
#include <cstdio>
#include <cstdlib>

namespace osio::bench {

namespace {

Contest g_contest;

}  // namespace

const Contest& contest() {
    return g_contest;
}

void read_options(int argc, char** argv) {
    for (int i = 1; i + 1 < argc; i += 2) {
        const std::string option = argv[i];
        if (option == "--threads")
            g_contest.threads = static_cast<unsigned>(std::atoi(argv[i + 1]));
        else if (option == "--rounds")
            g_contest.rounds = std::atoi(argv[i + 1]);
        else if (option == "--size")
            std::sscanf(argv[i + 1], "%dx%d", &g_contest.width, &g_contest.height);
    }
}

tool::ThreadRunner threads() {
    return tool::ThreadRunner(g_contest.threads);
}

void spread(std::size_t count, const std::function<void(unsigned worker, std::size_t index)>& body) {
    std::atomic<std::size_t> next = 0;
    threads().run([&](unsigned worker) {
        for (std::size_t i = next++; i < count; i = next++)
            body(worker, i);
    });
}

std::vector<double> medians(const std::vector<Contender>& contenders) {
    std::vector<std::vector<double>> times(contenders.size());
    for (int round = -1; round < g_contest.rounds; ++round)
        for (std::size_t i = 0; i < contenders.size(); ++i) {
            const auto start = std::chrono::steady_clock::now();
            contenders[i].second();
            const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
            if (round >= 0)
                times[i].push_back(taken.count());
        }
    std::vector<double> out;
    for (auto& series : times) {
        const auto middle = series.begin() + g_contest.rounds / 2;
        std::nth_element(series.begin(), middle, series.end());
        out.push_back(*middle);
    }
    return out;
}

}  // namespace osio::bench
