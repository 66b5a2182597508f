// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "common/core/config/schema.hpp"

// Keys that several parts of a world file have.
namespace rodeira::design {

inline constexpr config::Range kPlace_m{-1e8, 1e8}, kHeight_m{-12'000.0, 12'000.0}, kTurn_deg{-360.0, 360.0},
    kSpeed_kmh{1.0, 400.0}, kFall{-0.2, 0.2}, kFriction{0.01, 2.0};
inline constexpr std::size_t kAnyNumber = std::numeric_limits<std::size_t>::max();

// A station that a mapping must have; its reader ends the range at the road's length.
inline config::Key StationKey(std::string name, std::string meaning) {
  return config::RequiredNumberKey(std::move(name), config::Range::NotNegative(), std::move(meaning));
}
// Where something begins along its road, m; 0 where the file does not say it.
inline config::Key FromKey() {
  return config::NumberKey("from_s_m", config::Range::NotNegative(), 0.0, "Begins here.");
}
inline config::Key ToKey() {
  return config::ComputedNumberKey("to_s_m", config::Range::NotNegative(), "end of the road", "Ends here.");
}

// A list of points over s, ascending.
inline config::Key PointsKey(std::string list, std::string value, config::Range range, std::string meaning) {
  return config::ListKey(std::move(list),
                         {config::RequiredNumberKey("s_m", {0.0, 1e8}, "Station, ascending."),
                          config::RequiredNumberKey(std::move(value), range, std::move(meaning))},
                         "Points over the station.");
}

// A number, or instead of it a list of points.
inline void AddTable(config::Key number, std::string list, std::string value, std::string meaning,
                     std::vector<config::Key>& keys) {
  config::Key points = PointsKey(std::move(list), std::move(value), number.range, std::move(meaning));
  keys.push_back(std::move(number));
  keys.push_back(config::Counted(1, kAnyNumber, std::move(points)));
}

inline config::Key MaterialKey(std::string usual) {
  return config::ComputedTextKey("material", std::move(usual), "gravel", "Material.");
}

}  // namespace rodeira::design
