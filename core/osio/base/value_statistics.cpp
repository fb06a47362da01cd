// SPDX-License-Identifier: Apache-2.0
#include <osio/base/value_statistics.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace osio {

namespace {

constexpr int kDroppedBits = 12;
constexpr std::uint32_t kSign = 0x80000000U;

/// Larger floats have larger numbers: negative ones are turned round, positive ones lie above them.
std::uint32_t bucket_of(double value) {
    constexpr double kLargest = std::numeric_limits<float>::max();
    const auto bits =
        std::bit_cast<std::uint32_t>(static_cast<float>(std::clamp(value, -kLargest, kLargest)));
    return ((bits & kSign) != 0 ? ~bits : bits | kSign) >> kDroppedBits;
}

double middle_of(std::uint32_t bucket) {
    const std::uint32_t ordered = (bucket << kDroppedBits) | (1U << (kDroppedBits - 1));
    const auto middle =
        static_cast<double>(std::bit_cast<float>((ordered & kSign) != 0 ? ordered & ~kSign : ~ordered));
    // Of the buckets around zero, which keep no fraction worth the name, zero itself.
    return std::abs(middle) < static_cast<double>(std::numeric_limits<float>::min()) ? 0 : middle;
}

}  // namespace

ValueStatistics::ValueStatistics() : m_buckets(std::size_t{1} << (32 - kDroppedBits)) {}

void ValueStatistics::add(double value) {
    if (!std::isfinite(value)) {
        ++m_undefined;
        return;
    }
    m_minimum = m_count == 0 ? value : std::min(m_minimum, value);
    m_maximum = m_count == 0 ? value : std::max(m_maximum, value);
    m_sum += value;
    ++m_count;
    ++m_buckets[bucket_of(value)];
}

double ValueStatistics::mean() const {
    return m_count == 0 ? 0 : m_sum / static_cast<double>(m_count);
}

double ValueStatistics::percentile(double percent) const {
    const double wanted = std::max(1.0, std::ceil(percent / 100 * static_cast<double>(m_count)));
    std::uint64_t seen = 0;
    for (std::size_t bucket = 0; bucket < m_buckets.size(); ++bucket) {
        seen += m_buckets[bucket];
        if (m_buckets[bucket] > 0 && static_cast<double>(seen) >= wanted)
            return std::clamp(middle_of(static_cast<std::uint32_t>(bucket)), m_minimum, m_maximum);
    }
    return m_maximum;
}

}  // namespace osio
