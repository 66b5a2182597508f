// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/results/names.hpp"

#include <array>

namespace rodeira::traffic {

const char* NameOf(VehicleKind kind) {
  constexpr std::array<const char*, 4> kNames = {"car", "van", "lorry", "bus"};
  return kNames[static_cast<std::size_t>(kind)];
}

const char* NameOf(network::LightColour colour) {
  constexpr std::array<const char*, 4> kNames = {"red", "red-amber", "green", "amber"};
  return kNames[static_cast<std::size_t>(colour)];
}

const char* NameOf(LeaveReason reason) {
  constexpr std::array<const char*, kLeaveReasons> kNames = {"route end", "network end", "route missed", "lane end",
                                                             "removed"};
  return kNames[static_cast<std::size_t>(reason)];
}

std::string NameOfLamps(std::uint32_t bits) {
  constexpr std::array<const char*, 3> kNames = {"brake", "left", "right"};
  std::string names;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if ((bits >> i & 1u) == 0) continue;
    if (!names.empty()) names += '+';
    names += kNames[i];
  }
  return names;
}

}  // namespace rodeira::traffic
