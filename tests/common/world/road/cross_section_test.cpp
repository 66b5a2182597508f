// SPDX-License-Identifier: Apache-2.0
// What a world file says of a road's section, superelevation and kerbs, as SUELO answers it: against closed forms in x
// and y.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/common/world/road/sample_world.hpp"

namespace rodeira::road {
namespace {

// A road on a plane far below it, 8 m to each side, level across but for `section`'s keys.
std::shared_ptr<const World> RoadOf(const std::string& axis, const std::string& keys,
                                    const std::string& section = "crossfall: {kind: crown, fall: 0}") {
  return MustParse(
      "rodeira: world/2\nname: w\nground: {kind: plane, z_m: -20}\nroads:\n  - id: a\n    start: {x_m: 0, y_m: 0, "
      "heading_deg: 0}\n    axis: [" +
      axis + "]\n" + keys +
      "    section: {lanes: [{id: -1, width_m: 8}, {id: 1, width_m: 8}], verge: {width_m: 0}, lines: [], " + section +
      "}\n");
}

constexpr const char* kTurned = "    superelevation: [{s_m: 100, slope: 0.06}, {s_m: 180, slope: -0.04}]\n";

// The angle along kTurned: from atan 0.06 to atan -0.04 by 3u^2 - 2u^3, and how it grows with s.
struct Angle {
  double rad, by_s;
};
Angle AngleAt(double s_m) {
  const double first = std::atan(0.06), last = std::atan(-0.04);
  if (s_m <= 100.0) return {first, 0.0};
  if (s_m >= 180.0) return {last, 0.0};
  const double u = (s_m - 100.0) / 80.0;
  return {first + (last - first) * (3.0 * u * u - 2.0 * u * u * u), (last - first) * 6.0 * u * (1.0 - u) / 80.0};
}

// Level and straight to the east, the road's point t to the left stands over y = t cos(angle), and t sin(angle) higher
// than the axis: z = z0 + y tan(angle). Positive: the left (north) side is higher.
TEST(Superelevation, OfALevelStraightIsAsHighAsItSays) {
  const auto world = RoadOf("line: {length_m: 300}", std::string("    z_m: 10\n") + kTurned);
  for (const double x : {20.0, 60.0, 110.0, 120.0, 140.0, 155.5, 179.0, 200.0, 290.0}) {
    const Angle angle = AngleAt(x);
    for (const double y : {-7.5, -3.0, -0.5, 0.5, 3.0, 7.5}) {
      const SurfacePoint at = world->At(x, y);
      ASSERT_TRUE(at.inside);
      EXPECT_NEAR(at.z_m, 10.0 + y * std::tan(angle.rad), 1e-9) << x << " " << y;
      EXPECT_NEAR(at.slope_y, std::tan(angle.rad), 1e-9) << x << " " << y;
      EXPECT_NEAR(at.slope_x, y * angle.by_s / std::pow(std::cos(angle.rad), 2), 1e-9) << x << " " << y;
    }
  }
  // In numbers: 7.5 m to the left before the transition, half way through it, and behind it.
  EXPECT_NEAR(world->At(50.0, 7.5).z_m, 10.45, 1e-9);
  EXPECT_NEAR(world->At(50.0, -7.5).z_m, 9.55, 1e-9);
  EXPECT_NEAR(world->At(140.0, 7.5).z_m, 10.0 + 7.5 * 0.009975064825, 1e-9);  // tan((atan 0.06 - atan 0.04) / 2)
  EXPECT_NEAR(world->At(250.0, 7.5).z_m, 9.7, 1e-9);
  EXPECT_NEAR(world->At(250.0, -7.5).z_m, 10.3, 1e-9);
}

// It is turned about the climbing axis: with grade g z = z0 + g x + y tan(angle) sqrt(1 + g^2), in the constant parts.
TEST(Superelevation, OfAClimbingStraightIsTurnedAboutTheAxis) {
  const auto world =
      RoadOf("line: {length_m: 300}", std::string("    vertical: [{s_m: 0, z_m: 5}, {s_m: 300, z_m: 35}]\n") + kTurned);
  for (const double x : {20.0, 60.0, 200.0, 290.0}) {
    for (const double y : {-7.5, -2.0, 2.0, 7.5}) {
      const double slope = std::tan(AngleAt(x).rad) * std::sqrt(1.01);
      const SurfacePoint at = world->At(x, y);
      EXPECT_NEAR(at.z_m, 5.0 + 0.1 * x + y * slope, 1e-9) << x << " " << y;
      EXPECT_NEAR(at.slope_x, 0.1, 1e-9) << x << " " << y;
      EXPECT_NEAR(at.slope_y, slope, 1e-9) << x << " " << y;
    }
  }
}

// A bend to the left about (0, 50), its outer (right) side higher: at the radius r the road is (r - 50) 0.05 over its
// axis, a cone.
TEST(Superelevation, OfABendIsACone) {
  const auto world =
      RoadOf("arc: {length_m: 150, radius_m: 50}", "    z_m: 3\n    superelevation: [{s_m: 0, slope: -0.05}]\n");
  for (const double turn : {0.2, 1.0, 2.0, 2.9}) {
    for (const double r : {42.5, 47.0, 50.5, 53.0, 57.5}) {
      const double x = r * std::sin(turn), y = 50.0 - r * std::cos(turn);
      const SurfacePoint at = world->At(x, y);
      EXPECT_NEAR(at.z_m, 3.0 + 0.05 * (r - 50.0), 1e-9) << turn << " " << r;
      EXPECT_NEAR(at.slope_x, 0.05 * std::sin(turn), 1e-9) << turn << " " << r;
      EXPECT_NEAR(at.slope_y, -0.05 * std::cos(turn), 1e-9) << turn << " " << r;
    }
  }
}

// A crossfall is counted vertically on the turned section: on both sides 0.02 of the distance along it.
TEST(Superelevation, ACrownStandsOnTheTurnedSection) {
  const auto world =
      RoadOf("line: {length_m: 300}", std::string("    z_m: 10\n") + kTurned, "crossfall: {kind: crown, fall: 0.02}");
  for (const double x : {50.0, 120.0, 140.0, 250.0}) {
    for (const double y : {-7.0, -2.0, 2.0, 7.0}) {
      const double angle = AngleAt(x).rad;
      EXPECT_NEAR(world->At(x, y).z_m, 10.0 + y * std::tan(angle) - 0.02 * std::fabs(y) / std::cos(angle), 1e-9)
          << x << " " << y;
    }
  }
}

// Kerbs on both sides of a crowned road, from the axis outward: 3.5 m of carriageway that falls by 0.02, a pavement
// 0.12 m higher that rises outward by 0.01, on the left a sunken kerb back to 0.04. Both sides of each kerb, a
// micrometre from its edge.
TEST(Kerbs, StepWhereTheyStand) {
  const auto world = MustParse(
      "rodeira: world/2\nname: w\nground: {kind: plane, z_m: 1}\nroads:\n  - id: a\n    start: {x_m: 0, y_m: 0, "
      "heading_deg: 0}\n    axis: [line: {length_m: 100}]\n    z_m: 1\n"
      "    section:\n      crossfall: {kind: crown, fall: 0.02}\n      verge: {width_m: 1, fall: 0}\n      lines: []\n"
      "      lanes: [{id: -1, width_m: 3.5}, {id: -2, type: sidewalk, width_m: 2, kerb_m: 0.12, fall: -0.01}, {id: 1, "
      "width_m: 3.5}, {id: 2, type: sidewalk, width_m: 2, kerb_m: 0.12, fall: -0.01},\n"
      "              {id: 3, type: biking, width_m: 1.5, kerb_m: -0.08, fall: 0}]\n");
  const auto suelo = world->MakeGround();
  const double low = 1.0 - 3.5 * 0.02, kept = 1e-6;
  const auto expect = [&](double y, double z_m, double slope, ground::Surface surface) {
    for (const double x : {0.5, 33.3, 99.5}) {
      const ground::GroundPoint at = suelo->At(x, y);
      ASSERT_TRUE(at.inside);
      EXPECT_NEAR(at.z_m, z_m, 1e-7) << x << " " << y;
      EXPECT_NEAR(-at.normal_W.y() / at.normal_W.z(), slope, 1e-9) << x << " " << y;
      EXPECT_NEAR(at.normal_W.x(), 0.0, 1e-12) << x << " " << y;
      EXPECT_EQ(at.surface, surface) << x << " " << y;
    }
  };
  using enum ground::Surface;
  expect(-3.5 + kept, low, 0.02, kAsphalt);  // on the right slopes are by y, which grows towards the axis
  expect(-3.5 - kept, low + 0.12, -0.01, kConcrete);
  expect(-5.5 + kept, low + 0.12 + 0.02, -0.01, kConcrete);
  expect(-5.5 - kept, low + 0.12 + 0.02, 0.0, kGrass);  // what lies outside of a kerb is raised with it
  expect(3.5 - kept, low, -0.02, kAsphalt);
  expect(3.5 + kept, low + 0.12, 0.01, kConcrete);
  expect(5.5 - kept, low + 0.12 + 0.02, 0.01, kConcrete);
  expect(5.5 + kept, low + 0.12 + 0.02 - 0.08, 0.0, kAsphalt);
  expect(7.0 - kept, low + 0.12 + 0.02 - 0.08, 0.0, kAsphalt);
  expect(7.0 + kept, low + 0.12 + 0.02 - 0.08, 0.0, kGrass);
  // A patch of points over the kerb, a metre to each side of it.
  constexpr int kAcross = 20;
  std::vector<ground::GroundPoint> points(7 * kAcross);
  suelo->Patch({20.0, -3.5, 0.0, 0.3, 2.0, 7, kAcross, 1.0}, points);
  std::multiset<double> found, expected;
  for (const ground::GroundPoint& point : points) found.insert(point.z_m);
  for (int j = 0; j < kAcross; ++j) {
    const double out = -1.0 + 2.0 * j / (kAcross - 1);  // beyond the kerb
    for (int i = 0; i < 7; ++i) expected.insert(out > 0.0 ? low + 0.12 + 0.01 * out : low - 0.02 * out);
  }
  ASSERT_EQ(found.size(), expected.size());
  for (auto a = found.begin(), b = expected.begin(); a != found.end(); ++a, ++b) EXPECT_NEAR(*a, *b, 1e-9);
}

}  // namespace
}  // namespace rodeira::road
