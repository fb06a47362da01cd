// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/collapse/stream.h>

namespace osio::tool {

/// Runs a body on threads of its own.
class ThreadRunner final : public Runner {
  public:
    /// `threads` 0: one for each processor.
    explicit ThreadRunner(unsigned threads);

    [[nodiscard]] unsigned worker_count() const override { return m_count; }

    void run(const std::function<void(unsigned worker)>& body) override;

  private:
    unsigned m_count;
};

}  // namespace osio::tool
