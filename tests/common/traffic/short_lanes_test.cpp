// SPDX-License-Identifier: Apache-2.0
// A lane that is too short for a vehicle, and leads on into nothing long enough, carries none.
#include <gtest/gtest.h>

#include "common/traffic/results/study.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::traffic {
namespace {

// Roads of one lane, one behind the other along x, from 0 on, and a gap of 100 m where a length is below 0.
std::shared_ptr<const network::Network> RoadsOf(const std::vector<double>& lengths_m) {
  std::string text;
  double x = 0.0;
  for (std::size_t i = 0; i < lengths_m.size(); ++i) {
    if (lengths_m[i] < 0.0) {
      x += 100.0;
      continue;
    }
    opendrive::RoadText road;
    road.id = std::to_string(i + 1), road.length = lengths_m[i];
    road.geometry =
        fmt::format("<geometry s=\"0\" x=\"{}\" y=\"0\" hdg=\"0\" length=\"{}\"><line/></geometry>", x, lengths_m[i]);
    const auto joins = [&](const char* what, std::size_t other, const char* contact) {
      return fmt::format("<{} elementType=\"road\" elementId=\"{}\" contactPoint=\"{}\"/>", what, other + 1, contact);
    };
    const bool after = i > 0 && lengths_m[i - 1] >= 0.0, before = i + 1 < lengths_m.size() && lengths_m[i + 1] >= 0.0;
    road.link = (after ? joins("predecessor", i - 1, "end") : "") + (before ? joins("successor", i + 1, "start") : "");
    road.left = "";
    road.right = "<lane id=\"-1\" type=\"driving\"><link>" + std::string(after ? "<predecessor id=\"-1\"/>" : "") +
                 (before ? "<successor id=\"-1\"/>" : "") +
                 "</link><width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/></lane>";
    text += road.Text();
    x += lengths_m[i];
  }
  return opendrive::MustRead(opendrive::Document(text));
}

StudySettings Settings() {
  StudySettings settings;
  settings.traffic.vehicles = 8;
  settings.duration_s = 60.0, settings.step_s = 0.05;
  return settings;
}

TEST(ShortLanes, CarryNoVehicles) {
  for (const double length_m : {0.5, 2.9, 4.0}) {
    const auto driven = RunStudy(Settings(), RoadsOf({length_m}));
    ASSERT_FALSE(driven.ok()) << length_m;
    EXPECT_EQ(driven.error().Text(),
              "the network '' has no lane to put traffic on; drivable lanes that are longer than a vehicle, or 0 "
              "vehicles, were expected");
    // Beside a long road: all vehicles use that one, and none moves farther in a step than its speed says.
    const auto beside = RunStudy(Settings(), RoadsOf({length_m, -1.0, 300.0}));
    ASSERT_TRUE(beside.ok()) << beside.error().Text();
    EXPECT_GT(beside.value().arrivals, 5);
    EXPECT_LT(beside.value().worst_step_m, 1e-3);
    EXPECT_EQ(beside.value().collisions, 0);
  }
}

TEST(ShortLanes, LeadOnIntoLongerOnes) {
  const auto driven = RunStudy(Settings(), RoadsOf({2.9, 1.5, 300.0, 2.0}));
  ASSERT_TRUE(driven.ok()) << driven.error().Text();
  EXPECT_GT(driven.value().arrivals, 5);
  EXPECT_LT(driven.value().worst_step_m, 1e-3);
  EXPECT_EQ(driven.value().collisions, 0);
}

TEST(ShortLanes, AFlowOnOneIsRefusedWithItsPlace) {
  StudySettings settings = Settings();
  settings.traffic.vehicles = 100;
  FlowSettings flow;
  flow.lane = "1:-1", flow.place = "flows.yaml:3", flow.per_h = {300.0};
  settings.traffic.demand.flows = {flow};
  const auto driven = RunStudy(settings, RoadsOf({2.9, -1.0, 300.0}));
  ASSERT_FALSE(driven.ok());
  EXPECT_EQ(driven.error().Text(),
            "flows.yaml:3: the lane '1:-1' and the ways on from it are shorter than a vehicle; at least 5.2 m were "
            "expected");
}

}  // namespace
}  // namespace rodeira::traffic
