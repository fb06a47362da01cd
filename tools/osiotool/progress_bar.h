// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>

namespace osio::tool {

/// From here on SIGINT and SIGTERM ask the work to stop instead of ending the process, so that it
/// can clean up after itself.
void catch_interrupts();

/// True once the user has asked to stop.
[[nodiscard]] bool interrupted();

/// A bar on stderr while long work runs, only where stderr is a terminal.
class ProgressBar {
  public:
    ProgressBar(std::string label, bool wanted);
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;
    ~ProgressBar();

    /// Told by the work; false asks it to stop.
    [[nodiscard]] bool operator()(double share);

  private:
    using Clock = std::chrono::steady_clock;

    std::string m_label;
    bool m_shown;
    bool m_drawn = false;
    Clock::time_point m_next;
};

}  // namespace osio::tool
