// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>

namespace osio::test {

/// The largest of many errors against what is allowed. Prints "max seen / max allowed" when it goes
/// out of scope, and fails the test where the first exceeds the second or is NaN.
class Bound {
  public:
    Bound(std::string what, double allowed) : m_what(std::move(what)), m_allowed(allowed) {}

    Bound(const Bound&) = delete;
    Bound& operator=(const Bound&) = delete;

    ~Bound() {
        std::cout << m_what << ": max seen " << m_seen << " / max allowed " << m_allowed << " over "
                  << m_count << " values, at " << m_where << "\n";
        EXPECT_GT(m_count, 0U) << m_what;
        EXPECT_LE(m_seen, m_allowed) << m_what << " at " << m_where;
    }

    void see_absolute(double actual, double expected, const std::string& where) {
        see(std::abs(actual - expected), where);
    }

    void see_relative(double actual, double expected, const std::string& where) {
        see(std::abs(actual - expected) / std::abs(expected), where);
    }

  private:
    void see(double error, const std::string& where) {
        ++m_count;
        if (m_count == 1 || !(error <= m_seen)) {
            m_seen = error;
            m_where = where;
        }
    }

    std::string m_what;
    double m_allowed;
    double m_seen = 0;
    std::size_t m_count = 0;
    std::string m_where;
};

}  // namespace osio::test
