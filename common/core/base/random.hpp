// SPDX-License-Identifier: Apache-2.0
#pragma once

/// @file
/// Random numbers that depend on their keys only.

#include <cstdint>
#include <initializer_list>

namespace rodeira::base {

/// Counter-based random bits: a pure function of the keys, so neither order nor threads change a number.
/// The mix is the finaliser of SplitMix64 (Steele, Lea, Flood, OOPSLA 2014), applied once per key.
/// @param keys keys in a fixed order; by convention seed, index of the node or object, purpose, step
/// @return 64 random bits
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

/// Uniformly distributed random number with 53 random bits.
/// @param keys keys as in RandomBits
/// @return number in [0, 1)
inline double RandomUniform(std::initializer_list<std::uint64_t> keys) {
  return static_cast<double>(RandomBits(keys) >> 11) * 0x1.0p-53;
}

/// Uniformly distributed random number between two limits.
/// @param keys keys as in RandomBits
/// @param low lower limit
/// @param high upper limit, in the unit of `low`
/// @return number in [low, high), up to rounding
inline double RandomUniform(std::initializer_list<std::uint64_t> keys, double low, double high) {
  return low + (high - low) * RandomUniform(keys);
}

}  // namespace rodeira::base
