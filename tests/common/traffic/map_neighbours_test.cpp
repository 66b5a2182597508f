// SPDX-License-Identifier: Apache-2.0
// Lanes of a traffic map that share a border: they are neighbours, and what is painted there decides which way a change
// is allowed over or overtake.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <utility>

#include "common/core/base/files.hpp"
#include "common/traffic/results/study.hpp"
#include "common/world/lanes/edge_marks.hpp"
#include "common/world/opendrive/import.hpp"
#include "common/world/traffic_map/map_network.hpp"
#include "common/world/traffic_map/open_drive.hpp"
#include "tests/common/traffic/digest_of.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"

namespace rodeira::traffic {
namespace {

using traffic_map::BorderType;
using NetworkPointer = std::shared_ptr<const network::Network>;

constexpr double kLength_m = 700.0;  // of a piece

std::string Straight(int id, double from_m, double y_m) {
  return fmt::format("p,{},{},1,{},{},1,{},{},1,{},{},1,{}\n", id, from_m, y_m, from_m + kLength_m / 3.0, y_m,
                     from_m + 2.0 * kLength_m / 3.0, y_m, from_m + kLength_m, y_m);
}

// Two lanes of 3.6 m to the east or, `two_way`, one of them to the west, of two pieces each: lanes 1 and 3, from west
// to east, lie to the south, 2 and 4 to the north. Between them what each of both has for a border there.
traffic_map::LaneMap TwoLanes(bool two_way, BorderType of_south, BorderType of_north, bool left_hand = false) {
  std::string text;
  for (int piece = 0; piece < 2; ++piece) {
    for (int k = 0; k < 3; ++k)
      text += Straight(3 * piece + k + 1, piece * kLength_m, 3.6 * (1 - k));  // from north to south
  }
  // In left-hand traffic one that drives to the west is on the south side.
  const bool south_west = two_way && left_hand, north_west = two_way && !left_hand;
  const auto lane = [&](int id, int north, int south, BorderType of_north_side, BorderType of_south_side, bool west,
                        bool begins) {
    const int left = west ? south : north, right = west ? north : south;
    const auto of_left = static_cast<int>(west ? of_south_side : of_north_side),
               of_right = static_cast<int>(west ? of_north_side : of_south_side);
    const char* turned = west ? "True" : "False";
    text +=
        fmt::format("l,{},{},{},{},{},{},{},{}\n", id, left, turned, of_left, right, turned, of_right, begins ? 1 : 2);
  };
  for (int piece = 0; piece < 2; ++piece) {
    lane(2 * piece + 1, 3 * piece + 2, 3 * piece + 3, of_south, BorderType::kBoundary, south_west,
         south_west == (piece == 1));
    lane(2 * piece + 2, 3 * piece + 1, 3 * piece + 2, BorderType::kBoundary, of_north, north_west,
         north_west == (piece == 1));
  }
  text += south_west ? "c,3,1,False,0,0,0\n" : "c,1,3,False,0,0,0\n";
  text += north_west ? "c,4,2,False,0,0,0\n" : "c,2,4,False,0,0,0\n";
  const auto file = traffic_map::ParseMap(text + "s,10\ni\n", "two");
  EXPECT_TRUE(file.ok()) << (file.ok() ? "" : file.error().Text());
  traffic_map::Heights beside;
  beside.left_hand = left_hand;
  const auto made = traffic_map::MakeLaneMap(file.value(), beside, "two");
  EXPECT_TRUE(made.ok()) << (made.ok() ? "" : made.error().Text());
  return made.value();
}
NetworkPointer NetworkOf(const traffic_map::LaneMap& map) {
  const auto network = traffic_map::ToNetwork(map, "two");
  EXPECT_TRUE(network.ok()) << (network.ok() ? "" : network.error().Text());
  return network.value();
}

std::uint32_t TrackOf(const lanes::Graph& graph, const std::string& road) {
  for (std::uint32_t i = 0; i < graph.tracks().size(); ++i) {
    if (graph.network().roads()[graph[i].lane.road].id() == road) return i;
  }
  ADD_FAILURE() << road;
  return 0;
}

TEST(MapNeighbours, AreThoseThatShareABorder) {
  const auto network = NetworkOf(TwoLanes(false, BorderType::kDashedSame, BorderType::kDashedSame));
  const lanes::Graph graph(*network);
  const std::uint32_t one = TrackOf(graph, "1"), two = TrackOf(graph, "2");
  EXPECT_EQ(graph[one].left, two);
  EXPECT_EQ(graph[two].right, one);
  EXPECT_FALSE(graph[one].right || graph[two].left || graph.Oncoming(one) || graph.Oncoming(two));
  const auto both = NetworkOf(TwoLanes(true, BorderType::kDashed, BorderType::kDashed));
  const lanes::Graph ways(*both);
  EXPECT_EQ(ways.Oncoming(TrackOf(ways, "1")), TrackOf(ways, "2"));
  EXPECT_EQ(ways.Oncoming(TrackOf(ways, "2")), TrackOf(ways, "1"));
  ASSERT_EQ(ways.tracks().size(), 4U);
  for (const lanes::Track& track : ways.tracks()) EXPECT_FALSE(track.left || track.right);
}

// On all of the project's maps: the place beside is the foot of the place, both ways.
TEST(MapNeighbours, PlacesBesideAreFeet) {
  int pairs = 0;
  for (const char* name : {"crossing", "lights", "overpass", "ramp", "roundabout", "town"}) {
    const auto network =
        traffic_map::LoadNetwork(std::filesystem::path(SourceDir()) / "configs/maps" / (std::string(name) + ".motors"));
    ASSERT_TRUE(network.ok());
    const lanes::Graph graph(*network.value());
    for (std::uint32_t i = 0; i < graph.tracks().size(); ++i) {
      for (const auto& beside : {graph[i].left, graph[i].right, graph.Oncoming(i)}) {
        if (!beside) continue;
        ++pairs;
        const lanes::Curve &own = graph[i].curve, &other = graph[*beside].curve;
        for (double d = 0.0; d <= own.length_m(); d += 0.7) {
          const double there = graph.Across(i, d, *beside);
          if (there <= 0.0 || there >= other.length_m()) continue;
          const lanes::CurvePoint at = own.At(d), to = other.At(there);
          EXPECT_NEAR((at.p_W - to.p_W).head<2>().dot(to.ahead_W), 0.0, 0.02) << name << " " << i << " " << d;
          EXPECT_LT((at.p_W - to.p_W).head<2>().norm(), 6.0) << name << " " << i << " " << d;
          EXPECT_NEAR(graph.Across(*beside, there, i), d, 0.1) << name << " " << i << " " << d;
        }
      }
    }
  }
  EXPECT_GT(pairs, 100);
}

// Of both borders the own one counts; where it paints nothing, the other one.
TEST(MapNeighbours, TheOwnBorderDecides) {
  struct Case {
    BorderType of_1, of_2;
    bool may_1, may_2;
  };
  for (const Case& c : {Case{BorderType::kDashedSame, BorderType::kDashedSame, true, true},
                        Case{BorderType::kDashedSpeedCtrl, BorderType::kDashedWarn, true, true},
                        Case{BorderType::kSingle, BorderType::kSingle, false, false},
                        Case{BorderType::kDashedSame, BorderType::kSingle, true, false},
                        Case{BorderType::kNone, BorderType::kSingle, false, false},
                        Case{BorderType::kNone, BorderType::kDashed, true, true},
                        Case{BorderType::kNone, BorderType::kNone, true, true},
                        Case{BorderType::kBoundary, BorderType::kNone, false, false}}) {
    for (const bool two_way : {false, true}) {
      const auto network = NetworkOf(TwoLanes(two_way, c.of_1, c.of_2));
      const lanes::Graph graph(*network);
      const lanes::EdgeMarks marks(graph);
      const std::string what =
          fmt::format("{} {} two_way {}", static_cast<int>(c.of_1), static_cast<int>(c.of_2), two_way);
      EXPECT_EQ(marks.MayCross(TrackOf(graph, "1"), lanes::Side::kLeft, 100.0, 200.0), c.may_1) << what;
      EXPECT_EQ(marks.MayCross(TrackOf(graph, "2"), two_way ? lanes::Side::kLeft : lanes::Side::kRight, 100.0, 200.0),
                c.may_2)
          << what;
      EXPECT_FALSE(marks.MayCross(TrackOf(graph, "1"), lanes::Side::kRight, 100.0, 200.0)) << what;
    }
  }
}

struct Drive {
  int changes = 0;
  std::int64_t collisions = 0;
  base::Digest digest = 0;
};

// A third of the vehicles is slow.
Drive DriveOn(const NetworkPointer& network, int threads = 1) {
  Drive drive;
  StudySettings settings;
  settings.traffic.vehicles = 24, settings.traffic.seed = 3,
  settings.traffic.threads = static_cast<std::uint32_t>(threads);
  settings.traffic.mix.shares = {0.7, 0.0, 0.3, 0.0};
  settings.duration_s = 300.0, settings.step_s = 0.05, settings.watch_s = 0.05;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::int32_t> on;
  const auto result = RunStudy(settings, network, [&](const StudyMoment& moment) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::int32_t> now;
    for (const AgentPose& pose : moment.model.poses()) {
      const std::pair trip(pose.id, pose.trip);
      now[trip] = pose.road;
      const auto is_north = [&](std::int32_t road) {
        return std::stoi(network->roads()[static_cast<std::size_t>(road)].id()) % 2 == 0;
      };
      if (const auto before = on.find(trip); before != on.end() && is_north(before->second) != is_north(pose.road))
        ++drive.changes;
    }
    on = std::move(now);
    drive.digest = DigestOf(moment.model);
  });
  EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.error().Text());
  drive.collisions = result.value().collisions;
  return drive;
}

