// SPDX-License-Identifier: Apache-2.0
#include "common/world/lanes/zones.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/world/lanes/signs.hpp"
#include "common/world/lanes/swath.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"
#include "tests/common/world/lanes/short_sections.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::lanes {
namespace {

struct Box {
  Eigen::Vector2d p, along;
};

Box CarAt(const Curve& curve, double d) {
  const LargestCar car;
  const Eigen::Vector2d front = curve.At(d + 0.5 * car.wheelbase_m).p_W.head<2>(),
                        rear = curve.At(d - 0.5 * car.wheelbase_m).p_W.head<2>();
  return {0.5 * (front + rear), (front - rear).normalized()};
}

bool Touch(const Box& a, const Box& b) {
  const LargestCar car;
  const auto reach = [&](const Box& box, const Eigen::Vector2d& axis) {
    return 0.5 * (car.length_m * std::fabs(box.along.dot(axis)) +
                  car.width_m * std::fabs(box.along.x() * axis.y() - box.along.y() * axis.x()));
  };
  for (const Box* box : {&a, &b}) {
    for (const Eigen::Vector2d& axis : {box->along, Eigen::Vector2d(-box->along.y(), box->along.x())}) {
      if (std::fabs((b.p - a.p).dot(axis)) >= reach(a, axis) + reach(b, axis)) return false;
    }
  }
  return true;
}

// Brute force: wherever two of the largest cars on two tracks touch, each has a part within a zone of the pair. (On one
// track and its continuation cars follow one another.)
TEST(Zones, HoldEveryPlaceWhereCarsOnTwoTracksTouch) {
  const double half = 0.5 * LargestCar{}.length_m;
  std::size_t touches = 0;
  for (const std::string& name : std::vector<std::string>{"crossing", "roundabout", "ramp"}) {
    const auto network = MapNetwork(name);
    const Graph graph(*network);
    const Zones zones(graph);
    for (std::uint32_t a = 0; a < graph.tracks().size(); ++a) {
      for (std::uint32_t b = a + 1; b < graph.tracks().size(); ++b) {
        const auto follows = [&](std::uint32_t from, std::uint32_t to) {
          for (const Link& link : graph[from].next) {
            if (link.to == to) return true;
            for (const Link& on : graph[link.to].next) {
              if (on.to == to && graph[link.to].length_m() < 12.0) return true;
            }
          }
          return false;
        };
        if (follows(a, b) || follows(b, a)) continue;
        for (double x = half; x < graph[a].length_m() - half; x += 0.8) {
          const Box one = CarAt(graph[a].curve, x);
          for (double y = half; y < graph[b].length_m() - half; y += 0.8) {
            const Box other = CarAt(graph[b].curve, y);
            if ((one.p - other.p).squaredNorm() > 36.0 || !Touch(one, other)) continue;
            if (std::fabs(graph[a].curve.At(x).p_W.z() - graph[b].curve.At(y).p_W.z()) > 2.0) continue;
            ++touches;
            bool held = false;
            for (const ZoneSide& part : zones.Of(a)) {
              const Zone& zone = zones[part.zone];
              if (zone.track[1] != b) continue;
              held = held || (x + half > zone.in_m[0] && x - half < zone.out_m[0] && y + half > zone.in_m[1] &&
                              y - half < zone.out_m[1]);
            }
            ASSERT_TRUE(held) << name << ": tracks " << a << " at " << x << " and " << b << " at " << y;
          }
        }
      }
    }
  }
  EXPECT_GT(touches, 1000u);
}

// On a straight road a car of one direction that would swing out so far that it reaches one of the other direction
// makes a zone with it; not one that swings to the kerb.
TEST(Zones, KnowWhichVehiclesSwingOutToTheirSide) {
  const auto network = opendrive::MustRead(opendrive::Document(opendrive::RoadText().Text()));
  const Graph graph(*network);
  ASSERT_EQ(graph.tracks().size(), 2u);
  const double needs = 3.5 - 0.5 * LargestCar{}.width_m - 0.15;
  for (std::uint32_t a = 0; a < 2; ++a) {
    const auto meet = [&](const Swing& swing) {
      Swings swings(2);
      swings[a].assign(graph[a].curve.nodes().size(), swing);
      return !Zones(graph, {}, swings).zones().empty();
    };
    EXPECT_FALSE(meet({}));
    EXPECT_FALSE(meet({needs - 0.05, needs - 0.05}));
    EXPECT_TRUE(meet({needs + 0.05, 0.0}));  // right-hand traffic: oncoming traffic is on the left
    EXPECT_FALSE(meet({0.0, needs + 0.05}));
  }
}

TEST(Zones, LevelsDoNotMeet) {
  const auto network = MapNetwork("overpass");
  const Graph graph(*network);
  const Zones zones(graph);
  // One way over the other, as seen from above.
  const auto passes_over = [](const Track& over, const Track& under) {
    for (double over_m = 0.0; over_m < over.length_m(); over_m += 1.0) {
      const Eigen::Vector3d p = over.curve.At(over_m).p_W;
      for (double under_m = 0.0; under_m < under.length_m(); under_m += 1.0) {
        const Eigen::Vector3d q = under.curve.At(under_m).p_W;
        if ((p - q).head<2>().norm() < 1.0 && p.z() > q.z() + 3.0) return true;
      }
    }
    return false;
  };
  int crossings = 0;
  for (const Track& under : graph.tracks())
    for (const Track& over : graph.tracks()) crossings += passes_over(over, under) ? 1 : 0;
  EXPECT_GT(crossings, 0);
  ASSERT_FALSE(zones.zones().empty());
  for (const Zone& zone : zones.zones()) {
    const double z0 = graph[zone.track[0]].curve.At(0.5 * (zone.in_m[0] + zone.out_m[0])).p_W.z();
    const double z1 = graph[zone.track[1]].curve.At(0.5 * (zone.in_m[1] + zone.out_m[1])).p_W.z();
    EXPECT_LT(std::fabs(z0 - z1), 3.0);
  }
}

// Ways that come together are told from ways that part where the last or the first of both are sections of a few
// decimetres, which begin and end in one place either way.
TEST(Zones, ShortSectionsAtTheEndOfTwoWaysComeTogetherAndAtTheBeginningPart) {
  for (const double cut_m : {0.1, 0.2, 0.4}) {
    const auto network = ShortSections(cut_m);
    const Graph graph(*network);
    const Zones zones(graph);
    int together = 0, part = 0;
    for (const Zone& zone : zones.zones()) {
      const auto lane = [&](std::size_t side) { return graph[zone.track[side]].lane.lane; };
      const auto road = [&](std::size_t side) { return network->roads()[graph[zone.track[side]].lane.road].id(); };
      if (lane(0) != lane(1) || road(0) != "4" || road(1) != "5")
        continue;  // they come towards one another, or lead there
      const std::string told = road(0) + " and " + road(1) + ", tracks " + std::to_string(zone.track[0]) + " and " +
                               std::to_string(zone.track[1]);
      EXPECT_EQ(zone.kind, lane(0) < 0 ? ZoneKind::kMerge : ZoneKind::kDiverge) << told;
      ++(lane(0) < 0 ? together : part);
    }
    EXPECT_EQ(together, 6) << cut_m;
    EXPECT_EQ(part, 6) << cut_m;
  }
}

// A lane of 6 m that goes on as two of 3 m: their middles lie too far apart for cars that keep to them to touch, but
// cars come there from one middle.
TEST(Zones, TheWaysOnFromALaneThatSplitsPart) {
  const auto lane = [](int id, double width_m, const char* link) {
    return fmt::format(
        "<lane id=\"{}\" type=\"driving\"><link>{}</link><width sOffset=\"0\" a=\"{}\" b=\"0\" c=\"0\" "
        "d=\"0\"/></lane>",
        id, link, width_m);
  };
  opendrive::RoadText road;
  road.left = "";
  road.right = lane(-1, 6.0, "<successor id=\"-1\"/><successor id=\"-2\"/>") +
               "</right></laneSection><laneSection s=\"40\"><center><lane id=\"0\" type=\"none\"/></center><right>" +
               lane(-1, 3.0, "<predecessor id=\"-1\"/>") + lane(-2, 3.0, "<predecessor id=\"-1\"/>");
  const auto network = opendrive::MustRead(opendrive::Document(road.Text()));
  const Graph graph(*network);
  ASSERT_EQ(graph.tracks().size(), 3u);
  const Zones zones(graph);
  ASSERT_EQ(zones.zones().size(), 1u);
  const Zone& zone = zones[0];
  EXPECT_EQ(zone.kind, ZoneKind::kDiverge);
  for (const std::size_t side : {0u, 1u}) {
    EXPECT_EQ(graph[zone.track[side]].lane.section, 1u);
    EXPECT_EQ(zone.in_m[side], 0.0);
    EXPECT_GT(zone.out_m[side], 30.0);  // 1.5 m aside at 0.8 m/s and 50 km/h
  }
}

// A way with a STOP sign yields to one without.
TEST(Zones, AWayWithAStopIsNotFirst) {
  const auto network = MapNetwork("crossing");
  const Graph graph(*network);
  const Zones zones(graph);
  int one_has = 0;
  for (const Zone& zone : zones.zones()) {
    ASSERT_TRUE(zone.first == 0 || zone.first == 1);
    if (zone.kind == ZoneKind::kDiverge) continue;
    const auto stops = [&](std::size_t side) {
      return SignFor(graph, zone.track[side], zone.in_m[side]) == Sign::kStop;
    };
    if (stops(0) == stops(1)) continue;
    ++one_has;
    EXPECT_TRUE(zone.signed_);
    EXPECT_EQ(zone.first, stops(0) ? 1 : 0) << "tracks " << zone.track[0] << " and " << zone.track[1];
  }
  EXPECT_GT(one_has, 10);
}

}  // namespace
}  // namespace rodeira::lanes
