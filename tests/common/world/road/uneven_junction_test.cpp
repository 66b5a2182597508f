// SPDX-License-Identifier: Apache-2.0
// Measured and made surfaces of roads that go on through a junction: against the surfaces themselves, and against the
// same road alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "common/core/base/files.hpp"
#include "common/core/base/random.hpp"
#include "common/world/surface/roughness.hpp"
#include "tests/common/world/road/sample_world.hpp"
#include "tests/common/world/surface/made_crg.hpp"

namespace rodeira::road {
namespace {

constexpr double kDensity_m3 = 256e-6;  // class C

// A level road to the east along y = 0 with lanes of 3.5 m, shoulders and verges, and, if told so, one to the north
// that crosses it at x = 100.
std::string Roads(const std::string& on_main, const std::string& on_cross, bool crossed = true) {
  const auto road = [](const std::string& id, const std::string& place, double length_m, const std::string& more) {
    return "  - id: " + id + "\n" + place + "    axis: [line: {length_m: " + std::to_string(length_m) + "}]\n" +
           "    section: {lanes: [{id: -1, width_m: 3.5}, {id: 1, width_m: 3.5}], crossfall: {kind: crown, fall: 0},\n"
           "      shoulders: {left: {width_m: 1, fall: 0}, right: {width_m: 1, fall: 0}}, verge: {width_m: 1, fall: "
           "0}}\n" +
           more;
  };
  return "rodeira: world/2\nname: uneven\nground: {kind: plane, z_m: 5}\nroads:\n" +
         road("main", "    start: {x_m: 0, y_m: 0, heading_deg: 0}\n    z_m: 5\n", 200.0, on_main) +
         (crossed ? road("cross", "    place: {road: main, s_m: 100, turn_deg: 90, own_s_m: 60}\n", 120.0, on_cross) +
                        "junctions:\n  - {id: j, roads: [{road: main, s_m: 100}, {road: cross, s_m: 60}]}\n"
                  : "");
}

std::string Rough(int seed, double from_m, double to_m) {
  return "    surfaces: [{iso_8608: C, seed: " + std::to_string(seed) + ", from_s_m: " + std::to_string(from_m) +
         ", to_s_m: " + std::to_string(to_m) + "}]\n";
}

TEST(UnevenJunctions, ARoughRoadIsAsRoughWhereAnotherCrossesIt) {
  const auto even = MustParse(Roads("", "")), rough = MustParse(Roads(Rough(3, 20, 180), ""));
  const surface::Roughness oracle({kDensity_m3, 3});
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    const double x = base::RandomUniform({i, 1}, 21.1, 178.9), y = base::RandomUniform({i, 2}, -2.99, 2.99);
    const SurfacePoint at = rough->At(x, y), flat = even->At(x, y);
    const surface::RoughnessPoint expected = oracle.At(x, y);
    ASSERT_NEAR(at.z_m - flat.z_m, expected.z_m, 1e-9) << x << " " << y;
    ASSERT_NEAR(at.slope_x - flat.slope_x, expected.dz_ds, 1e-8) << x << " " << y;
    ASSERT_NEAR(at.slope_y - flat.slope_y, expected.dz_dt, 1e-8) << x << " " << y;
  }
  EXPECT_EQ(rough->At(100.0, 3.6).z_m, even->At(100.0, 3.6).z_m);  // beside its lanes
}

TEST(UnevenJunctions, WhereTwoCrossTheFirstOneCounts) {
  const auto even = MustParse(Roads("", "")), rough = MustParse(Roads(Rough(3, 20, 180), Rough(4, 10, 110)));
  const surface::Roughness first({kDensity_m3, 3}), second({kDensity_m3, 4});
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    const double x = base::RandomUniform({i, 3}, 97.01, 102.99), y = base::RandomUniform({i, 4}, -40.0, 40.0);
    const double over_m = rough->At(x, y).z_m - even->At(x, y).z_m;
    if (std::fabs(y) > 3.0 && std::fabs(y) < 3.5) continue;  // there one goes over into the other
    EXPECT_NEAR(over_m, std::fabs(y) < 3.25 ? first.At(x, y).z_m : second.At(60.0 + y, 100.0 - x).z_m, 1e-9)
        << x << " " << y;
  }
}

