// SPDX-License-Identifier: Apache-2.0
// Lanes of other people's roads that meet with a gap, a kink, or where one splits into two, or open from nothing:
// traffic drives there within its lanes, and what lies between linked ends is no place beside the road.
#include <gtest/gtest.h>

#include <cmath>

#include "common/traffic/check/joint_gaps.hpp"
#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/results/study.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::traffic {
namespace {

std::string Lane(int id, double width_m, const std::string& link = "") {
  return fmt::format(
      "<lane id=\"{}\" type=\"driving\"><link>{}</link><width sOffset=\"0\" a=\"{}\" b=\"0\" c=\"0\" d=\"0\"/></lane>",
      id, link, width_m);
}

// A road of 60 m along x with a lane of 3 m to the right, and one of 60 m that begins `gap_m` behind it, turned by
// `kink_rad` to the left.
std::shared_ptr<const network::Network> TwoRoads(double gap_m, double kink_rad, bool are_linked = true) {
  opendrive::RoadText first, second;
  const auto line = [](double x, double heading) {
    return fmt::format("<geometry s=\"0\" x=\"{}\" y=\"0\" hdg=\"{}\" length=\"60\"><line/></geometry>", x, heading);
  };
  first.length = second.length = 60.0, first.left = second.left = "", second.id = "2";
  first.geometry = line(0.0, 0.0), second.geometry = line(60.0 + gap_m, kink_rad);
  if (are_linked) {
    first.link = "<successor elementType=\"road\" elementId=\"2\" contactPoint=\"start\"/>";
    second.link = "<predecessor elementType=\"road\" elementId=\"1\" contactPoint=\"end\"/>";
  }
  first.right = Lane(-1, 3.0, are_linked ? "<successor id=\"-1\"/>" : "");
  second.right = Lane(-1, 3.0, are_linked ? "<predecessor id=\"-1\"/>" : "");
  return opendrive::MustRead(opendrive::Document(first.Text() + second.Text()));
}

StudyResult Drive(const std::shared_ptr<const network::Network>& network) {
  StudySettings settings;
  settings.traffic.vehicles = 20;
  settings.duration_s = 60.0;
  auto driven = RunStudy(settings, network);
  EXPECT_TRUE(driven.ok()) << driven.error().Text();
  return std::move(driven).value();
}

TEST(Joints, TheGroundBetweenLinkedEndsIsTheirs) {
  const auto apart = TwoRoads(0.8, 0.0);
  const lanes::Graph graph(*apart);
  const JointGaps gaps(graph);
  for (const double x : {60.01, 60.4, 60.79}) {
    for (const double y : {-0.01, -1.5, -2.99}) EXPECT_TRUE(gaps.Holds({x, y, 0.0})) << x << " " << y;
    for (const double y : {0.01, -3.01}) EXPECT_FALSE(gaps.Holds({x, y, 0.0})) << x << " " << y;
    EXPECT_FALSE(gaps.Holds({x, -1.5, 5.0})) << x;  // a level above
  }
  for (const double x : {59.99, 60.81}) EXPECT_FALSE(gaps.Holds({x, -1.5, 0.0})) << x;
  const auto unlinked = TwoRoads(0.8, 0.0, false);
  const lanes::Graph alone(*unlinked);
  EXPECT_FALSE(JointGaps(alone).Holds({60.4, -1.5, 0.0}));
}

// Turned to the left, the outer edges of the right lanes meet in a wedge: (60, -3), and 3 m to the right of the second
// road's beginning.
TEST(Joints, TheWedgeOfAKinkIsTheirs) {
  constexpr double kKink_rad = 0.4;
  const auto turned = TwoRoads(0.0, kKink_rad);
  const lanes::Graph graph(*turned);
  const JointGaps gaps(graph);
  const auto outwards = [&](double share, double t_m) {
    const double at = share * kKink_rad;
    return Eigen::Vector3d(60.0 + t_m * std::sin(at), -t_m * std::cos(at), 0.0);
  };
  EXPECT_TRUE(gaps.Holds(outwards(0.5, 2.9)));
  EXPECT_TRUE(gaps.Holds(outwards(0.5, 0.5)));
  EXPECT_FALSE(gaps.Holds(outwards(0.5, 3.05)));
  EXPECT_FALSE(gaps.Holds(outwards(1.2, 2.9)));
  EXPECT_FALSE(gaps.Holds(outwards(0.5, -0.5)));
}

TEST(Joints, TrafficDrivesOverAGapWithinItsLanes) {
  const StudyResult driven = Drive(TwoRoads(0.8, 0.0));
  EXPECT_GT(driven.arrivals, 5);
  EXPECT_EQ(driven.off_lane, 0);
  EXPECT_EQ(driven.wheels_off, 0);
}

TEST(Joints, TrafficDrivesRoundAKinkWithinItsLanes) {
  for (const double kink_rad : {0.25, 0.46, -0.46}) {
    const StudyResult driven = Drive(TwoRoads(0.0, kink_rad));
    EXPECT_GT(driven.arrivals, 5) << kink_rad;
    EXPECT_EQ(driven.off_lane, 0) << kink_rad;
    EXPECT_EQ(driven.wheels_off, 0) << kink_rad;
    EXPECT_EQ(driven.collisions, 0) << kink_rad;
  }
}

TEST(Joints, TrafficOfALaneThatSplitsDoesNotTouch) {
  opendrive::RoadText road;
  road.length = 20.0;
  road.geometry = "<geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"20\"><line/></geometry>";
  road.left = "";
  road.right = Lane(-1, 6.0, "<successor id=\"-1\"/><successor id=\"-2\"/>") +
               "</right></laneSection><laneSection s=\"10\"><center><lane id=\"0\" type=\"none\"/></center><right>" +
               Lane(-1, 3.0, "<predecessor id=\"-1\"/>") + Lane(-2, 3.0, "<predecessor id=\"-1\"/>");
  const StudyResult driven = Drive(opendrive::MustRead(opendrive::Document(road.Text())));
  EXPECT_GT(driven.arrivals, 10);
  EXPECT_EQ(driven.collisions, 0);
}

// A lane that opens from nothing to 6 m over 24 m and is the only one: traffic enters where it has the width.
TEST(Joints, TrafficEntersALaneThatOpensWhereItIsWideEnough) {
  opendrive::RoadText road;
  road.left = "";
  road.right =
      "<lane id=\"-1\" type=\"driving\"><width sOffset=\"0\" a=\"0\" b=\"0.25\" c=\"0\" d=\"0\"/>"
      "<width sOffset=\"24\" a=\"6\" b=\"0\" c=\"0\" d=\"0\"/></lane>";
  const StudyResult driven = Drive(opendrive::MustRead(opendrive::Document(road.Text())));
  EXPECT_GT(driven.arrivals, 5);
  EXPECT_EQ(driven.wheels_off, 0);
  EXPECT_EQ(driven.off_lane, 0);
  EXPECT_EQ(driven.collisions, 0);
}

// A lane that narrows to nothing over 40 m and two sections, and leads nowhere: ways end where it is 2 m wide.
TEST(Joints, TrafficLeavesALaneThatNarrowsToNothingWhereItIsWideEnough) {
  opendrive::RoadText road;
  road.left = "";
  road.length = 110.0;
  road.geometry = "<geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"110\"><line/></geometry>";
  road.right =
      "<lane id=\"-1\" type=\"driving\"><link><successor id=\"-1\"/></link>"
      "<width sOffset=\"0\" a=\"4\" b=\"0\" c=\"0\" d=\"0\"/>"
      "<width sOffset=\"70\" a=\"4\" b=\"-0.1\" c=\"0\" d=\"0\"/></lane>"
      "</right></laneSection><laneSection s=\"100\"><center><lane id=\"0\" type=\"none\"/></center><right>"
      "<lane id=\"-1\" type=\"driving\"><link><predecessor id=\"-1\"/></link>"
      "<width sOffset=\"0\" a=\"1\" b=\"-0.1\" c=\"0\" d=\"0\"/></lane>";
  const auto network = opendrive::MustRead(opendrive::Document(road.Text()));
  const TrafficMap map(network, TrafficSettings());
  ASSERT_EQ(map.graph.tracks().size(), 2u);
  EXPECT_NEAR(map.lane_ends.NarrowsFrom_m(0), 90.0, 1.5);  // to the next node of the lane's middle
  EXPECT_EQ(map.lane_ends.NarrowsFrom_m(1), 0.0);
  const StudyResult driven = Drive(network);
  EXPECT_GT(driven.arrivals, 5);
  EXPECT_EQ(driven.wheels_off, 0);
  EXPECT_EQ(driven.off_lane, 0);
}

}  // namespace
}  // namespace rodeira::traffic
