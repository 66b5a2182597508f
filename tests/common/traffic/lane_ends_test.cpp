// SPDX-License-Identifier: Apache-2.0
// A lane that ends while the lane beside goes on: vehicles change, wait at the end, and never vanish there.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <string>

#include "common/traffic/results/study.hpp"
#include "tests/common/traffic/demand_road.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::traffic {
namespace {

// A road of three lanes to the east, 300 m long; the right lane ends without a taper, the others go on for 600 m.
std::shared_ptr<const network::Network> RoadWithEndingLane() {
  const auto lane = [](int id, const char* link, const char* mark) {
    return fmt::format(
        "<lane id=\"{}\" type=\"driving\"><link>{}</link><width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/>"
        "<roadMark sOffset=\"0\" type=\"{}\" color=\"white\" width=\"0.12\"/><speed sOffset=\"0\" max=\"20\" "
        "unit=\"m/s\"/></lane>",
        id, link, mark);
  };
  opendrive::RoadText road, on;
  road.left = on.left = "";
  road.length = 300.0, on.length = 600.0;
  road.geometry = "<geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"300\"><line/></geometry>";
  road.right = lane(-1, "<successor id=\"-1\"/>", "broken") + lane(-2, "<successor id=\"-2\"/>", "broken") +
               lane(-3, "", "solid");
  road.link = "<successor elementType=\"road\" elementId=\"2\" contactPoint=\"start\"/>";
  on.id = "2";
  on.geometry = "<geometry s=\"0\" x=\"300\" y=\"0\" hdg=\"0\" length=\"600\"><line/></geometry>";
  on.right = lane(-1, "<predecessor id=\"-1\"/>", "broken") + lane(-2, "<predecessor id=\"-2\"/>", "solid");
  on.link = "<predecessor elementType=\"road\" elementId=\"1\" contactPoint=\"end\"/>";
  return opendrive::MustRead(opendrive::Document(road.Text() + on.Text()));
}

StudyResult RunOn(const std::string& route) {
  StudySettings study;
  study.traffic = Settings(fmt::format(
      "routes: {{on: [\"2\"]}}\nflows:\n  - {{lane: \"1:-1\", vehicles_per_h: 500{0}}}\n  - {{lane: \"1:-2\", "
      "vehicles_per_h: 500{0}}}\n  - {{lane: \"1:-3\", vehicles_per_h: 400{0}}}\n",
      route));
  study.duration_s = 600.0;
  study.step_s = 0.05;
  study.cell_m = 1.0;
  return RunStudy(study, RoadWithEndingLane()).value();
}

std::int64_t LeftBecause(const StudyResult& r, LeaveReason reason) {
  return r.left_because[static_cast<std::size_t>(reason)];
}

TEST(LaneEnds, VehiclesOfARouteMergeBeforeTheEnd) {
  const StudyResult r = RunOn(", route: on");
  EXPECT_EQ(LeftBecause(r, LeaveReason::kRouteEnd), r.left);
  EXPECT_GT(r.left, 150);
  EXPECT_EQ(r.collisions, 0);
  EXPECT_EQ(r.off_lane, 0);
  int merged = 0;
  for (const LaneTrip& trip : r.lanes->trips()) {
    EXPECT_EQ(trip.left, LeaveReason::kRouteEnd);
    EXPECT_NEAR(trip.way_m, 900.0, 15.0);
    if (trip.flow == 2) ++merged;
  }
  EXPECT_GT(merged, 30);
}

TEST(LaneEnds, VehiclesWithoutARouteMergeToo) {
  const StudyResult r = RunOn("");
  EXPECT_EQ(LeftBecause(r, LeaveReason::kLaneEnd), 0);
  EXPECT_EQ(LeftBecause(r, LeaveReason::kNetworkEnd), r.left);
  EXPECT_GT(r.left, 150);
  EXPECT_EQ(r.collisions, 0);
}

}  // namespace
}  // namespace rodeira::traffic