// No step anywhere, least of all at the mouths, on the shoulders that end there, and where a stretch ends within; and
// the slopes are those of the heights.
TEST(UnevenJunctions, HeightsAndSlopesGoTogether) {
  const auto even = MustParse(Roads("", "")), rough = MustParse(Roads(Rough(3, 20, 99), Rough(4, 57.5, 110)));
  constexpr double kStep_m = 1e-6;
  double worst_step_m = 0.0, highest_m = 0.0;
  int slopes = 0;
  const auto over = [&](double x, double y) { return rough->At(x, y).z_m - even->At(x, y).z_m; };
  for (std::uint64_t i = 0; i < 60'000; ++i) {
    const double x = base::RandomUniform({i, 5}, 75.0, 125.0),
                 y = base::RandomUniform({i, 6}, i % 2 == 0 ? -6.0 : -25.0, i % 2 == 0 ? 6.0 : 25.0);
    const double east = over(x + kStep_m, y), west = over(x - kStep_m, y), north = over(x, y + kStep_m),
                 south = over(x, y - kStep_m);
    worst_step_m = std::max({worst_step_m, std::fabs(east - west), std::fabs(north - south)});
    highest_m = std::max(highest_m, std::fabs(over(x, y)));
    const SurfacePoint at = rough->At(x, y), flat = even->At(x, y);
    const double by_x = (east - west) / (2.0 * kStep_m), by_y = (north - south) / (2.0 * kStep_m);
    const bool kink =
        std::fabs(at.slope_x - flat.slope_x - by_x) > 1e-6 || std::fabs(at.slope_y - flat.slope_y - by_y) > 1e-6;
    slopes += !kink;
    EXPECT_FALSE(kink) << x << " " << y << ": " << at.slope_x - flat.slope_x << " " << by_x << ", "
                       << at.slope_y - flat.slope_y << " " << by_y;
  }
  EXPECT_LT(worst_step_m, 1e-5);
  EXPECT_GT(highest_m, 0.003);
}

// Points beside the very line where road and junction meet.
TEST(UnevenJunctions, ThereIsNoStepWhereARoadEndsAtAJunction) {
  const auto rough = MustParse(Roads(Rough(3, 20, 180), Rough(4, 10, 110)));
  int roads = 0;
  for (const network::Road& road : rough->network()->roads()) {
    if (!road.spec().junction.empty()) continue;
    ++roads;
    for (const double s : {0.0, road.length_m()}) {
      for (double t = -5.4; t < 5.4; t += 0.037) {
        const double inward = s == 0.0 ? 1.0 : -1.0;
        const Eigen::Vector3d end = road.Surface(s, t).p_W, in = road.Surface(s + inward * 0.01, t).p_W;
        const Eigen::Vector3d way = (in - end) / (0.01 * inward) * inward;
        const Eigen::Vector3d here = end + 1e-6 * way, there = end - 1e-6 * way;
        EXPECT_NEAR(rough->At(here.x(), here.y()).z_m, rough->At(there.x(), there.y()).z_m, 1e-5)
            << road.id() << " " << s << " " << t;
      }
    }
  }
  EXPECT_GE(roads, 3);
}

// A measured surface goes on as if nothing crossed it.
TEST(UnevenJunctions, AMeasuredSurfaceGoesOn) {
  const auto folder = std::filesystem::temp_directory_path() / ("rodeira-uneven-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  surface::MadeCrg crg;
  crg.rows = 261;
  crg.z = [](double u, double v) { return 0.01 + 0.0004 * u + 0.002 * v + 0.0001 * u * v; };
  ASSERT_TRUE(base::WriteWhole(folder / "made.crg", std::string_view(crg.Text())).ok());
  for (const std::string orientation : {"same", "opposite"}) {
    const std::string laid =
        "    surfaces: [{crg: made.crg, from_s_m: 50, to_s_m: 150, s_offset_m: 7, orientation: " + orientation + "}]\n";
    const auto world = [&](const std::string& text, const char* name) {
      EXPECT_TRUE(base::WriteWhole(folder / name, text).ok());
      auto loaded = World::Load(folder / name);
      EXPECT_TRUE(loaded.ok()) << loaded.error().Text();
      return loaded.value();
    };
    const auto alone = world(Roads(laid, "", false), "alone.yaml"), crossed = world(Roads(laid, ""), "crossed.yaml"),
               even = world(Roads("", ""), "even.yaml");
    double highest_m = 0.0;
    for (std::uint64_t i = 0; i < 5'000; ++i) {
      const double x = base::RandomUniform({i, 7}, 48.0, 152.0), y = base::RandomUniform({i, 8}, -1.4, 1.4);
      const double expected = alone->At(x, y).z_m - 5.0;
      ASSERT_NEAR(crossed->At(x, y).z_m - even->At(x, y).z_m, expected, 1e-9) << orientation << " " << x << " " << y;
      highest_m = std::max(highest_m, std::fabs(expected));
    }
    EXPECT_GT(highest_m, 0.02);
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace rodeira::road
