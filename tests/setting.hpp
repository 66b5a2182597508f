// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdlib>

namespace rodeira {

// A number from the environment, for counts and seeds of tests.
inline std::uint64_t Setting(const char* name, std::uint64_t default_value) {
  const char* set = std::getenv(name);
  return set == nullptr ? default_value : std::strtoull(set, nullptr, 10);
}

}  // namespace rodeira
