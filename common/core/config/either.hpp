// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "common/core/config/config.hpp"

namespace rodeira::config {

// A problem where both keys stand in the mapping: they say the same thing in two ways. Whether they do.
inline bool RejectConflictingKeys(const Map& map, std::string_view key, std::string_view other) {
  if (!map.Has(key) || !map.Has(other)) return false;
  map.IgnoreKey(other);
  map.Problem(other, "config.conflicting_keys",
              fmt::format("'{}' and '{}' say the same in two ways; one of both was expected", key, other));
  return true;
}

}  // namespace rodeira::config
