// SPDX-License-Identifier: Apache-2.0
// A roundabout of two lanes that is left from its outer lane alone: vehicles on the inner one change lanes in the ring.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "common/traffic/results/study.hpp"
#include "tests/common/traffic/demand_road.hpp"
#include "tests/common/traffic/two_lane_roundabout.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kStep_s = 0.1, kHalf_s = 600.0;

// So many an hour come by each of the four arms, on both lanes alike, and leave by each of the other three.
TrafficSettings Demand(double arm_per_h, std::uint64_t seed) {
  std::string routes = "routes:\n", flows = "flows:\n";
  for (int arm = 0; arm < 4; ++arm) {
    for (int past = 1; past < 4; ++past) {
      routes += fmt::format("  r{0}{1}: [\"in{0}\", \"out{1}\"]\n", arm, (arm + past) % 4);
      for (int lane = 1; lane <= 2; ++lane) {
        flows += fmt::format("  - {{lane: \"in{}:-{}\", vehicles_per_h: {}, route: r{}{}}}\n", arm, lane,
                             arm_per_h / 6.0, arm, (arm + past) % 4);
      }
    }
  }
  TrafficSettings settings = Settings(routes + flows, seed);
  settings.vehicles = TrafficSettings::kMaxOfFlows;
  return settings;
}

struct Served {
  double came_per_h = 0.0, left_per_h = 0.0;  // in the second half of the run
  double longest_stand_s = 0.0;
  std::int64_t collisions = 0, not_at_end = 0;
  std::uint64_t missed = 0;
};

Served Drive(double arm_per_h, std::uint64_t seed) {
  StudySettings study;
  study.traffic = Demand(arm_per_h, seed);
  study.step_s = kStep_s, study.watch_s = 0.5, study.duration_s = 2.0 * kHalf_s;
  Served served;
  double came = 0.0, left = 0.0, ended = 0.0;
  const StudyResult result = RunStudy(study, RoundaboutOfTwoLanes::Network(), [&](const StudyMoment& now) {
                               ended = static_cast<double>(now.model.ended());
                               served.missed = now.model.missed();
                               double all = 0.0;
                               for (const FlowCount& flow : now.model.flows()) all += static_cast<double>(flow.arrived);
                               if (now.time_s <= kHalf_s + 1e-6) came = all, left = ended;
                               served.came_per_h = (all - came) * 3600.0 / kHalf_s;
                             }).value();
  served.left_per_h = (ended - left) * 3600.0 / kHalf_s;
  served.longest_stand_s = result.longest_stand_s;
  served.collisions = result.collisions;
  served.not_at_end = result.left - result.left_because[static_cast<std::size_t>(LeaveReason::kRouteEnd)];
  return served;
}

// SUMO 1.15 serves 1600 and 2400 an hour on a roundabout like this one.
TEST(TwoLaneRoundabout, ServesWhatComes) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const Served served = Drive(400.0, seed);
    EXPECT_NEAR(served.left_per_h, served.came_per_h, 0.05 * served.came_per_h + 60.0) << seed;
    EXPECT_LT(served.longest_stand_s, 60.0) << seed;
    EXPECT_EQ(served.missed, 0u) << seed;
    EXPECT_EQ(served.collisions, 0) << seed;
    EXPECT_EQ(served.not_at_end, 0) << seed;
  }
}

TEST(TwoLaneRoundabout, ServesNineTenthsOfTwoThousandFourHundredAnHour) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const Served served = Drive(600.0, seed);
    EXPECT_GT(served.left_per_h, 0.9 * served.came_per_h) << seed;
    EXPECT_LT(served.longest_stand_s, 120.0) << seed;
    EXPECT_LT(served.missed, 10u) << seed;
    EXPECT_EQ(served.collisions, 0) << seed;
    EXPECT_EQ(served.not_at_end, 0) << seed;
  }
}

}  // namespace
}  // namespace rodeira::traffic
