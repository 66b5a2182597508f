// SPDX-License-Identifier: Apache-2.0
// Roads that cross and meet: what is cut, joined, made level, painted.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "common/core/base/random.hpp"
#include "common/core/geometry/angle.hpp"
#include "tests/common/world/design/made_roads.hpp"
#include "tests/names.hpp"

namespace rodeira::design {
namespace {

using network::End;
using testing::HasSubstr;

// A crossing on a slope in a bend, and a road that ends at the main one farther on.
constexpr const char* kRoads = R"(rodeira: world/2
roads:
  - id: main
    start: {x_m: 0, y_m: 0, heading_deg: 20}
    axis:
      - line: {length_m: 200}
      - clothoid: {a_m: 120, radius_end_m: 240}
      - arc: {length_m: 260, radius_m: 240}
    vertical: [{s_m: 0, z_m: 50}, {s_m: 200, z_m: 58, parabola_m: 120}, {s_m: 520, z_m: 49}]
    section: {template: rural}
    speed_limit_kmh: 90
  - id: cross
    place: {road: main, s_m: 130, turn_deg: 70, own_s_m: 120}
    axis: [line: {length_m: 260}]
    vertical: [{s_m: 0, z_m: 54}, {s_m: 260, z_m: 56}]
    section: {template: rural, lanes: [{id: -1, width_m: 2.75}, {id: 1, width_m: 3}]}
  - id: end
    place: {road: main, s_m: 400, turn_deg: -95}
    axis: [line: {length_m: 150}]
    section: {template: rural}
junctions:
  - {id: j1, roads: [{road: main, s_m: 130}, {road: cross, s_m: 120}], control: stop}
  - {id: j2, roads: [{road: main, s_m: 400}, {road: end, end: start}]}
)";

const Design& Made() {
  static const Design design = SoundDesign(kRoads);
  return design;
}

const network::Road& RoadOf(std::string_view id) {
  const auto found = Made().network->FindRoad(id);
  EXPECT_TRUE(found.has_value()) << id;
  return Made().network->roads()[found.value_or(0)];
}

TEST(Junction, RoadsAreCutAndJoined) {
  const network::Network& network = *Made().network;
  ASSERT_EQ(network.junctions().size(), 2u);
  std::set<std::string> ids;
  for (const network::Road& road : network.roads()) ids.insert(road.id());
  for (const char* id : {"main/1", "main/2", "main/3", "cross/1", "cross/2", "end/1", "j1/main", "j1/cross", "j2/main"})
    EXPECT_TRUE(ids.contains(id)) << id;
  // Two roads cross: from each of four arms two turns and straight on. One ends: from its arm two, to it two.
  EXPECT_EQ(network.junctions()[0].connections.size(), 12u);
  EXPECT_EQ(network.junctions()[1].connections.size(), 6u);
  for (const char* id : {"main/1", "main/2", "cross/1"}) {
    const network::LaneKey lane{*network.FindRoad(id), 0, -1};
    EXPECT_EQ(network.Successors(lane).size(), std::string_view(id) == "main/2" ? 2u : 3u) << id;
  }
  EXPECT_EQ(network.Successors({*network.FindRoad("end/1"), 0, 1}).size(), 2u);
}

// Along the lanes there is no step and no kink at any of their joints.
TEST(Junction, LanesGoOnWithoutAStep) {
  const network::Network& network = *Made().network;
  int joints = 0;
  for (const network::LaneKey& key : network.Lanes()) {
    if (!network::IsDrivable(network.Find(key)->type)) continue;
    for (const End end : {End::kStart, End::kEnd}) {
      const network::Road& road = network.roads()[key.road];
      for (const network::LaneEnd& next : end == End::kStart ? network.AtStart(key) : network.AtEnd(key)) {
        ++joints;
        const network::Road& other = network.roads()[next.lane.road];
        const double s = end == End::kStart ? 0.0 : road.length_m(),
                     other_s = next.end == End::kStart ? 0.0 : other.length_m();
        for (const bool outer : {false, true}) {
          const auto span = *network.Span(key, s), beyond = *network.Span(next.lane, other_s);
          const auto at = [](const network::Road& r, double where, double t) { return r.Surface(where, t).p_W; };
          const Eigen::Vector3d p = at(road, s, outer ? span.outer_t_m : span.inner_t_m);
          const Eigen::Vector3d a = at(other, other_s, beyond.inner_t_m), b = at(other, other_s, beyond.outer_t_m);
          EXPECT_LT(std::min((p - a).norm(), (p - b).norm()), 1e-3) << road.id() << " to " << other.id();
        }
        const double turn = road.axis().Evaluate(s).heading_rad - other.axis().Evaluate(other_s).heading_rad;
        const double along = (end == next.end) ? geometry::kPi : 0.0;
        EXPECT_NEAR(std::remainder(turn - along, 2.0 * geometry::kPi), 0.0, 1e-6) << road.id() << " to " << other.id();
      }
    }
  }
  EXPECT_GT(joints, 60);
}

// The ways through lie on the one surface, as well as cubics along a way and across its lanes can follow it
// (docs/explanation/ground.md says how far off they are; SUELO answers by the surface itself).
TEST(Junction, WaysLieOnTheSurface) {
  const network::Network& network = *Made().network;
  const auto is_way = [](const network::Road& road) { return !road.spec().junction.empty(); };
  ASSERT_TRUE(std::ranges::any_of(network.roads(), is_way));
  for (const network::Road& way : network.roads()) {
    if (!is_way(way)) continue;
    const JunctionSurface& surface = *Made().junctions[way.spec().junction == "j1" ? 0 : 1];
    for (std::uint64_t i = 0; i < 400; ++i) {
      const double s = base::RandomUniform({i, 1}, 0.0, way.length_m());
      const auto& lanes = way.spec().sections[0];
      const network::Lane& lane = lanes.left.empty() || i % 2 == 0 ? lanes.right[0] : lanes.left[0];
      const auto span = *lanes.Span(lane.id, way.CentreAt(s), s);
      const double t = base::RandomUniform({i, 2}, std::min(span.inner_t_m, span.outer_t_m),
                                           std::max(span.inner_t_m, span.outer_t_m));
      const Eigen::Vector3d p = way.Surface(s, t).p_W;
      EXPECT_NEAR(p.z(), surface.At(p.head<2>()).z_m, 0.01) << way.id() << " " << s << " " << t;
      EXPECT_TRUE(surface.Contains(p.head<2>()) || s < 0.01 || s > way.length_m() - 0.01)
          << way.id() << " " << s << " " << t;
    }
  }
}

// At a road's end the junction has that road's height and slope; its slopes are the derivatives of its heights.
TEST(Junction, TheSurfaceIsEachRoadAtItsEnd) {
  const JunctionSurface& surface = *Made().junctions[0];
  for (const char* id : {"main/1", "main/2", "cross/1", "cross/2"}) {
    const network::Road& road = RoadOf(id);
    const bool ends = std::string_view(id).back() == '1';
    for (double t = -4.9; t < 4.9; t += 0.0637) {
      const Eigen::Vector3d p = road.Surface(ends ? road.length_m() : 0.0, t).p_W;
      const Eigen::Vector2d inward = (ends ? 1.0 : -1.0) * road.axis().Evaluate(ends ? road.length_m() : 0.0).tangent_W;
      EXPECT_NEAR(surface.At(p.head<2>()).z_m, p.z(), 1e-9) << id << " " << t;
      EXPECT_NEAR(surface.At(p.head<2>() + 1e-6 * inward).z_m, p.z(), 1e-6) << id << " " << t;
    }
  }
  const double h = 1e-5;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const Eigen::Vector2d p(base::RandomUniform({i, 3}, surface.low_W().x(), surface.high_W().x()),
                            base::RandomUniform({i, 4}, surface.low_W().y(), surface.high_W().y()));
    if (!surface.Contains(p)) continue;
    const auto z = [&](double dx, double dy) { return surface.At(p + Eigen::Vector2d(dx, dy)).z_m; };
    const JunctionHeight at = surface.At(p);
    if (std::fabs(z(h, 0) + z(-h, 0) - 2.0 * at.z_m) + std::fabs(z(0, h) + z(0, -h) - 2.0 * at.z_m) > 1e-8)
      continue;  // on a crown
    EXPECT_NEAR(at.slope_x, (z(h, 0) - z(-h, 0)) / (2.0 * h), 1e-5);
    EXPECT_NEAR(at.slope_y, (z(0, h) - z(0, -h)) / (2.0 * h), 1e-5);
  }
}

