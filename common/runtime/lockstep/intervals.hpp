// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace rodeira::lockstep {

// Lengths of time, counted: any number of them in a fixed place. Eight classes an octave, so that a quantile is the
// upper end of its class, at most an eighth too long; below 8 ns exact.
class Intervals {
 public:
  // Negative lengths count as 0.
  void Add(std::int64_t length_ns) {
    ++counts_[ClassOf(static_cast<std::uint64_t>(std::max<std::int64_t>(length_ns, 0)))];
    ++all_;
  }
  std::uint64_t count() const { return all_; }
  // The shortest length that at least this share (0 to 1) of all does not exceed; 0 where there is none.
  std::int64_t Quantile(double share) const {
    if (all_ == 0) return 0;
    const double wanted = share * static_cast<double>(all_);
    std::uint64_t seen = 0;
    for (std::size_t c = 0; c < kClasses; ++c) {
      seen += counts_[c];
      if (counts_[c] > 0 && static_cast<double>(seen) >= wanted) return UpperEnd(c);
    }
    return UpperEnd(kClasses - 1);
  }

 private:
  static constexpr std::size_t kClasses = 8 * 61;  // through 2^63 ns

  static std::size_t ClassOf(std::uint64_t ns) {
    if (ns < 8) return static_cast<std::size_t>(ns);
    const auto octave = static_cast<std::size_t>(std::bit_width(ns)) - 4;  // 0 for 8 to 15
    return 8 * (octave + 1) + static_cast<std::size_t>((ns >> octave) & 7U);
  }
  static std::int64_t UpperEnd(std::size_t c) {
    if (c < 8) return static_cast<std::int64_t>(c);
    const std::size_t octave = c / 8 - 1;
    return static_cast<std::int64_t>(((8 + c % 8 + 1) << octave) - 1);
  }

  std::array<std::uint64_t, kClasses> counts_{};
  std::uint64_t all_ = 0;
};

}  // namespace rodeira::lockstep
