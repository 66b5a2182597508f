// SPDX-License-Identifier: Apache-2.0
// Which lane has the right of way where two meet, by signs, by the file, and by the rules of right-hand and of
// left-hand traffic.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "common/world/lanes/zones.hpp"
#include "tests/common/world/lanes/mirrored.hpp"

namespace rodeira::lanes {
namespace {

struct Made {
  explicit Made(std::shared_ptr<const network::Network> from)
      : network(std::move(from)), graph(*network), zones(graph) {}
  const std::string& RoadOf(std::uint32_t track) const { return network->roads()[graph[track].lane.road].id(); }
  // Zones of two ways through a junction, by which traffic on the one has to wait for the other.
  template <class Tell>
  void EachMeeting(const Tell& tell) const {
    for (const Zone& zone : zones.zones()) {
      if (zone.kind != ZoneKind::kDiverge && graph[zone.track[0]].junction >= 0 && graph[zone.track[1]].junction >= 0)
        tell(zone);
    }
  }

  std::shared_ptr<const network::Network> network;
  Graph graph;
  Zones zones;
};

// Of a crossing of four arms around the origin, as it looks in right-hand traffic.
class Crossing : public testing::TestWithParam<bool> {
 protected:
  static Made Read(Drawn& drawn) { return Made(GetParam() ? drawn.Mirror().Read() : drawn.Read()); }
  // By which arm a way comes: 0 from the east, 1 from the north, 2 from the west, 3 from the south.
  static int ArmOf(const Track& track) {
    const Eigen::Vector3d& at = track.curve.nodes().front().p_W;
    return static_cast<int>(
               std::lround((std::atan2(Up() * at.y(), at.x()) + 2.0 * std::numbers::pi) / (0.5 * std::numbers::pi))) %
           4;
  }
  // 1: to the left, 0: straight on, -1: to the right.
  static int TurnOf(const Track& track) {
    const Eigen::Vector2d from = track.curve.nodes().front().along_W.head<2>(),
                          to = track.curve.nodes().back().along_W.head<2>();
    return static_cast<int>(std::lround(Up() * (from.x() * to.y() - from.y() * to.x())));
  }
  static double Up() { return GetParam() ? -1.0 : 1.0; }
  // The road by which the cars of an arm come.
  static std::string ComesBy(int arm) { return std::to_string(2 * arm + 1); }
};

TEST_P(Crossing, RightBeforeLeftAndATurnAcrossOncomingTrafficYields) {
  Drawn drawn(MapText("lights", false));
  const Made made = Read(drawn);
  int beside = 0, oncoming = 0;
  made.EachMeeting([&](const Zone& zone) {
    const Track &a = made.graph[zone.track[0]], &b = made.graph[zone.track[1]];
    EXPECT_EQ(a.left_hand, GetParam());
    EXPECT_FALSE(zone.signed_);
    const auto told = [&] { return made.RoadOf(zone.track[0]) + " and " + made.RoadOf(zone.track[1]); };
    const int apart = (ArmOf(b) - ArmOf(a) + 4) % 4;  // 1: b comes from a's right
    if (apart == 1 || apart == 3) {
      EXPECT_EQ(zone.first, apart == 1 ? 1 : 0) << told();
      ++beside;
    } else if (apart == 2 && (TurnOf(a) == 1) != (TurnOf(b) == 1)) {
      EXPECT_EQ(zone.first, TurnOf(a) == 1 ? 1 : 0) << told();
      ++oncoming;
    }
  });
  EXPECT_GE(beside, 20);
  EXPECT_GE(oncoming, 6);
}

TEST_P(Crossing, SignsGoBeforeTheRules) {
  for (int arm = 0; arm < 4; ++arm) {
    const int other = (arm + 1) % 4;
    struct Case {
      const char *on_arm, *on_other;  // signs; "": none
      int first;                      // the arm that goes first of these two
    };
    for (const Case& c : {Case{"205", "", other},
                          {"", "205", arm},
                          {"206", "", other},
                          {"", "206", arm},
                          {"301", "", arm},
                          {"", "301", other},
                          {"306", "205", arm},
                          {"205", "206", arm},
                          {"206", "205", other},
                          {"=yield", "", other},
                          {"", "=stop", arm},
                          {"=priorityRoad", "205", arm},
                          {"", "=priorityRoad", other},
                          {"=4way", "=priorityRoad", other}}) {
      Drawn drawn(MapText("lights", false));
      if (*c.on_arm != 0) drawn.Sign(ComesBy(arm), c.on_arm);
      if (*c.on_other != 0) drawn.Sign(ComesBy(other), c.on_other);
      const Made made = Read(drawn);
      int met = 0;
      made.EachMeeting([&](const Zone& zone) {
        const std::array<int, 2> arms{ArmOf(made.graph[zone.track[0]]), ArmOf(made.graph[zone.track[1]])};
        if (std::minmax(arms[0], arms[1]) != std::minmax(arm, other)) return;
        ++met;
        EXPECT_EQ(arms[static_cast<std::size_t>(zone.first)], c.first)
            << arm << " '" << c.on_arm << "', " << other << " '" << c.on_other << "'";
        EXPECT_TRUE(zone.signed_);
      });
      EXPECT_GE(met, 5);
    }
  }
}

// Two give-way signs say nothing of which of the two goes first.
TEST_P(Crossing, BetweenTwoEqualSignsTheRulesDecide) {
  Drawn plain(MapText("lights", false)), drawn(MapText("lights", false));
  for (int arm = 0; arm < 4; ++arm) drawn.Sign(ComesBy(arm), "205");
  const Made without = Read(plain), with = Read(drawn);
  ASSERT_EQ(with.zones.zones().size(), without.zones.zones().size());
  for (std::size_t i = 0; i < with.zones.zones().size(); ++i)
    EXPECT_EQ(with.zones.zones()[i].first, without.zones.zones()[i].first) << i;
}

TEST_P(Crossing, AFilesJunctionPrioritiesGoBeforeTheRulesAndAfterSigns) {
  Drawn plain(MapText("lights", false));
  const Made rules = Read(plain);
  int turned = 0;
  rules.EachMeeting([&](const Zone& zone) {
    if (turned >= 6) return;
    const auto first = static_cast<std::size_t>(zone.first);
    const Track& yields = rules.graph[zone.track[1 - first]];
    const int arms_apart = (ArmOf(yields) - ArmOf(rules.graph[zone.track[first]]) + 4) % 4;
    if (arms_apart == 0) return;
    ++turned;
    Drawn named(MapText("lights", false)), told(MapText("lights", false));
    named.Priority(rules.RoadOf(zone.track[1 - first]), rules.RoadOf(zone.track[first]));
    told.Priority(rules.RoadOf(zone.track[1 - first]), rules.RoadOf(zone.track[first]))
        .Sign(ComesBy(ArmOf(yields)), "205");
    for (const bool sign : {false, true}) {
      const Made made = Read(sign ? told : named);
      for (const Zone& now : made.zones.zones()) {
        if (now.track != zone.track || std::fabs(now.in_m[0] - zone.in_m[0]) > 0.1) continue;
        EXPECT_EQ(now.first, sign ? zone.first : 1 - zone.first)
            << made.RoadOf(zone.track[0]) << " and " << made.RoadOf(zone.track[1]);
        EXPECT_TRUE(now.signed_);
      }
    }
  });
  EXPECT_EQ(turned, 6);
}

TEST_P(Crossing, ARoundaboutsRingHasPriorityOverEntries) {
  constexpr double kRing_m = 16.0;
  Drawn drawn(MapText("roundabout"));
  const Made made = Read(drawn);
  const auto on_ring = [&](std::uint32_t track) {
    const auto& nodes = made.graph[track].curve.nodes();
    return std::all_of(nodes.begin(), nodes.end(),
                       [&](const Curve::Node& node) { return std::fabs(node.p_W.head<2>().norm() - kRing_m) < 0.5; });
  };
  const auto enters = [&](std::uint32_t track) {
    const auto& nodes = made.graph[track].curve.nodes();
    return !on_ring(track) && nodes.front().p_W.head<2>().norm() > nodes.back().p_W.head<2>().norm() + 1.0;
  };
  int met = 0;
  for (const Zone& zone : made.zones.zones()) {
    for (const std::size_t side : {0, 1}) {
      if (!on_ring(zone.track[side]) || !enters(zone.track[1 - side])) continue;
      ++met;
      EXPECT_EQ(zone.first, static_cast<int>(side))
          << made.RoadOf(zone.track[side]) << " and " << made.RoadOf(zone.track[1 - side]);
    }
  }
  EXPECT_GE(met, 4);
}

INSTANTIATE_TEST_SUITE_P(Hands, Crossing, testing::Bool(),
                         [](const auto& which) { return which.param ? "LeftHand" : "RightHand"; });

// All of the project's maps, signs and lights among them: in the mirror nothing changes but the side.
TEST(RightOfWay, IsMirroredInLeftHandTraffic) {
  for (const std::string& name : MapNames()) {
    Drawn right(MapText(name)), left(MapText(name));
    const Made a(right.Read()), b(left.Mirror().Read());
    ASSERT_EQ(a.graph.tracks().size(), b.graph.tracks().size()) << name;
    ASSERT_EQ(a.zones.zones().size(), b.zones.zones().size()) << name;
    for (std::size_t i = 0; i < a.zones.zones().size(); ++i) {
      const Zone &one = a.zones.zones()[i], &other = b.zones.zones()[i];
      ASSERT_EQ(one.track, other.track) << name << " " << i;
      EXPECT_EQ(one.first, other.first) << name << ": " << a.RoadOf(one.track[0]) << " and " << a.RoadOf(one.track[1]);
      EXPECT_EQ(one.signed_, other.signed_) << name;
      EXPECT_EQ(one.kind, other.kind) << name;
      for (const std::size_t side : {0, 1}) {
        EXPECT_NEAR(one.in_m[side], other.in_m[side], 1e-6) << name;
        EXPECT_NEAR(one.out_m[side], other.out_m[side], 1e-6) << name;
      }
    }
  }
}

}  // namespace
}  // namespace rodeira::lanes
