// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace rodeira::traffic {

// Whether it is the turn of a vehicle to think of another lane: every half second, one after the other by their
// numbers.
inline bool IsItsTurn(std::int64_t time_ns, std::uint32_t id, std::int64_t step_ns) {
  constexpr std::int64_t kEvery_ns = 500'000'000, kApart_ns = 37'000'000;
  const std::int64_t now = time_ns + (id * kApart_ns) % kEvery_ns;
  return (now + step_ns) / kEvery_ns != now / kEvery_ns;
}

}  // namespace rodeira::traffic
