// SPDX-License-Identifier: Apache-2.0
#include <plugins/common/host_runner.h>

#include <OpenImageIO/imageio.h>
#include <OpenImageIO/parallel.h>

#include <algorithm>
#include <thread>

namespace osio::plugin {

HostRunner::HostRunner(int threads, std::size_t blocks) {
    int allowed = threads > 0 ? threads : OIIO::get_int_attribute("threads");
    if (allowed <= 0)
        allowed = static_cast<int>(std::thread::hardware_concurrency());
    m_count = static_cast<unsigned>(std::clamp<std::size_t>(static_cast<std::size_t>(std::max(allowed, 1)), 1,
                                                            std::max<std::size_t>(blocks, 1)));
}

void HostRunner::run(const std::function<void(unsigned worker)>& body) {
    if (m_count == 1)
        return body(0);
    const auto run_one = [&body](std::int64_t begin, std::int64_t end) {
        for (std::int64_t worker = begin; worker < end; ++worker)
            body(static_cast<unsigned>(worker));
    };
    OIIO::parallel_for_chunked(0, m_count, 1, run_one, OIIO::paropt(static_cast<int>(m_count)));
}

}  // namespace osio::plugin
