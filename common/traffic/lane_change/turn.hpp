// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace rodeira::traffic {

inline constexpr std::int64_t kLanesEvery_ns = 500'000'000;  // a vehicle thinks of another lane so often

// Whether it is a vehicle's turn in this step: once in so long, one after the other by their numbers alone.
inline bool IsItsTurn(std::int64_t time_ns, std::uint32_t id, std::int64_t step_ns,
                      std::int64_t every_ns = kLanesEvery_ns) {
  constexpr std::int64_t kApart_ns = 37'000'000;
  const std::int64_t now = time_ns + (id * kApart_ns) % every_ns;
  return (now + step_ns) / every_ns != now / every_ns;
}

}  // namespace rodeira::traffic
