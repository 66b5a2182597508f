// SPDX-License-Identifier: Apache-2.0
// How drivers come to the speeds that bends allow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "common/traffic/traffic_model.hpp"
#include "common/world/road/world.hpp"
#include "tests/common/driving/driver/test_road.hpp"

namespace rodeira::traffic {
namespace {

// What is felt sideways at most, by heading and speed from step to step, and by how much a vehicle is faster than its
// share of the plan.
struct Felt {
  double lateral_mps2 = 0.0, over_mps = 0.0;
  std::string where;
};

// Some drivers, who begin along the road and come from its ends.
Felt DriveOver(const std::shared_ptr<const road::World>& world, double step_s) {
  TrafficSettings settings;
  settings.vehicles = 8;
  settings.overtaking.allowed = false;
  TrafficModel model = TrafficModel::Make(settings, world, {}).value();
  struct Before {
    std::int64_t trip = -1;
    double heading_rad = 0.0;
  };
  std::vector<Before> before(settings.vehicles);
  Felt felt;
  for (int i = 1; i * step_s < 90.0; ++i) {
    model.Step(step_s, {});
    for (const AgentPose& pose : model.poses()) {
      const Agent& agent = model.agent(pose.id);
      const double heading = FootprintOf(pose, model.traits(pose.id)).heading_rad,
                   d = agent.o_m - PieceAt(agent.path, agent.o_m).zero_m;
      const double over = pose.speed_mps - model.traits(pose.id).speed_factor *
                                               model.FreeSpeed_mps(PieceAt(agent.path, agent.o_m).track, d);
      const double lateral = std::fabs(
          pose.speed_mps * std::remainder(heading - before[pose.id].heading_rad, 2.0 * std::numbers::pi) / step_s);
      if (before[pose.id].trip == static_cast<std::int64_t>(pose.trip)) {
        felt.over_mps = std::max(felt.over_mps, over);
        if (lateral > felt.lateral_mps2) {
          felt.where = "car " + std::to_string(pose.id) + " after " + std::to_string(i * step_s) + " s at " +
                       std::to_string(d) + " m of lane " + std::to_string(pose.lane);
        }
        felt.lateral_mps2 = std::max(felt.lateral_mps2, lateral);
      }
      before[pose.id] = {pose.trip, heading};
    }
  }
  return felt;
}

// A bend that lets go and then draws in on a smaller radius, as slip roads of real files do: the plan allows more on
// the way there, and soon less. One that only looked at the plan where it is would have to brake all at once, which 3
// m/s³ do not let it: it came by up to 1 m/s, a third, too fast into a bend of 4 m, and was pressed sideways by 3.0
// m/s² instead of 2.
TEST(Bends, ATighterBendBehindABendIsComeToSlowly) {
  for (const double way : {-1.0, 1.0}) {
    for (const double lets_go_m : {1.0, 2.0, 3.0, 5.0}) {
      const double wide = way / 10.6, open = way / 27.0, tight = way / 5.7;
      const std::vector<geometry::PlanPiece> pieces{{70.0, 0.0, 0.0},        {5.0, wide, wide},  {1.0, wide, open},
                                                    {lets_go_m, open, open}, {1.5, open, tight}, {4.0, tight, tight},
                                                    {1.5, tight, 0.0},       {80.0, 0.0, 0.0}};
      double length = 0.0;
      for (const auto& piece : pieces) length += piece.length_m;
      const auto world = driver::WorldOf(driver::TwoLanes(pieces, 14.0, {{0.0, 0.0, 0.0}, {length, 0.0, 0.0}}));
      ASSERT_NE(world, nullptr);
      for (const double step_s : {0.01, 0.05}) {
        const Felt felt = DriveOver(world, step_s);
        EXPECT_LT(felt.over_mps, 0.3) << way << " " << lets_go_m << " " << step_s << " " << felt.where;
        EXPECT_LT(felt.lateral_mps2, 2.4) << way << " " << lets_go_m << " " << step_s << " " << felt.where;
        EXPECT_GT(felt.lateral_mps2, 0.9 * driver::LateralAllowed(0.025, {}))
            << way << " " << lets_go_m;  // it says something; the outer lane leans outward by 2.5 %
      }
    }
  }
}

}  // namespace
}  // namespace rodeira::traffic
