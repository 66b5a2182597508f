// SPDX-License-Identifier: Apache-2.0
// Steps that are longer than drivers can be left alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "common/traffic/results/study.hpp"
#include "common/traffic/traffic_model.hpp"
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

}  // namespace
}  // namespace rodeira::traffic
