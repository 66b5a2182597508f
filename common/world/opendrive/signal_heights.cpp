// SPDX-License-Identifier: Apache-2.0
// Lights that a file puts on or under the road, as towns of CARLA do.
#include <fmt/format.h>

#include "common/world/opendrive/checks.hpp"
#include "common/world/opendrive/read.hpp"

namespace rodeira::opendrive {
namespace {

constexpr double kLowestTop_m = 1.0;  // of a light's upper end over the road: those for bicycles end at 1.2 m or higher
constexpr double kHousing_m = 0.9;    // of three lights, where a file says no height
constexpr double kUsual_m = 2.2;      // of the lower end, as for lights of our own worlds

bool LiesOnTheRoad(const network::Signal& signal) {
  if (!signal.dynamic || !signal.type.starts_with("10000") || network::IsBoard(signal)) return false;
  const bool placed_elsewhere = !std::holds_alternative<std::monostate>(signal.seen);
  const double height_m = signal.height_m > 0.1 ? signal.height_m : kHousing_m;
  return !placed_elsewhere && signal.z_offset_m + height_m < kLowestTop_m;
}

}  // namespace

void RaiseLights(std::vector<RoadReading>& readings, Findings& findings) {
  std::size_t raised = 0;
  Finding first;
  for (RoadReading& road : readings) {
    for (network::Signal& signal : road.spec.signals) {
      if (!LiesOnTheRoad(signal)) continue;
      if (raised++ == 0) {
        first = {"rodeira.light_height",
                 fmt::format("light {} has its lower end {:.4g} m over the road", signal.id, signal.z_offset_m),
                 road.lines.road,
                 road.spec.id,
                 {},
                 signal.s_m,
                 {}};
      }
      signal.z_offset_m = kUsual_m;
    }
  }
  if (raised == 0) return;
  first.repair.kind = RepairKind::kLightRaised;
  first.repair.done = raised == 1 ? fmt::format("it is put at {} m", kUsual_m)
                                  : fmt::format("each of {} such lights is put at {} m", raised, kUsual_m);
  findings.warnings.push_back(std::move(first));
}

}  // namespace rodeira::opendrive