TEST(MapNeighbours, TrafficChangesOverWhereItMay) {
  const Drive dashed = DriveOn(NetworkOf(TwoLanes(false, BorderType::kDashedSame, BorderType::kDashedSame)));
  EXPECT_GT(dashed.changes, 5);
  EXPECT_EQ(dashed.collisions, 0);
  const Drive single = DriveOn(NetworkOf(TwoLanes(false, BorderType::kSingle, BorderType::kSingle)));
  EXPECT_EQ(single.changes, 0);
  EXPECT_EQ(DriveOn(NetworkOf(TwoLanes(false, BorderType::kDashedSame, BorderType::kDashedSame)), 3).digest,
            dashed.digest);
}

// Times that a vehicle has come over to the side of those that come, where a third crawls; and overlaps of two.
std::pair<int, int> OvertakesOn(const NetworkPointer& network) {
  TrafficSettings settings;
  settings.vehicles = 12, settings.seed = 3;
  TrafficModel model = TrafficModel::Make(settings, network, {}).value();
  const bool left_hand = network->roads()[0].spec().left_hand;
  std::map<std::uint32_t, bool> over;
  int overtakes = 0, touches = 0;
  for (int i = 0; i < 300 * 20; ++i) {
    for (std::uint32_t id = 0; id < settings.vehicles; id += 3) model.CapSpeed(id, 6.0);
    model.Step(0.05, {});
    for (const AgentPose& pose : model.poses()) {
      const bool east = (pose.q_WB * Eigen::Vector3d::UnitX()).x() > 0.0;
      const bool beyond = left_hand ? (pose.p_WB_W.y() < 0.0) == east : (pose.p_WB_W.y() > 0.0) == east;
      if (beyond && !over[pose.id]) ++overtakes;
      over[pose.id] = beyond;
      for (const AgentPose& other : model.poses()) {
        if (other.id < pose.id &&
            driver::Overlap(FootprintOf(pose, model.traits(pose.id)), FootprintOf(other, model.traits(other.id))))
          ++touches;
      }
    }
  }
  return {overtakes, touches};
}

