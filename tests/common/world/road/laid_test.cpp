// SPDX-License-Identifier: Apache-2.0
// Patches and bumps on a road, under SUELO: against their closed forms.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "common/core/base/files.hpp"
#include "common/core/base/random.hpp"
#include "common/world/road/world_export.hpp"
#include "common/world/road/world_report.hpp"
#include "tests/common/world/road/sample_world.hpp"

namespace rodeira::road {
namespace {

using testing::HasSubstr;

// A level road to the east with lanes of 3.5 m, its axis at y = 0, and shoulders and verges beside them.
std::string Straight(const std::string& laid) {
  return "rodeira: world/2\nname: laid\nground: {kind: plane, z_m: 5}\nmaterials:\n  mud: {surface: soil, friction: "
         "0.4}\n"
         "roads:\n  - id: main\n    start: {x_m: 0, y_m: 0, heading_deg: 0}\n    axis: [line: {length_m: 200}]\n    "
         "z_m: 5\n"
         "    section: {lanes: [{id: -1, width_m: 3.5}, {id: 1, width_m: 3.5}], crossfall: {kind: crown, fall: 0},\n"
         "      shoulders: {left: {width_m: 1, fall: 0}, right: {width_m: 1, fall: 0}}, verge: {width_m: 1, fall: "
         "0}}\n" +
         laid;
}

double Ease(double u) { return u <= 0.0 ? 0.0 : u >= 1.0 ? 1.0 : u * u * (3.0 - 2.0 * u); }

TEST(Laid, APatchOfIceIsWhereItIsSaid) {
  const auto world = MustParse(
      Straight("    patches:\n      - {from_s_m: 40, to_s_m: 70, from_t_m: -3, to_t_m: -0.5, friction: 0.12}\n"
               "      - {from_s_m: 60, to_s_m: 90, from_t_m: -2, to_t_m: 3, material: mud}\n"
               "      - {from_s_m: 100, to_s_m: 110, friction: 0.3}\n"));
  int iced = 0;
  for (std::uint64_t i = 0; i < 30'000; ++i) {
    const double x = base::RandomUniform({i, 1}, 20.0, 130.0), y = base::RandomUniform({i, 2}, -4.4, 4.4);
    const bool ice = x >= 40.0 && x <= 70.0 && y >= -3.0 && y <= -0.5,
               mud = x >= 60.0 && x <= 90.0 && y >= -2.0 && y <= 3.0;
    const bool across = x >= 100.0 && x <= 110.0 && std::fabs(y) <= 3.5;  // all lanes that are driven on
    const SurfacePoint at = world->At(x, y);
    EXPECT_EQ(at.friction, mud ? 0.4 : ice ? 0.12 : across ? 0.3 : 1.0) << x << " " << y;
    EXPECT_EQ(at.surface, mud ? ground::Surface::kSoil : ground::Surface::kAsphalt) << x << " " << y;
    EXPECT_NEAR(at.z_m, 5.0, 1e-12);
    iced += ice && !mud;
  }
  EXPECT_GT(iced, 1000);
}

TEST(Laid, APatchCoversPaint) {
  const std::string lines = "    lines: [{lane: 0, kind: continuous, width_m: 0.2}]\n";
  const auto world = MustParse(Straight(
      lines + "    patches: [{from_s_m: 50, to_s_m: 60, friction: 0.1}, {from_s_m: 70, to_s_m: 80, material: mud}]\n"));
  EXPECT_EQ(world->At(45.0, 0.0).surface, ground::Surface::kRoadMark);
  EXPECT_EQ(world->At(55.0, 0.0).friction, 0.1);
  EXPECT_EQ(world->At(55.0, 0.0).surface, ground::Surface::kRoadMark);  // under the ice
  EXPECT_EQ(world->At(75.0, 0.0).surface, ground::Surface::kSoil);
}

// Three kinds of profile, each with its formula.
TEST(Laid, BumpsAreTheirClosedForms) {
  const auto world = MustParse(Straight(
      "    bumps:\n      - {from_s_m: 40, to_s_m: 44, from_t_m: -3.5, to_t_m: 3, height_m: 0.1, side_m: 0.5}\n"
      "      - {from_s_m: 60, to_s_m: 63, from_t_m: -3.5, to_t_m: 3, height_m: -0.08, shape: smooth, side_m: 0.5}\n"
      "      - from_s_m: 80\n        to_s_m: 92\n        from_t_m: -3.5\n        to_t_m: 3\n        side_m: 0.5\n"
      "        heights: [{s_m: 0, z_m: 0}, {s_m: 3, z_m: 0.15}, {s_m: 9, z_m: 0.15}, {s_m: 12, z_m: 0}]\n"));
  const auto along = [](double s) {
    if (s > 40.0 && s < 44.0) return 0.1 * (1.0 - std::pow((s - 42.0) / 2.0, 2));
    if (s > 60.0 && s < 63.0) return -0.08 * Ease(s < 61.5 ? (s - 60.0) / 1.5 : (63.0 - s) / 1.5);
    if (s > 80.0 && s < 92.0) return std::min({0.15, 0.05 * (s - 80.0), 0.05 * (92.0 - s)});
    return 0.0;
  };
  const auto height = [&](double x, double y) { return along(x) * Ease((y + 3.5) / 0.5) * Ease((3.0 - y) / 0.5); };
  double highest = 0.0;
  for (std::uint64_t i = 0; i < 30'000; ++i) {
    const double x = base::RandomUniform({i, 3}, 35.0, 95.0), y = base::RandomUniform({i, 4}, -5.0, 5.0);
    const SurfacePoint at = world->At(x, y);
    EXPECT_NEAR(at.z_m, 5.0 + height(x, y), 1e-12) << x << " " << y;
    highest = std::max(highest, at.z_m);
    constexpr double kStep = 1e-6;
    const double kink = std::min({std::fabs(x - 40.0), std::fabs(x - 44.0), std::fabs(x - 80.0), std::fabs(x - 83.0),
                                  std::fabs(x - 89.0), std::fabs(x - 92.0)});
    if (kink < 1e-5) continue;
    EXPECT_NEAR(at.slope_x, (height(x + kStep, y) - height(x - kStep, y)) / (2.0 * kStep), 1e-8) << x << " " << y;
    EXPECT_NEAR(at.slope_y, (height(x, y + kStep) - height(x, y - kStep)) / (2.0 * kStep), 1e-8) << x << " " << y;
  }
  EXPECT_GT(highest, 5.149);
}

// On a bend the stations are those of the axis: the crest of a hump lies along the radius.
TEST(Laid, OnABendTheyFollowTheRoad) {
  const auto world = MustParse(
      "rodeira: world/2\nname: bend\nground: {kind: plane}\nroads:\n  - id: main\n    start: {x_m: 0, y_m: -50, "
      "heading_deg: 0}\n"
      "    axis: [arc: {length_m: 140, radius_m: 50}]\n    section: {template: rural, crossfall: {kind: crown, fall: "
      "0}}\n"
      "    patches: [{from_s_m: 20, to_s_m: 30, from_t_m: 0, to_t_m: 2, friction: 0.2}]\n"
      "    bumps: [{from_s_m: 60, to_s_m: 64, from_t_m: -2, to_t_m: 2, height_m: 0.1}]\n");
  for (std::uint64_t i = 0; i < 5'000; ++i) {
    const double s = base::RandomUniform({i, 5}, 10.0, 80.0), t = base::RandomUniform({i, 6}, -2.5, 2.5);
    const double angle = s / 50.0, r = 50.0 - t;
    const double edge = std::min({std::fabs(s - 20.0), std::fabs(s - 30.0), std::fabs(t), std::fabs(t - 2.0)});
    if (edge < 1e-6) continue;
    const SurfacePoint at = world->At(r * std::sin(angle), -r * std::cos(angle));
    EXPECT_EQ(at.friction == 0.2, s > 20.0 && s < 30.0 && t > 0.0 && t < 2.0) << s << " " << t;
    const double hump = s > 60.0 && s < 64.0 ? 0.1 * (1.0 - std::pow((s - 62.0) / 2.0, 2)) * Ease((t + 2.0) / 0.3) *
                                                   Ease((2.0 - t) / 0.3)
                                             : 0.0;
    EXPECT_NEAR(at.z_m, hump, 1e-9) << s << " " << t;
  }
}

TEST(Laid, APatchOfPointsIsItsPoints) {
  const auto world =
      MustParse(Straight("    patches: [{from_s_m: 50, to_s_m: 60, friction: 0.1}]\n    bumps: [{from_s_m: 80, to_s_m: "
                         "84, height_m: 0.1}]\n"));
  const auto ground = world->MakeGround();
  for (const double x : {30.0, 49.9, 55.0, 60.0, 79.95, 82.0, 90.0}) {
    std::vector<ground::GroundQuery> queries;
    for (int i = 0; i < 400; ++i) queries.push_back({x + 0.01 * (i % 20), -1.5 + 0.01 * (i / 20), 5.2});
    std::vector<ground::GroundPoint> points(queries.size());
    ground->Query(queries, points);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const SurfacePoint alone = world->At(queries[i].x_m, queries[i].y_m, queries[i].z_hint_m);
      EXPECT_EQ(std::bit_cast<std::uint64_t>(points[i].z_m), std::bit_cast<std::uint64_t>(alone.z_m));
      EXPECT_EQ(points[i].friction, alone.friction);
    }
  }
}

TEST(Laid, TheyArePartOfTheContentHash) {
  const auto hash = [](const std::string& laid) { return MustParse(Straight(laid))->content_hash(); };
  const std::string patch = "    patches: [{from_s_m: 50, to_s_m: 60, friction: 0.1}]\n",
                    bump = "    bumps: [{from_s_m: 80, to_s_m: 84, height_m: 0.1}]\n";
  EXPECT_NE(hash(""), hash(patch));
  EXPECT_NE(hash(patch), hash("    patches: [{from_s_m: 50, to_s_m: 60, friction: 0.2}]\n"));
  EXPECT_NE(hash(bump), hash("    bumps: [{from_s_m: 80, to_s_m: 84, height_m: 0.11}]\n"));
  EXPECT_NE(hash(bump), hash("    bumps: [{from_s_m: 80, to_s_m: 84, height_m: 0.1, shape: smooth}]\n"));
  EXPECT_EQ(hash(bump), hash("    bumps: [{height_m: 0.1, to_s_m: 84.0, from_s_m: 80}]   # the same\n"));
}

// A road that a junction cuts keeps what lies beside it; a bump that the junction would cut is refused.
// A crossing at s = 100 of both roads, and one where a third road ends.
const char* const kCrossing =
    "  - id: cross\n    place: {road: main, s_m: 100, turn_deg: 90, own_s_m: 60}\n    axis: [line: {length_m: 120}]\n  "
    "  section: {template: rural}\n%s"
    "junctions:\n  - {id: j, roads: [{road: main, s_m: 100}, {road: cross, s_m: 60}]}\n";
std::string Crossing(const std::string& laid, const std::string& on_cross = "") {
  std::string text = kCrossing;
  text.replace(text.find("%s"), 2, on_cross);
  return Straight(laid + text);
}

TEST(Laid, PatchesGoOnThroughJunctions) {
  const auto bare = MustParse(Crossing(""));
  const auto world = MustParse(Crossing(
      "    patches: [{from_s_m: 60, to_s_m: 180, friction: 0.1}, {from_s_m: 98, to_s_m: 99, material: mud}]\n"));
  for (double x = 60.6; x < 180.0; x += 0.25) {
    for (const double y : {-3.3, -1.0, 0.0, 2.0, 3.3}) {
      const SurfacePoint at = world->At(x, y), before = bare->At(x, y);
      const bool mud = x >= 98.0 && x <= 99.0;
      EXPECT_EQ(at.friction, mud ? 0.4 : 0.1) << x << " " << y;
      if (mud) {
        EXPECT_EQ(at.surface, ground::Surface::kSoil);
      }
      EXPECT_EQ(at.z_m, before.z_m);
    }
  }
  EXPECT_EQ(world->At(55.0, 1.0).friction, 1.0);
  EXPECT_EQ(world->At(100.0, 6.0).friction, bare->At(100.0, 6.0).friction);  // beside its lanes, on the junction
}

// In a junction, and over its mouth: what a bump adds to the bare junction is its closed form, with its slopes.
TEST(Laid, BumpsGoOnThroughJunctions) {
  const std::string before = "    patches: [{from_s_m: 10, to_s_m: 11, friction: 0.5}]\n";
  const auto bare = MustParse(Crossing(before));
  for (const double from : {84.0, 88.0, 92.0, 96.0, 100.0, 104.0, 108.0}) {
    const auto world = MustParse(Crossing(before + "    bumps: [{from_s_m: " + std::to_string(from) + ", to_s_m: " +
                                          std::to_string(from + 5.0) + ", height_m: 0.1, side_m: 0.4}]\n"));
    for (std::uint64_t i = 0; i < 600; ++i) {
      const double x = base::RandomUniform({i, 1}, from - 2.0, from + 7.0), y = base::RandomUniform({i, 2}, -4.4, 4.4);
      const double u = (x - from) / 5.0, along = u < 0.0 || u > 1.0 ? 0.0 : 0.4 * u * (1.0 - u),
                   side = Ease((3.5 - std::fabs(y)) / 0.4);
      const SurfacePoint at = world->At(x, y), flat = bare->At(x, y);
      EXPECT_NEAR(at.z_m - flat.z_m, along * side, 1e-9) << x << " " << y;
      EXPECT_NEAR(at.slope_x - flat.slope_x, u < 0.0 || u > 1.0 ? 0.0 : 0.4 * (1.0 - 2.0 * u) / 5.0 * side, 1e-9)
          << x << " " << y;
    }
  }
}

TEST(Laid, BothRoadsOfACrossingMayHaveThem) {
  const auto world =
      MustParse(Crossing("    patches: [{from_s_m: 95, to_s_m: 105, friction: 0.3}]\n    bumps: [{from_s_m: 96, "
                         "to_s_m: 104, height_m: 0.1}]\n",
                         "    patches: [{from_s_m: 58, to_s_m: 62, friction: 0.2}]\n    bumps: [{from_s_m: 56, to_s_m: "
                         "64, height_m: 0.05}]\n"));
  const auto bare = MustParse(Crossing("    patches: [{from_s_m: 10, to_s_m: 11, friction: 0.5}]\n"));
  EXPECT_EQ(world->At(100.0, 0.0).friction, 0.2);  // the road that stands later in the file lies on top
  EXPECT_EQ(world->At(100.0, 3.0).friction, 0.3);
  EXPECT_NEAR(world->At(100.0, 0.0).z_m - bare->At(100.0, 0.0).z_m, 0.15, 1e-9);
}

TEST(Laid, BumpsThatAJunctionCannotTakeAreRefused) {
  const auto refused = [](const std::string& text) { return World::Parse(text, "w.yaml"); };
  const auto wide =
      refused(Crossing("    bumps: [{from_s_m: 95, to_s_m: 99, from_t_m: -4.5, to_t_m: 4.5, height_m: 0.1}]\n"));
  ASSERT_FALSE(wide.ok());
  EXPECT_THAT(
      wide.error().Text(),
      HasSubstr(
          "the bump from s = 95 to 99 m reaches into a junction; there it was expected on lanes that are driven on"));
  const auto end =
      refused(Straight("  - id: cross\n    place: {road: main, s_m: 100, turn_deg: 90}\n    axis: [line: {length_m: "
                       "60}]\n    section: {template: rural}\n"
                       "    bumps: [{from_s_m: 2, to_s_m: 8, height_m: 0.1}]\n"
                       "junctions:\n  - {id: j, roads: [{road: main, s_m: 100}, {road: cross, end: start}]}\n"));
  ASSERT_FALSE(end.ok());
  EXPECT_THAT(end.error().Text(),
              HasSubstr("the bump from s = 2 to 8 m reaches into a junction at which its road ends"));
}

TEST(Laid, WhatIsWrongIsSaid) {
  const auto error = [](const std::string& laid) { return World::Parse(Straight(laid), "w.yaml").error().Text(); };
  EXPECT_THAT(error("    patches: [{from_s_m: 50, to_s_m: 60}]\n"),
              HasSubstr("another 'material', or has another 'friction'"));
  EXPECT_THAT(error("    patches: [{from_s_m: 60, to_s_m: 50, friction: 0.1}]\n"),
              HasSubstr("'to_s_m' must lie behind 'from_s_m'"));
  EXPECT_THAT(error("    patches: [{from_s_m: 50, to_s_m: 60, to_t_m: 9, friction: 0.1}]\n"),
              HasSubstr("the road reaches from t = -5.50 to 5.50 m only"));
  EXPECT_THAT(error("    bumps: [{from_s_m: 50, to_s_m: 54}]\n"),
              HasSubstr("either one 'height_m' or a list of 'heights'"));
  EXPECT_THAT(error("    bumps: [{from_s_m: 50, to_s_m: 54, heights: [{s_m: 0, z_m: 0}, {s_m: 2, z_m: 0.1}]}]\n"),
              HasSubstr("end at s_m 4"));
  EXPECT_THAT(error("    bumps: [{from_s_m: 50, to_s_m: 54, height_m: 0.1, from_t_m: 0, to_t_m: 0.4}]\n"),
              HasSubstr("narrower than twice its 'side_m'"));
}

// A patch of a world file in OpenDRIVE, and of another one's OpenDRIVE file: along the road, by its outline,
// and repeated; friction is that of the material.
TEST(Laid, PatchesOfOpenDriveHaveTheirFriction) {
  const auto folder = std::filesystem::temp_directory_path() / ("rodeira-laid-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const auto load = [&](const std::string& text) {
    EXPECT_TRUE(base::WriteWhole(folder / "it.xodr", std::string_view(text)).ok());
    auto world = World::Load(folder / "it.xodr");
    EXPECT_TRUE(world.ok()) << world.error().Text();
    return world.value();
  };
  const auto ours =
      MustParse(Straight("    patches:\n      - {from_s_m: 40, to_s_m: 70, from_t_m: -3, to_t_m: -0.5, friction: "
                         "0.12}\n      - {from_s_m: 60, to_s_m: 90, from_t_m: -2, to_t_m: 3, material: mud}\n"));
  const auto again = load(ExportOpenDrive(*ours).value());
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    const double x = base::RandomUniform({i, 1}, 20.0, 130.0), y = base::RandomUniform({i, 2}, -4.4, 4.4);
    EXPECT_EQ(ours->At(x, y).friction, again->At(x, y).friction) << x << " " << y;
    EXPECT_EQ(ours->At(x, y).surface, again->At(x, y).surface) << x << " " << y;
  }
  const auto theirs = load(
      R"(<?xml version="1.0"?><OpenDRIVE><header revMajor="1" revMinor="8"/><road id="1" length="200" junction="-1">
          <planView><geometry s="0" x="0" y="0" hdg="0" length="200"><line/></geometry></planView>
    <lanes><laneSection s="0"><left><lane id="1" type="driving"><width sOffset="0" a="5" b="0" c="0" d="0"/></lane>
      </left><center><lane id="0"/></center><right><lane id="-1" type="driving">
      <width sOffset="0" a="5" b="0" c="0" d="0"/></lane></right></laneSection></lanes>
    <objects><object id="a" type="patch" s="20" t="1" length="4" width="2"><material surface="gravel" friction="0.6"/>
      </object>
    <object id="b" type="patch" s="50" t="-2" hdg="1.5707963267948966"><outlines><outline id="0">
      <cornerLocal u="-1" v="-3" z="0" height="0"/><cornerLocal u="1" v="-3" z="0" height="0"/>
      <cornerLocal u="1" v="3" z="0" height="0"/><cornerLocal u="-1" v="3" z="0" height="0"/></outline></outlines>
      <material friction="0.3"/></object>
    <object id="c" type="patch" s="100" t="0" length="2" width="2">
      <repeat s="100" length="30" distance="10" tStart="0" tEnd="3"/><material friction="0.2"/></object>
    <object id="d" type="patch" s="160" t="0" length="2" width="2"/>
      <object id="e" type="obstacle" s="170" t="0" length="2" width="2"><material friction="0.1"/></object></objects>
      </road></OpenDRIVE>)");
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    const double x = base::RandomUniform({i, 3}, 1.0, 199.0), y = base::RandomUniform({i, 4}, -4.9, 4.9);
    double expected = 1.0;
    if (std::fabs(x - 20.0) <= 2.0 && std::fabs(y - 1.0) <= 1.0) expected = 0.6;
    if (std::fabs(x - 50.0) <= 3.0 && std::fabs(y + 2.0) <= 1.0) expected = 0.3;
    for (double k = 0.0; k < 4.0; k += 1.0) {
      if (std::fabs(x - 100.0 - 10.0 * k) <= 1.0 && std::fabs(y - k) <= 1.0) expected = 0.2;
    }
    const SurfacePoint at = theirs->At(x, y);
    EXPECT_EQ(at.friction, expected) << x << " " << y;
    EXPECT_EQ(at.surface, expected == 0.6 ? ground::Surface::kGravel : ground::Surface::kAsphalt);
  }
  std::filesystem::remove_all(folder);
}

TEST(Laid, OpenDriveNamesThem) {
  const auto text =
      ExportOpenDrive(*MustParse(Straight("    patches: [{from_s_m: 50, to_s_m: 60, friction: 0.1}]\n    bumps: "
                                          "[{from_s_m: 80, to_s_m: 84, height_m: 0.1}]\n")));
  ASSERT_TRUE(text.ok());
  EXPECT_THAT(text.value(), HasSubstr("type=\"roadSurface\" subtype=\"patch\" s=\"55\" t=\"0\""));
  EXPECT_THAT(text.value(), HasSubstr("type=\"roadSurface\" subtype=\"speedBump\" s=\"82\" t=\"0\""));
}

}  // namespace
}  // namespace rodeira::road
