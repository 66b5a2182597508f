// SPDX-License-Identifier: Apache-2.0
// No vehicle blocks the box: a car that comes to rest does so where it crosses no other's way.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "common/traffic/traffic_model.hpp"
#include "tests/common/world/lanes/closed_grid.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"
#include "tests/long_form.hpp"

namespace rodeira::traffic {
namespace {

// Whether a part of the car stands on ground that another way crosses.
bool InABox(const TrafficModel& model, std::uint32_t id) {
  const Agent& agent = model.agent(id);
  const double half = 0.5 * model.traits(id).length_m;
  for (std::size_t i = 0; i < agent.path.size(); ++i) {
    const Piece& piece = agent.path[i];
    const double end =
        i + 1 < agent.path.size() ? agent.path[i + 1].begin_m : piece.zero_m + model.graph()[piece.track].length_m();
    for (const lanes::ZoneSide& part : model.zones().Of(piece.track)) {
      if (part.kind != lanes::ZoneKind::kCross) continue;
      const double from = std::max(piece.zero_m + part.in_m, piece.begin_m),
                   to = std::min(piece.zero_m + part.out_m, end);
      if (from < to && agent.o_m + half > from + 0.05 && agent.o_m - half < to - 0.05) return true;
    }
  }
  return false;
}

// More cars than these roads bear: there are queues before all junctions, and none in them. One that has been let in
// after another one may wait for it on the way through: for seconds, and that is less than a hundredth of all standing,
// of seven seeds.
TEST(Box, IsNotBlockedByAQueue) {
  struct Case {
    std::string name;
    std::shared_ptr<const network::Network> network;
    std::uint32_t vehicles;
  };
  for (const Case& c :
       {Case{"crossing", lanes::MapNetwork("crossing"), 70}, Case{"town", lanes::MapNetwork("town"), 150},
        Case{"closed town", lanes::ClosedGrid::Make(3),
             static_cast<std::uint32_t>(45.0 * lanes::ClosedGrid::Lanes_km(3))},
        Case{"closed town with lights", lanes::ClosedGrid::Make(3, true),
             static_cast<std::uint32_t>(45.0 * lanes::ClosedGrid::Lanes_km(3))}}) {
    double standing_s = 0.0, in_boxes_s = 0.0;
    for (std::uint64_t seed = 6; seed <= BriefOrLong(7u, 12u); ++seed) {
      TrafficSettings settings;
      settings.vehicles = c.vehicles;
      settings.seed = seed;
      TrafficModel model = TrafficModel::Make(settings, c.network, {}).value();
      constexpr double kStep_s = 0.05, kAtRest_mps = 0.05;
      std::vector<double> stands_s(c.vehicles, 0.0);
      double longest_s = 0.0;
      std::string where;
      for (int i = 0; i < BriefOrLong(5000, 8000); ++i) {
        model.Step(kStep_s, {});
        for (const AgentPose& pose : model.poses()) {
          double& stands = stands_s[pose.id];
          if (pose.speed_mps > kAtRest_mps) {
            stands = 0.0;
            continue;
          }
          standing_s += kStep_s;
          if (!InABox(model, pose.id)) continue;
          stands += kStep_s;
          in_boxes_s += kStep_s;
          if (stands <= longest_s) continue;
          longest_s = stands;
          where = fmt::format("car {} after {:.2f} s at ({:.1f}, {:.1f})", pose.id, kStep_s * i, pose.p_WB_W.x(),
                              pose.p_WB_W.y());
        }
      }
      EXPECT_LT(longest_s, 15.0) << c.name << ", seed " << seed << ": " << where;
      if (std::getenv("RODEIRA_TELL") != nullptr)
        fmt::print("{} {}: at most {:.2f} s, {}\n", c.name, seed, longest_s, where);
    }
    EXPECT_LT(in_boxes_s, 0.01 * standing_s) << c.name;
    EXPECT_GT(standing_s, 3500.0) << c.name;
    if (std::getenv("RODEIRA_TELL") != nullptr)
      fmt::print("{}: {:.2f} s of {:.0f} s\n", c.name, in_boxes_s, standing_s);
  }
}

}  // namespace
}  // namespace rodeira::traffic
