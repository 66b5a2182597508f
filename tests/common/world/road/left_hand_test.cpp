// SPDX-License-Identifier: Apache-2.0
// Worlds with vehicles that keep left: the mirror image of worlds with vehicles that keep right, in everything. And
// what the known templates give.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "common/core/base/random.hpp"
#include "common/world/network/placing.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::road {
namespace {

std::shared_ptr<const World> MustParse(const std::string& text) {
  const auto world = World::Parse(text, "made.yaml");
  EXPECT_TRUE(world.ok()) << world.error().Text();
  return world.ok() ? world.value() : nullptr;
}

// A road on a slope with a bend, a lane more on one side, a pavement behind a kerb, paint, signs; a narrower one that
// crosses and must stop. side: 1 as it is, -1 its image in the x axis, where left is right.
std::string Text(int side) {
  const auto lane = [side](int id) { return side * id; };
  const std::string own = side > 0 ? "right" : "left", other = side > 0 ? "left" : "right";
  return fmt::format(
      "rodeira: world/2\nname: sides\nrule: {own}\nground: {{kind: plane, z_m: 4, slope_x: 0.01, slope_y: "
      "{slope}}}\nstart: {{road: main, lane: {l1}, s_m: 20}}\n"
      "roads:\n"
      "  - id: main\n    start: {{x_m: 0, y_m: 0, heading_deg: {h20}}}\n"
      "    axis: [line: {{length_m: 150}}, clothoid: {{length_m: 60, radius_end_m: {r200}}}, arc: {{length_m: 120, "
      "radius_m: {r200}}}]\n"
      "    vertical: [{{s_m: 0, z_m: 5}}, {{s_m: 200, z_m: 9, parabola_m: 80}}, {{s_m: 330, z_m: 6}}]\n"
      "    superelevation: [{{s_m: 190, slope: 0}}, {{s_m: 240, slope: {bank}}}]\n"
      "    section:\n"
      "      lanes: [{{id: {l2}, width_m: 3.25}}, {{id: {l1}, width_m: 3.5}}, {{id: {r1}, width_m: 3.75}}, {{id: {r2}, "
      "width_m: 2, type: sidewalk, kerb_m: 0.12, material: concrete}}]\n"
      "      crossfall: {{kind: crown, fall: 0.025}}\n      shoulders: {{{own}: {{width_m: 1, fall: 0.04, material: "
      "gravel}}, {other}: {{width_m: 0.5, fall: 0.02}}}}\n"
      "      verge: {{width_m: 1.5, fall: 0.08}}\n"
      "    lines:\n      - {{lane: 0, kind: mixed, {own}: dashed, {other}: continuous, stroke_m: 4, gap_m: 8, width_m: "
      "0.12, apart_m: 0.14}}\n"
      "      - {{lane: {l1}, kind: dashed, stroke_m: 3, gap_m: 6, width_m: 0.12}}\n      - {{lane: {r1}, kind: "
      "continuous, width_m: 0.15}}\n"
      "    markings: [{{type: crossing, s_m: 60}}, {{type: stop_line, s_m: 260, for: along}}]\n"
      "    signs: [{{type: bend_{other}, s_m: 100, side: {own}}}, {{type: speed_limit, value: 70, s_m: 30, side: "
      "{own}}}]\n"
      "  - id: cross\n    place: {{road: main, s_m: 110, turn_deg: {h80}, own_s_m: 70}}\n    axis: [line: {{length_m: "
      "150}}]\n"
      "    section: {{template: rural, lanes: [{{id: {l1}, width_m: 2.75}}, {{id: {r1}, width_m: 3}}]}}\n"
      "junctions:\n  - {{id: j, roads: [{{road: main, s_m: 110}}, {{road: cross, s_m: 70}}], control: stop}}\n",
      fmt::arg("own", own), fmt::arg("other", other), fmt::arg("slope", side * 0.015), fmt::arg("l1", lane(-1)),
      fmt::arg("l2", lane(-2)), fmt::arg("r1", lane(1)), fmt::arg("r2", lane(2)), fmt::arg("h20", side * 20),
      fmt::arg("h80", side * 80), fmt::arg("r200", side * 200), fmt::arg("bank", side * 0.04));
}

struct Sides : testing::Test {
  std::shared_ptr<const World> right = MustParse(Text(1)), left = MustParse(Text(-1));
};

Eigen::Vector3d Mirrored(const Eigen::Vector3d& v) { return {v.x(), -v.y(), v.z()}; }

TEST_F(Sides, TheGroundIsTheMirrorImage) {
  int road = 0, paint = 0;
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    const double s = base::RandomUniform({i, 1}, 0.0, 1.0);
    const network::Road& main = right->network()->roads()[i % right->network()->roads().size()];
    const Eigen::Vector3d p = main.Surface(s * main.length_m(), i % 3 == 0 ? base::RandomUniform({i, 2}, -0.2, 0.2)
                                                                           : base::RandomUniform({i, 2}, -9.0, 9.0))
                                  .p_W;  // where its line is, too
    const SurfacePoint a = right->At(p.x(), p.y()), b = left->At(p.x(), -p.y());
    ASSERT_EQ(a.inside, b.inside) << i;
    EXPECT_NEAR(a.z_m, b.z_m, 1e-7) << p.transpose();
    EXPECT_NEAR(a.slope_x, b.slope_x, 1e-6) << p.transpose();
    EXPECT_NEAR(a.slope_y, -b.slope_y, 1e-6) << p.transpose();
    EXPECT_EQ(a.surface, b.surface) << p.transpose();
    EXPECT_EQ(a.friction, b.friction) << p.transpose();
    road += a.surface == ground::Surface::kAsphalt, paint += a.surface == ground::Surface::kRoadMark;
  }
  EXPECT_GT(road, 5000);
  EXPECT_GT(paint, 300);
}

