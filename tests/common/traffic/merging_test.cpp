// SPDX-License-Identifier: Apache-2.0
// Where two lanes come together and both have a queue: one by one from each.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>
#include <string>

#include "common/traffic/traffic_model.hpp"
#include "tests/common/traffic/scripted.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"
#include "tests/common/world/lanes/mirrored.hpp"
#include "tests/common/world/lanes/short_sections.hpp"

namespace rodeira::traffic {
namespace {

// More wish to drive from the motorway's lane and from the ramp than the lane beyond carries. After the queues have
// come, of ten that pass nine come from the other lane than the one before, and never three from one.
void TwoQueuesZip(const std::shared_ptr<const network::Network>& network, const std::string& lane_name,
                  const std::string& ramp_name) {
  constexpr double kStep_s = 0.05, kWarm_s = 120.0, kFor_s = 420.0, kBeyond_m = 300.0;
  TrafficSettings settings;
  settings.vehicles = 400;
  settings.changes_lanes = false;
  settings.demand.routes = {{"on", {"6"}, "here"}};
  FlowSettings lane, ramp;
  lane.lane = lane_name, ramp.lane = ramp_name;
  lane.per_h = ramp.per_h = {1500.0};
  lane.route = ramp.route = "on";
  settings.demand.flows = {lane, ramp};
  TrafficModel model = TrafficModel::Make(settings, network, {}).value();
  std::set<std::pair<std::int32_t, std::uint32_t>> seen;
  std::string passed;  // by flow
  double max_deceleration_mps2 = 0.0;
  for (int i = 1; i * kStep_s < kFor_s; ++i) {
    model.Step(kStep_s, {});
    for (const AgentPose& pose : model.poses()) {
      max_deceleration_mps2 = std::max(max_deceleration_mps2, -pose.acceleration_mps2);
      const Agent& agent = model.agent(pose.id);
      if (pose.p_WB_W.x() < kBeyond_m || !seen.insert({agent.flow, agent.arrival}).second) continue;
      if (i * kStep_s > kWarm_s) passed += agent.flow == 0 ? 'l' : 'r';
    }
  }
  std::size_t others = 0;
  for (std::size_t n = 1; n < passed.size(); ++n) others += passed[n] != passed[n - 1];
  EXPECT_GT(passed.size(), 60u) << passed;
  EXPECT_GE(others, (passed.size() - 1) * 9 / 10) << passed;
  EXPECT_EQ(passed.find("lll"), std::string::npos) << passed;
  EXPECT_EQ(passed.find("rrr"), std::string::npos) << passed;
  EXPECT_LE(max_deceleration_mps2, 3.0);
  testing::Test::RecordProperty("passed_per_h",
                                std::to_string(3600.0 * static_cast<double>(passed.size()) / (kFor_s - kWarm_s)));
}

// A vehicle comes on each of two ways with last decimetres that are lane sections of their own, at all times apart: one
// that is let in behind the other stops at the line or follows it, whichever is the less braking, when the other one's
// front is on these sections as well. While they were told as ways that part it followed from then on, and braked in an
// emergency. Returns how often one came in behind the other.
int ComeTogetherCalmly(double straight_mps, double cut_m) {
  constexpr double kBend_mps = 4.0, kFrom_m = 220.0, kFor_s = 45.0;
  int followed = 0;
  for (double apart_m = -40.0; apart_m <= 40.0; apart_m += 1.0) {
    TrafficModel model = TrafficModel::Make(OnlyScripted({kCar, kCar}), lanes::ShortSections(cut_m), {}).value();
    Put(model, 0, "1:-1", kFrom_m + std::min(0.0, apart_m), straight_mps);
    Put(model, 1, "2:-1", kFrom_m - std::max(0.0, apart_m), kBend_mps);
    model.CapSpeed(0, straight_mps), model.CapSpeed(1, kBend_mps);
    bool follows = false;
    for (int i = 0; i * kStep_s < kFor_s; ++i) {
      Step(model);
      for (const AgentPose& pose : model.poses()) {
        EXPECT_FALSE(model.Hurries(pose.id))
            << straight_mps << " m/s, " << apart_m << " m apart: car " << pose.id << " after " << i * kStep_s << " s";
        follows = follows || model.agent(pose.id).eased_for >= 0;
      }
    }
    followed += follows ? 1 : 0;
  }
  return followed;
}

TEST(Merging, ShortLaneSectionsAtTheEndOfTheWaysChangeNothing) {
  for (const double straight_mps : {3.0, 4.0, 5.0, 6.0})
    EXPECT_GT(ComeTogetherCalmly(straight_mps, 0.2), 20) << straight_mps;
}

TEST(Merging, TwoQueuesZip) { TwoQueuesZip(lanes::MapNetwork("ramp"), "1:-1", "13:-1"); }
TEST(Merging, TwoQueuesZipMirroredInLeftHandTraffic) {
  TwoQueuesZip(lanes::Drawn(lanes::MapText("ramp")).Mirror().Read(), "1:1", "13:1");
}

}  // namespace
}  // namespace rodeira::traffic
