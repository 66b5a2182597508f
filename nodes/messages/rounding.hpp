// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace rodeira::nodes {

// As an instrument would show it: rounded to 16 significant bits, 1.6e-5 of the value at most. Bits below are noise,
// which no compression finds: a recording is a fifth smaller without them.
inline float Measured(double value) {
  const auto single = static_cast<float>(value);
  if (!std::isfinite(single)) return single;
  constexpr std::uint32_t kLow = 0xFF;
  auto bits = std::bit_cast<std::uint32_t>(single);
  bits += (kLow >> 1) + ((bits >> 8) & 1U);  // to the nearest, and to even between two
  return std::bit_cast<float>(bits & ~kLow);
}

}  // namespace rodeira::nodes
