// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "common/core/config/declared.hpp"
#include "common/world/design/road_reader.hpp"
#include "common/world/lights/light_plan.hpp"

namespace rodeira::design {

// What a minor road's traffic does; lights hold for all.
enum class Control { kNone, kGiveWay, kStop, kLights };

// A road that meets a junction: it passes, or it begins or ends there.
struct Meeting {
  std::size_t road = 0;  // of the designs
  double s_m = 0.0;
  bool before = true;  // the road comes to the junction from smaller stations
  bool after = true;   // and goes on to larger ones
};

// A junction as its author says it.
struct JunctionSpec {
  std::string id, name;
  std::vector<Meeting> meetings;  // the first one has priority
  Control control = Control::kGiveWay;
  double radius_m = 8.0;  // how far the corners stand back from where the roads' edges would meet
  double fit_m = 60.0;    // over which minor roads come to the height of the first one
  config::Map map;
  std::optional<lights::LightPlan> lights;  // names are roads
};

// Reads 'junctions' of a file. Roads must be built already (`roads`, beside the designs).
std::vector<JunctionSpec> ReadJunctions(const config::DeclaredMap& file, const std::vector<RoadDesign>& designs,
                                        const std::vector<network::Road>& roads);

// Changes the heights of minor roads, so that they meet the first one at the height of its edges, with the slope that
// its axis has in their direction.
void FitHeights(const std::vector<JunctionSpec>& junctions, std::vector<RoadDesign>& designs,
                const std::vector<network::Road>& roads, std::vector<std::string>& warnings);

}  // namespace rodeira::design