TEST(Junction, MinorRoadsComeToTheMainOnesHeight) {
  const network::Road& way = RoadOf("j1/main");
  const double middle = way.spec().elevation.Value(0.5 * way.length_m());
  EXPECT_NEAR(middle, 50.0 + 130.0 * 0.04, 0.12);  // its own grade, less what the other roads' crowns take
  EXPECT_NEAR(RoadOf("cross/1").spec().elevation.Value(0.0), 54.0, 1e-9);  // 60 m away nothing changes
}

TEST(Junction, HasStopLinesAndSigns) {
  const auto signs = [&](const char* id) {
    std::multiset<std::string> names;
    for (const network::Signal& signal : RoadOf(id).spec().signals) names.insert(signal.name + signal.orientation);
    return names;
  };
  EXPECT_EQ(signs("cross/1"), (std::multiset<std::string>{"stop+"}));
  EXPECT_EQ(signs("cross/2"), (std::multiset<std::string>{"stop-"}));
  EXPECT_EQ(signs("end/1"), (std::multiset<std::string>{"give_way-"}));
  EXPECT_EQ(signs("main/2"), (std::multiset<std::string>{"priority-", "priority+"}));
  const network::Road& stopping = RoadOf("cross/1");
  int bars = 0;
  for (const network::PaintedLine& line : stopping.spec().lines) {
    if (line.width_m > 2.0) {
      ++bars;
      EXPECT_GT(line.from_s_m, stopping.length_m() - 1.0);
      EXPECT_LT(line.t.Value(line.from_s_m), 0.0);  // on the right
    }
  }
  EXPECT_EQ(bars, 1);
  for (const network::JunctionPriority& priority : Made().network->junctions()[0].priorities) {
    EXPECT_THAT(priority.high, HasSubstr("main"));
  }
}

