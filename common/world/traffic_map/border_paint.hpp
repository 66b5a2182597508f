// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "common/world/network/line_kinds.hpp"
#include "common/world/traffic_map/map_file.hpp"

namespace rodeira::traffic_map {

// How a border is painted, in the picture and in OpenDRIVE alike: as a world file's lines of the same name.
constexpr const network::LineKind& PaintOf(BorderType type) {
  constexpr std::array<const char*, kBorderTypes> kNames = {
      "none", "boundary", "single", "dashed", "dashed_same", "dashed_speed_ctrl", "dashed_warn", "double_dashed"};
  return network::LineKindByName(kNames[static_cast<std::size_t>(type)]);
}

// The middle of a line across a lane lies so far before its sign or light, or the lane's end.
inline constexpr double kLineBefore_m = 0.3;

}  // namespace rodeira::traffic_map
