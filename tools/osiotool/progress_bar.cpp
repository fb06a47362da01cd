// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/progress_bar.h>

#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <unistd.h>

namespace osio::tool {

namespace {

volatile std::sig_atomic_t g_interrupted = 0;

void note_interrupt(int) {
    g_interrupted = 1;
}

/// Work shorter than this needs no bar; a drawn bar is refreshed this often.
constexpr auto kPatience = std::chrono::milliseconds(300);
constexpr auto kRefresh = std::chrono::milliseconds(100);
constexpr int kWidth = 30;

}  // namespace

void catch_interrupts() {
    struct sigaction action {};

    action.sa_handler = note_interrupt;
    ::sigemptyset(&action.sa_mask);
    ::sigaction(SIGINT, &action, nullptr);
    ::sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() {
    return g_interrupted != 0;
}

ProgressBar::ProgressBar(std::string label, bool wanted)
    : m_label(std::move(label)), m_shown(wanted && ::isatty(STDERR_FILENO) == 1),
      m_next(Clock::now() + kPatience) {}

ProgressBar::~ProgressBar() {
    if (m_drawn)
        fmt::print(stderr, "\r\033[K");
}

bool ProgressBar::operator()(double share) {
    if (m_shown && Clock::now() >= m_next) {
        const int filled = static_cast<int>(share * kWidth);
        fmt::print(stderr, "\r{} [{:#<{}}{:.<{}}] {:3.0f} %", m_label, "", filled, "", kWidth - filled,
                   100 * share);
        std::fflush(stderr);
        m_drawn = true;
        m_next = Clock::now() + kRefresh;
    }
    return !interrupted();
}

}  // namespace osio::tool
