// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/collapse/stream.h>

namespace osio::plugin {

/// Runs a body on the host's own thread pool, whose size the host's user sets.
class HostRunner final : public Runner {
  public:
    /// At most `threads` workers; 0: as many as the host allows. Never more than `blocks`.
    HostRunner(int threads, std::size_t blocks);

    [[nodiscard]] unsigned worker_count() const override { return m_count; }

    void run(const std::function<void(unsigned worker)>& body) override;

  private:
    unsigned m_count;
};

}  // namespace osio::plugin