// Lights before all four arms, a group a road; stop lines, and no signs.
TEST(Junction, HasLightsWithTheirTimes) {
  std::string text = kRoads;
  const std::string stop = "control: stop}";
  text.replace(text.find(stop), stop.size(),
               "control: lights, lights: {phases: [{green: [main], for_s: 25}, {green: [cross], for_s: 20}]}}");
  const Design design = SoundDesign(text);
  const network::Network& network = *design.network;
  ASSERT_EQ(network.controllers().size(), 2u);
  const auto& main = network.controllers()[0];
  const auto& cross = network.controllers()[1];
  EXPECT_EQ(network.junctions()[0].controllers, (std::vector<std::string>{"j1-main", "j1-cross"}));
  ASSERT_TRUE(main.times && cross.times);
  EXPECT_DOUBLE_EQ(main.times->cycle_s, 55.0);
  EXPECT_DOUBLE_EQ(main.times->green_from_s, 0.0);
  EXPECT_DOUBLE_EQ(main.times->green_s, 25.0);
  EXPECT_DOUBLE_EQ(cross.times->green_from_s, 30.0);
  EXPECT_DOUBLE_EQ(cross.times->green_s, 20.0);
  for (const auto* controller : {&main, &cross}) {
    ASSERT_EQ(controller->controls.size(), 2u);
    for (const auto& entry : controller->controls) {
      int found = 0;
      for (const network::Road& road : network.roads()) {
        for (const network::Signal& signal : road.spec().signals) {
          if (signal.id != entry.signal_id) continue;
          ++found;
          EXPECT_TRUE(signal.dynamic);
          EXPECT_EQ(signal.type, "1000001");
          const bool starts = signal.s_m < 0.5 * road.length_m();  // the end at the junction: traffic comes against s
          EXPECT_EQ(signal.orientation, starts ? "-" : "+");
          EXPECT_EQ(signal.t_m < 0.0, !starts) << "on the right of those who come";
        }
      }
      EXPECT_EQ(found, 1) << entry.signal_id;
    }
  }
  int parts = 0;
  for (const network::Road& road : network.roads()) {
    if (road.id() != "main/1" && road.id() != "cross/1") continue;
    ++parts;
    EXPECT_TRUE(std::all_of(road.spec().signals.begin(), road.spec().signals.end(),
                            [](const auto& signal) { return signal.dynamic; }));
  }
  EXPECT_EQ(parts, 2);
  const auto told = [&](const std::string& phases) {
    std::string wrong = kRoads;
    wrong.replace(wrong.find(stop), stop.size(), "control: lights, lights: {phases: " + phases + "}}");
    return FirstProblem(wrong);
  };
  EXPECT_THAT(told("[{green: [main], for_s: 9}]"), HasSubstr("road 'cross' is green in no phase of junction 'j1'"));
  EXPECT_THAT(told("[{green: [main], for_s: 9}, {green: [cros], for_s: 9}]"),
              HasSubstr("no road 'cros' meets junction 'j1'"));
  EXPECT_THAT(told("[{green: [main], for_s: 9}, {green: [cross]}]"), HasSubstr("for_s"));
}

