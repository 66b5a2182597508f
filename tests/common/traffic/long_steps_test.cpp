// SPDX-License-Identifier: Apache-2.0
// Steps that are longer than drivers can be left alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "common/traffic/results/study.hpp"
#include "common/traffic/traffic_model.hpp"
#include "tests/common/traffic/demand_road.hpp"
#include "tests/common/traffic/digest_of.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"

namespace rodeira::traffic {
namespace {

TrafficModel Made(const char* map) {
  TrafficSettings settings;
  settings.vehicles = 40;
  return TrafficModel::Make(settings, lanes::MapNetwork(map), {}).value();
}

// A second is four quarters of a second, to the bit, with all that left the road in them.
TEST(LongSteps, AreDrivenInParts) {
  for (const char* map : {"lights", "ramp"}) {
    TrafficModel whole = Made(map), parts = Made(map);
    std::size_t left = 0;
    for (int i = 0; i < 300; ++i) {
      whole.Step(1.0, {});
      std::vector<std::uint32_t> leavers;
      for (int part = 0; part < 4; ++part) {
        parts.Step(0.25, {});
        for (const Leaver& leaver : parts.leavers()) leavers.push_back(leaver.id);
      }
      std::ranges::sort(leavers);
      ASSERT_EQ(whole.leavers().size(), leavers.size()) << map << ": " << i;
      for (std::size_t k = 0; k < leavers.size(); ++k) ASSERT_EQ(whole.leavers()[k].id, leavers[k]) << map;
      ASSERT_EQ(DigestOf(whole), DigestOf(parts)) << map << ": " << i;
      left += leavers.size();
    }
    EXPECT_GT(left, 50u) << map;
  }
}

// A vehicle that is to be removed leaves once, in the first part.
TEST(LongSteps, RemoveOnce) {
  TrafficModel model = Made("ramp");
  const std::uint32_t id = model.poses()[3].id;
  ASSERT_TRUE(model.Remove(id).ok());
  model.Step(1.0, {});
  EXPECT_EQ(std::ranges::count(model.leavers(), id, &Leaver::id), 1);
  EXPECT_FALSE(model.agent(id).on_road);
}

// So many vehicles on a map end as many trips with long steps as with short ones, within 3 %, and no box overlaps
// another, no front passes a red.
TEST(LongSteps, LetAsManyThrough) {
  for (const char* map : {"town", "roundabout", "ramp"}) {
    double ended = 0.0;
    for (const double step_s : {0.1, 0.5, 1.0}) {
      StudySettings study;
      study.traffic.vehicles = 30;
      study.duration_s = 1200.0, study.step_s = step_s, study.watch_s = step_s;
      const StudyResult result = RunStudy(study, lanes::MapNetwork(map)).value();
      EXPECT_EQ(result.collisions, 0) << map << ", " << step_s;
      EXPECT_EQ(result.reds, 0) << map << ", " << step_s;
      const auto left = static_cast<double>(result.left);
      if (step_s == 0.1) ended = left;
      EXPECT_GT(left, 100.0) << map;
      EXPECT_NEAR(left, ended, 0.03 * ended) << map << ", " << step_s;
    }
  }
}

// A trip over 800 m drives them but for the length of the vehicle, and to where its front is in the step in which it
// leaves, however long that is.
TEST(LongSteps, CountTheWayOfTheStepInWhichAVehicleLeaves) {
  constexpr double kRoad_m = 800.0, kFastest_mps = 20.0;
  for (const double step_s : {0.1, 1.0}) {
    StudySettings study;
    study.traffic = Settings(
        "vehicles: 60\nlane_changes: {allowed: false}\nmix: {car: 1}\nflows:\n"
        "  - {lane: '1:-1', vehicles_per_h: 900}\n");
    study.traffic.variety = 0.0;
    study.traffic.speed_factor_low = study.traffic.speed_factor_high = 1.0;
    study.duration_s = 1200.0, study.step_s = step_s, study.watch_s = step_s;
    double under_way_m = 0.0, shortest_m = 1e9, longest_m = 0.0;
    const auto watch = [&](const StudyMoment& moment) {
      under_way_m = 0.0;
      for (const AgentPose& pose : moment.model.poses()) {
        const double length = moment.model.traits(pose.id).length_m;
        shortest_m = std::min(shortest_m, length), longest_m = std::max(longest_m, length);
        under_way_m += moment.model.agent(pose.id).o_m - 0.5 * length;
      }
    };
    const StudyResult result = RunStudy(study, Exit(500.0), watch).value();
    const auto left = static_cast<double>(result.left);
    EXPECT_GT(left, 200.0);
    const double trips_m = 1000.0 * result.driven_km - under_way_m;
    EXPECT_GE(trips_m, left * (kRoad_m - longest_m) - 0.01) << step_s;
    EXPECT_LE(trips_m, left * (kRoad_m - shortest_m + kFastest_mps * step_s) + 0.01) << step_s;
  }
}

}  // namespace
}  // namespace rodeira::traffic
