// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

namespace osio {

/// A 64-bit name for content: FNV-1a (Fowler, Noll, Vo; RFC 9923). Equal content has equal names;
/// it tells recipes and tables apart and is no defence against forgery.
class Fingerprint {
  public:
    constexpr Fingerprint& add(std::string_view bytes) {
        for (const char c : bytes)
            step(static_cast<std::uint8_t>(c));
        step(0xFF);  // ends the piece: ("ab", "c") and ("a", "bc") differ
        return *this;
    }

    constexpr Fingerprint& add(double value) {
        const auto bits = std::bit_cast<std::uint64_t>(value);
        for (int shift = 0; shift < 64; shift += 8)
            step(static_cast<std::uint8_t>(bits >> shift));
        return *this;
    }

    /// 16 hexadecimal digits.
    [[nodiscard]] std::string hex() const {
        std::string out(16, '0');
        for (std::size_t i = 0; i < 16; ++i)
            out[i] = "0123456789abcdef"[(m_state >> (60 - 4 * i)) & 0xF];
        return out;
    }

  private:
    constexpr void step(std::uint8_t byte) { m_state = (m_state ^ byte) * 0x100000001b3ULL; }

    std::uint64_t m_state = 0xcbf29ce484222325ULL;
};

}  // namespace osio