// Where a lane's traffic goes at its middle, and with it the lane's type, ways on, limits.
TEST_F(Sides, EachLaneIsDrivenInTheMirroredDirection) {
  const network::Network &a = *right->network(), &b = *left->network();
  int driven = 0;
  for (const network::LaneKey& key : a.Lanes()) {
    const network::Lane& lane = *a.Find(key);
    const network::Road& road = a.roads()[key.road];
    const double s = 0.5 * road.length_m();
    const auto span = a.Span(key, s);
    ASSERT_TRUE(span);
    const auto other = b.FindRoad(road.id());
    ASSERT_TRUE(other || road.spec().junction == "j") << road.id();
    if (!other) continue;
    // Of a way through a junction the one lane is a right one in both worlds.
    const network::LaneKey image{*other, key.section,
                                 b.Find({*other, key.section, -key.lane}) == nullptr ? key.lane : -key.lane};
    const network::Lane* found = b.Find(image);
    ASSERT_NE(found, nullptr) << road.id() << " " << key.lane;
    EXPECT_EQ(found->direction, lane.direction) << road.id() << " " << key.lane;
    EXPECT_EQ(found->type, lane.type);
    EXPECT_EQ(b.Successors(image).size(), a.Successors(key).size()) << road.id() << " " << key.lane;
    EXPECT_EQ(b.Predecessors(image).size(), a.Predecessors(key).size()) << road.id() << " " << key.lane;
    // A way's lane is measured along its other edge there: its ends are the same.
    const bool way = road.spec().junction == "j";
    EXPECT_NEAR((b.Centre(image, way ? 0.0 : s) - Mirrored(a.Centre(key, way ? 0.0 : s))).norm(), 0.0, 1e-7)
        << road.id() << " " << key.lane;
    const double end = b.roads()[*other].length_m();
    EXPECT_NEAR((b.Centre(image, end) - Mirrored(a.Centre(key, road.length_m()))).norm(), 0.0, 1e-7)
        << road.id() << " " << key.lane;
    driven += network::IsDrivable(lane.type);
  }
  EXPECT_GE(driven, 12);
  const network::LaneKey first{*a.FindRoad("main/1"), 0, -1}, image{*b.FindRoad("main/1"), 0, 1};
  EXPECT_EQ(a.Find(first)->direction, 1);
  EXPECT_EQ(b.Find(image)->direction, 1) << "whoever keeps left goes along s on the left";
  EXPECT_TRUE(b.roads()[*b.FindRoad("main/1")].spec().left_hand);
}