TEST(Junction, WhatDoesNotMeetIsTold) {
  const std::string text = kRoads;
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    changed.replace(changed.find(from), from.size(), to);
    return FirstProblem(changed);
  };
  EXPECT_THAT(with("{road: cross, s_m: 120}]", "{road: cross, s_m: 150}]"),
              HasSubstr("road 'cross' is 30.00 m away from road 'main' there"));
  EXPECT_THAT(with("turn_deg: -95", "turn_deg: -20"),
              HasSubstr("at an angle of 20.0 degrees; at least 34.4 was expected"));
  EXPECT_THAT(with("axis: [line: {length_m: 150}]", "axis: [line: {length_m: 15}]"),
              HasSubstr("junction 'j2' reaches from"));
  EXPECT_THAT(with("{road: end, end: start}", "{road: ent, end: start}"), Names("road 'ent' … 'end'"));
}

// Five roads that all begin at one junction, 20 m of which lie in it or so: no start is given, so it is 10 m
// behind the junction.
std::string FiveRoads(const std::string& start) {
  std::string text = "rodeira: world/2\n" + start + "roads:\n", meetings;
  for (int i = 0; i < 5; ++i) {
    text += "  - {id: r" + std::to_string(i) + ", start: {x_m: 0, y_m: 0, heading_deg: " + std::to_string(72 * i) +
            "}, axis: [line: {length_m: 80}], z_m: 0, section: {template: rural}}\n";
    meetings += (i == 0 ? "" : ", ") + std::string("{road: r") + std::to_string(i) + ", end: start}";
  }
  return text + "junctions:\n  - {id: j, roads: [" + meetings + "]}\n";
}

TEST(Start, LiesOutsideOfJunctionsUnlessItIsSaid) {
  const auto text_of = [](const std::string& start) {
    const auto file = config::File::Parse(FiveRoads(start), "made.yaml");
    EXPECT_TRUE(file.ok());
    (void)file.value().root().Text("rodeira");
    const config::Map map = file.value().root().OptionalChild("start");
    StartSpec start_spec;
    if (map.Has("s_m")) start_spec.s_m = map.Number("s_m");
    Design design = ReadDesign(file.value(), kFriction, "made", "", start_spec, map);
    return std::pair(std::move(design), file.value().Problems());
  };
  const auto [design, problems] = text_of("");
  for (const auto& problem : problems) ADD_FAILURE() << problem.Text();
  ASSERT_TRUE(design.start.has_value());
  const network::Road& road = design.network->roads()[design.start->road];
  EXPECT_EQ(road.id(), "r0/1");
  EXPECT_EQ(design.start->lane, -1);
  EXPECT_DOUBLE_EQ(design.start->s_m, 10.0);
  const double behind = 80.0 - road.length_m() + 10.0;  // on the road before it was cut
  EXPECT_GT(behind, 20.0);
  const auto [refused, told] = text_of("start: {s_m: 10}\n");
  ASSERT_EQ(told.size(), 1u);
  EXPECT_THAT(told[0].Text(),
              HasSubstr(fmt::format("'start.s_m' 10 of road 'r0' lies in a junction; {:.1f} is behind it", behind)));
}

}  // namespace
}  // namespace rodeira::design
