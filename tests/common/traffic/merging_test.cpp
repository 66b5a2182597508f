// Where two lanes come together and both have a queue: one by one from each.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>
#include <string>

#include "common/traffic/traffic_model.hpp"
#include "tests/common/lanes/lane_networks.hpp"
#include "tests/common/lanes/mirrored.hpp"

namespace rodeira::traffic {
namespace {

// More wish to drive from the motorway's lane and from the ramp than the lane beyond carries. After the queues have come, of ten
// that pass nine come from the other lane than the one before, and never three from one.
void TwoQueuesZip(const std::shared_ptr<const network::Network>& network, const std::string& lane_name, const std::string& ramp_name) {
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
  double hardest_mps2 = 0.0;
  for (int i = 1; i * kStep_s < kFor_s; ++i) {
    model.Step(kStep_s, {});
    for (const AgentPose& pose : model.poses()) {
      hardest_mps2 = std::max(hardest_mps2, -pose.acceleration_mps2);
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
  EXPECT_LE(hardest_mps2, 3.0);
  testing::Test::RecordProperty("passed_per_h", std::to_string(3600.0 * static_cast<double>(passed.size()) / (kFor_s - kWarm_s)));
}

TEST(Merging, TwoQueuesZip) { TwoQueuesZip(lanes::MapNetwork("ramp"), "1:-1", "13:-1"); }
TEST(Merging, TwoQueuesZipMirroredInLeftHandTraffic) { TwoQueuesZip(lanes::Drawn(lanes::MapText("ramp")).Mirror().Read(), "1:1", "13:1"); }

}  // namespace
}  // namespace rodeira::traffic