TEST_F(Sides, SignsStandOnTheOtherSideAndTheCarStartsThere) {
  using Post = std::tuple<std::string, long, long, long, long>;
  const auto posts = [](const World& world, double side) {
    std::vector<Post> found;
    for (const network::Placed& placed : network::PlaceFurniture(*world.network()).things) {
      if (placed.signal == nullptr) continue;
      const double heading = side * placed.heading_rad;
      found.emplace_back(placed.signal->type, std::lround(placed.foot_W.x() * 1e4),
                         std::lround(side * placed.foot_W.y() * 1e4), std::lround(std::cos(heading) * 1e4),
                         std::lround(std::sin(heading) * 1e4));
    }
    std::sort(found.begin(), found.end());
    return found;
  };
  auto here = posts(*right, 1.0), there = posts(*left, -1.0);
  for (auto* all : {&here, &there}) {  // the bend's sign is another one, as it must be
    for (auto& [type, x, y, c, s] : *all) type = type == "103" ? "bend" : type;
    std::sort(all->begin(), all->end());
  }
  EXPECT_GE(here.size(), 4u);  // two by hand, two stops
  EXPECT_EQ(here, there);
  EXPECT_NEAR(left->start().x_m, right->start().x_m, 1e-9);
  EXPECT_NEAR(left->start().y_m, -right->start().y_m, 1e-9);
  EXPECT_NEAR(left->start().heading_rad, -right->start().heading_rad, 1e-9);
}

// What docs/reference/world-roads.md says of them: how many lanes, how wide all of it is, which way it is driven, and
// which lines may be crossed.
TEST(Templates, AreRoadsOfTheirKind) {
  struct Kind {
    const char* name;
    int right, left;
    double right_m, left_m;  // how far what is paved reaches: lanes and shoulders
    double middle_fall_m;    // how much higher the axis is than 2 m to its right
  };
  for (const Kind& kind : {Kind{"rural", 1, 1, 4.25, 4.25, 0.05}, Kind{"bypass", 2, 1, 8.5, 5.0, 0.05},
                           Kind{"motorway", 2, 0, 10.5, 1.0, 0.05}}) {
    const auto world =
        MustParse(fmt::format("rodeira: world/2\nname: t\nground: {{kind: plane, z_m: 0}}\nroads:\n  - {{id: a, start: "
                              "{{x_m: 0, y_m: 0}}, axis: [line: {{length_m: 200}}], z_m: 1, section: "
                              "{{template: {}}}}}\n",
                              kind.name));
    ASSERT_NE(world, nullptr);
    const network::LaneSection& section = world->network()->roads()[0].spec().sections[0];
    const auto driven = [](const std::vector<network::Lane>& lanes) {
      return std::count_if(lanes.begin(), lanes.end(),
                           [](const network::Lane& lane) { return network::IsDrivable(lane.type); });
    };
    EXPECT_EQ(driven(section.right), kind.right) << kind.name;
    EXPECT_EQ(driven(section.left), kind.left) << kind.name;
    for (const network::Lane& lane : section.right) EXPECT_EQ(lane.direction, 1) << kind.name;
    for (const network::Lane& lane : section.left) EXPECT_EQ(lane.direction, -1) << kind.name;
    const auto paved = [&](double y) {
      const ground::Surface surface = world->At(100.0, y).surface;
      return surface == ground::Surface::kAsphalt || surface == ground::Surface::kRoadMark;
    };
    EXPECT_TRUE(paved(-kind.right_m + 0.01)) << kind.name;
    EXPECT_EQ(world->At(100.0, -kind.right_m - 0.01).surface, ground::Surface::kGrass) << kind.name;
    EXPECT_TRUE(paved(kind.left_m - 0.01)) << kind.name;
    EXPECT_EQ(world->At(100.0, kind.left_m + 0.01).surface, ground::Surface::kGrass) << kind.name;
    EXPECT_NEAR(world->At(100.0, 0.0).z_m - world->At(100.0, -2.0).z_m, kind.middle_fall_m, 1e-9) << kind.name;
    EXPECT_FALSE(world->network()->roads()[0].spec().lines.empty()) << kind.name;
  }
}

}  // namespace
}  // namespace rodeira::road
