// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/thread_runner.h>

#include <algorithm>
#include <thread>
#include <vector>

namespace osio::tool {

ThreadRunner::ThreadRunner(unsigned threads)
    : m_count(std::max(1U, threads != 0 ? threads : std::thread::hardware_concurrency())) {}

void ThreadRunner::run(const std::function<void(unsigned worker)>& body) {
    std::vector<std::jthread> threads;
    for (unsigned worker = 1; worker < m_count; ++worker)
        threads.emplace_back([&body, worker] { body(worker); });
    body(0);
}

}  // namespace osio::tool
