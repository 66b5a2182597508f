// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <initializer_list>

namespace rodeira::base {

// Counter-based random numbers: a pure function of its keys, so that neither order nor threads change a draw.
// The mix is SplitMix64's finaliser (Steele, Lea, Flood, OOPSLA 2014), applied once a key.
inline std::uint64_t RandomBits(std::initializer_list<std::uint64_t> keys) {
  std::uint64_t z = 0x9E3779B97F4A7C15ull;
  for (const std::uint64_t key : keys) {
    z = (z ^ key) + 0x9E3779B97F4A7C15ull;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    z ^= z >> 31;
  }
  return z;
}

// Uniform in [0, 1), 53 bits. Keys by convention: seed, who, purpose, step.
inline double RandomUniform(std::initializer_list<std::uint64_t> keys) {
  return static_cast<double>(RandomBits(keys) >> 11) * 0x1.0p-53;
}

inline double RandomUniform(std::initializer_list<std::uint64_t> keys, double low, double high) {
  return low + (high - low) * RandomUniform(keys);
}

}  // namespace rodeira::base
