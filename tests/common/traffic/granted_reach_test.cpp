// SPDX-License-Identifier: Apache-2.0
// A vehicle that has just been granted its zones promises to come as far as the line before its next ones, no farther.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/simulation.hpp"
#include "common/traffic/state/vehicle_way.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kStep_s = 0.1, kTolerance_m = 1e-9;

// In each step the reservations alone are computed on a copy; there every vehicle that has been granted zones is asked
// how far it comes, and then, anew, where its next line is.
TEST(GrantedReach, EndsAtTheNextLine) {
  for (const std::string name : {"town", "roundabout"}) {
    TrafficSettings settings;
    settings.vehicles = 40;
    settings.seed = 5;
    const auto map = std::make_shared<const TrafficMap>(lanes::MapNetwork(name), settings);
    Simulation simulation{TrafficData(settings, map)};
    simulation.signals.FindColours();
    simulation.placing.PlaceAll({});
    simulation.body_poses.FindPoses();
    int asked = 0;
    for (int step = 0; step < 1500; ++step) {
      Simulation copy(simulation);
      std::vector<double> granted_m;
      for (const Agent& agent : copy.store.agents) granted_m.push_back(agent.granted_m);
      copy.seen.bodies.clear();
      copy.observation.See(copy.seen.bodies);
      copy.right_of_way.Arbitrate(kStep_s, std::llround(kStep_s * 1e9));
      for (std::uint32_t id = 0; id < granted_m.size(); ++id) {
        const Agent& agent = copy.store.agents[id];
        if (!agent.on_road || !(agent.granted_m > granted_m[id])) continue;
        copy.claimed.reaches[id] = -1.0;
        const double reach_m = copy.room.ReachOf(id, 0);
        copy.passages_ahead.FindPassage(id);
        const ConflictPassage& next = copy.claimed.passages[id];
        if (!next.any) continue;
        ++asked;
        ASSERT_LE(reach_m, std::max(0.0, next.line_m - FrontOf(agent, copy.store.traits[id])) + kTolerance_m)
            << name << ": vehicle " << id << " at " << kStep_s * step << " s";
      }
      simulation.Step(kStep_s, {});
    }
    EXPECT_GT(asked, 20) << name;
  }
}

}  // namespace
}  // namespace rodeira::traffic
