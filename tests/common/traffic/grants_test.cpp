// SPDX-License-Identifier: Apache-2.0
// What agents are granted on their way: each grant reaches farther than the one before.
#include <gtest/gtest.h>

#include <string>

#include "common/traffic/traffic_model.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"

namespace rodeira::traffic {
namespace {

// Nothing is granted twice: not the zones, nor a STOP line that lies so far before them that a car stands between.
TEST(Grants, ReachFartherEachTime) {
  for (const std::string& name : lanes::MapNames()) {
    TrafficSettings settings;
    settings.vehicles = name == "town" ? 60 : 25;
    settings.seed = 3;
    TrafficModel model = TrafficModel::Make(settings, lanes::MapNetwork(name), {}).value();
    std::size_t granted = 0;
    for (int i = 0; i < 12000; ++i) {
      model.Step(0.02, {});
      for (const AgentPose& pose : model.poses()) {
        const auto& grants = model.agent(pose.id).grants;
        granted += grants.size();
        for (std::size_t k = 1; k < grants.size(); ++k)
          ASSERT_GT(grants[k].to_m, grants[k - 1].to_m)
              << name << ": car " << pose.id << " at " << 0.02 * (i + 1) << " s, " << grants.size() << " grants";
      }
    }
    EXPECT_GT(granted, 0u) << name;
  }
}

}  // namespace
}  // namespace rodeira::traffic