TEST(MapNeighbours, TrafficOvertakesWhereItMay) {
  for (const bool left_hand : {false, true}) {
    const auto dashed = OvertakesOn(NetworkOf(TwoLanes(true, BorderType::kDashed, BorderType::kDashed, left_hand)));
    EXPECT_GT(dashed.first, 5) << left_hand;
    EXPECT_EQ(dashed.second, 0) << left_hand;
    const auto single = OvertakesOn(NetworkOf(TwoLanes(true, BorderType::kSingle, BorderType::kSingle, left_hand)));
    EXPECT_EQ(single.first, 0) << left_hand;
  }
}

// A converted map says the same: through text and back.
TEST(MapNeighbours, AConvertedMapHasThemToo) {
  const auto made = traffic_map::ToOpenDrive(TwoLanes(false, BorderType::kDashedSame, BorderType::kSingle), "two",
                                             traffic_map::Junctions::kCommon);
  ASSERT_TRUE(made.ok());
  const auto import = opendrive::Read(made.value().xml, "two.xodr");
  ASSERT_TRUE(import.ok() && import.value().errors.empty());
  EXPECT_TRUE(import.value().warnings.empty());
  const lanes::Graph graph(*import.value().network);
  EXPECT_EQ(graph[TrackOf(graph, "1")].left, TrackOf(graph, "2"));
  // What only one of both says is told, and no neighbour.
  std::string one_sided = made.value().xml;
  const std::size_t at = one_sided.find("\"rodeira:right\"");
  ASSERT_NE(at, std::string::npos);
  one_sided.replace(at, 15, "\"someone:else\"");
  const auto told = opendrive::Read(one_sided, "two.xodr");
  ASSERT_TRUE(told.ok() && told.value().errors.empty());
  ASSERT_EQ(told.value().warnings.size(), 1u);
  EXPECT_NE(told.value().warnings.front().Text().find(
                "beside it on the left is said to be lane -1 of road 2, which does not say so"),
            std::string::npos)
      << told.value().warnings.front().Text();
  EXPECT_FALSE(lanes::Graph(*told.value().network)[0].left);
  std::string wrong = made.value().xml;
  wrong.replace(wrong.find("value=\"-1 2\""), 12, "value=\"2\"");
  const auto refused = opendrive::Read(wrong, "two.xodr", opendrive::Tolerance::Unrepaired());
  ASSERT_TRUE(refused.ok());
  ASSERT_EQ(refused.value().errors.size(), 1u);
  EXPECT_NE(refused.value().errors.front().Text().find(
                "as the lane beside '2' was found; a lane and its road ('-1 12') were expected"),
            std::string::npos);
}

}  // namespace
}  // namespace rodeira::traffic
