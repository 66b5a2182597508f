// SPDX-License-Identifier: Apache-2.0
#include "common/world/lanes/graph.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/world/lanes/ring.hpp"
#include "common/world/lanes/signs.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"
#include "tests/common/world/opendrive/sample.hpp"
#include "tests/tree.hpp"

namespace rodeira::lanes {
namespace {

TEST(LaneGraph, HasTheMapsLanesAndConnections) {
  for (const std::string& name : MapNames()) {
    const auto map =
        traffic_map::LoadLaneMap(std::filesystem::path(SourceDir()) / "configs/maps" / (name + ".motors")).value();
    const auto network = MapNetwork(name);
    const Graph graph(*network);
    ASSERT_EQ(graph.tracks().size(), map.lanes.size()) << name;
    std::size_t links = 0, entries = 0;
    for (const Track& track : graph.tracks()) {
      links += track.next.size();
      entries += track.entry ? 1 : 0;
      for (const Link& link : track.next) {
        EXPECT_LT(std::fabs(link.offset_m), 0.02) << name;
        EXPECT_LT(std::fabs(link.from_d_m), 0.02) << name;
      }
    }
    EXPECT_EQ(links, map.connections.size()) << name;
    EXPECT_EQ(entries, map.start_lanes.size()) << name;
    EXPECT_TRUE(graph.says_entries()) << name;
  }
}

// A network's lanes may say where vehicles begin and end: then its edge is no entry, and a lane on which they end goes
// on into nothing.
TEST(LaneGraph, BeginsAndEndsWhereItsLanesSay) {
  opendrive::RoadText road;
  const auto lane = [](const std::string& more) {
    return "<lane id=\"-1\" type=\"driving\"><width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/>" + more +
           "</lane>";
  };
  const auto says = [](const char* what) {
    return fmt::format("<userData code=\"rodeira:traffic\" value=\"{}\"/>", what);
  };
  road.left = "";
  road.right = lane(says("begins") + says("ends"));
  const auto network = opendrive::MustRead(opendrive::Document(road.Text()));
  EXPECT_TRUE(network->Find({0, 0, -1})->traffic_begins);
  EXPECT_TRUE(network->Find({0, 0, -1})->traffic_ends);
  road.right = lane(says("sleeps"));
  const auto wrong =
      opendrive::Read(opendrive::Document(road.Text()), "w.xodr", opendrive::Tolerance::Unrepaired()).value();
  ASSERT_EQ(wrong.errors.size(), 1u);
  EXPECT_EQ(wrong.errors.front().message, "of the lane's traffic 'sleeps' was found; 'begins' or 'ends' was expected");
}

// Over a link a place stays where it is.
TEST(LaneGraph, LinksMeetWithinTheFilesGaps) {
  if (RealFiles().empty()) GTEST_SKIP() << "the real files are not beside the project";
  std::size_t links = 0;
  for (const auto& file : RealFiles()) {
    const auto network = opendrive::LoadNetwork(file).value();
    const Graph graph(*network);
    EXPECT_FALSE(graph.tracks().empty()) << file;
    for (const Track& track : graph.tracks()) {
      links += track.next.size();
      const CurvePoint end = track.curve.At(track.length_m());
      for (const Link& link : track.next) {
        const CurvePoint at = graph[link.to].curve.At(link.from_d_m);
        const Eigen::Vector2d there = at.p_W.head<2>() + link.offset_m * at.left_W();
        EXPECT_LT((there - end.p_W.head<2>()).norm(), 0.02) << file << " road " << track.lane.road;
        EXPECT_LT(std::fabs(end.p_W.z() - at.p_W.z()), 0.5) << file;
      }
    }
  }
  EXPECT_GT(links, 100U);
}

// A driving lane that a file leaves to buses is none for cars: no lane is beside it, and none goes on into it.
TEST(LaneGraph, LanesThatAreClosedToCarsAreNotDriven) {
  opendrive::RoadText road;
  const auto lane = [](int id, const std::string& access) {
    return fmt::format(
        "<lane id=\"{}\" type=\"driving\"><width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/>{}</lane>", id,
        access);
  };
  for (const bool closed : {false, true}) {
    road.right = lane(-1, "") + lane(-2, closed ? "<access sOffset=\"0\" rule=\"allow\" restriction=\"bus\"/>"
                                                : "<access sOffset=\"0\" rule=\"deny\" restriction=\"truck\"/>");
    const auto network = opendrive::MustRead(opendrive::Document(road.Text()));
    const Graph graph(*network);
    EXPECT_EQ(graph.tracks().size(), closed ? 2u : 3u);
    EXPECT_EQ(graph.Find({0, 0, -2}).has_value(), !closed);
    EXPECT_EQ(graph[*graph.Find({0, 0, -1})].right.has_value(), !closed);
  }
}

// A turning lane between two lanes is none for through traffic, whatever its file calls it; a road of nothing but a
// lane of both directions is driven.
TEST(LaneGraph, TwoWayTurningLanesAreNotDriven) {
  const auto lane = [](int id, const char* type, const char* direction) {
    return fmt::format(
        "<lane id=\"{}\" type=\"{}\" direction=\"{}\"><width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/></lane>",
        id, type, direction);
  };
  opendrive::RoadText road;
  for (const auto& [type, direction] : {std::pair{"bidirectional", "standard"}, {"driving", "both"}}) {
    road.right = lane(-1, type, direction) + lane(-2, "driving", "standard");
    const auto network = opendrive::MustRead(opendrive::Document(road.Text()));
    const Graph graph(*network);
    EXPECT_EQ(graph.tracks().size(), 2u);
    EXPECT_FALSE(graph.Find({0, 0, -1}).has_value());
    EXPECT_FALSE(graph[*graph.Find({0, 0, -2})].left.has_value());
  }
  road.left = "";
  road.right = lane(-1, "bidirectional", "standard");
  const auto network = opendrive::MustRead(opendrive::Document(road.Text()));
  EXPECT_TRUE(Graph(*network).Find({0, 0, -1}).has_value());
}

TEST(LaneGraph, FindsWhatIsNear) {
  const auto network = MapNetwork("town");
  const Graph graph(*network);
  std::vector<NodeKey> found;
  for (const Eigen::Vector2d& p : {Eigen::Vector2d(0, 0), Eigen::Vector2d(31, -17), Eigen::Vector2d(-200, 3)}) {
    graph.Near(p, 6.5, found);
    std::vector<NodeKey> all;
    for (std::uint32_t t = 0; t < graph.tracks().size(); ++t) {
      for (std::uint32_t n = 0; n < graph[t].curve.nodes().size(); ++n) {
        if ((graph[t].curve.nodes()[n].p_W.head<2>() - p).norm() <= 6.5) all.push_back({t, n});
      }
    }
    EXPECT_EQ(found, all);
  }
}

TEST(LaneGraph, KnowsRoundaboutsAndStopLines) {
  int on_ring = 0;
  const auto roundabout = MapNetwork("roundabout");
  const Graph graph(*roundabout);
  for (std::uint32_t t = 0; t < graph.tracks().size(); ++t) on_ring += OnRing(graph, t) ? 1 : 0;
  EXPECT_GE(on_ring, 4);
  const auto crossing = MapNetwork("crossing");
  const Graph arms(*crossing);
  int stops = 0;
  for (std::uint32_t t = 0; t < arms.tracks().size(); ++t) {
    EXPECT_FALSE(OnRing(arms, t)) << t;
    for (const SignPlace& sign : SignsOf(arms, t)) {
      EXPECT_EQ(sign.sign, Sign::kStop);
      EXPECT_NEAR(sign.d_m, arms[t].length_m(), 0.01);
      ++stops;
    }
  }
  EXPECT_EQ(stops, 2);  // two lanes of the four arms
}

}  // namespace
}  // namespace rodeira::lanes
