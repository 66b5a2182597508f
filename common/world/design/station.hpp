// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "common/core/config/declared.hpp"

namespace rodeira::design {

// A station by its declared key, which begins at 0 and here ends at the road's length.
inline double Station(const config::DeclaredMap& map, std::string_view key, double length_m) {
  return map.MapWith(key).Number(key, {0.0, length_m});
}
// The same of a key that may be absent.
inline double Station(const config::DeclaredMap& map, std::string_view key, double length_m, double default_value) {
  return map.MapWith(key).Number(key, {0.0, length_m}, default_value);
}

}  // namespace rodeira::design
