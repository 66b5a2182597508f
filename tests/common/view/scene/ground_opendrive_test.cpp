// SPDX-License-Identifier: Apache-2.0
// The ground of OpenDRIVE worlds as it is drawn, their own files and others', against SUELO.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "common/view/scene/tessellation/levels_at.hpp"
#include "tests/common/view/scene/correlation.hpp"
#include "tests/common/view/scene/ground_tiles.hpp"
#include "tests/common/view/scene/ground_worlds.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/setting.hpp"
#include "tests/tree.hpp"

namespace rodeira::scene {
namespace {

// Whether SUELO is steeper than 1 in 1, as no road is, within some distance of a place.
bool IsSteepNearby(const road::World& world, const Eigen::Vector3d& p, double within_m) {
  for (int k = 0; k < 128; ++k) {
    const double angle = M_PI / 8.0 * (k % 16), away_m = within_m * (1 + k / 16) / 8.0;
    const road::SurfacePoint at =
        world.At(p.x() + away_m * std::cos(angle), p.y() + away_m * std::sin(angle), p.z() + 0.3);
    if (at.inside && std::hypot(at.slope_x, at.slope_y) > 1.0) return true;
  }
  return false;
}

// Narrower than a millimetre seen from above: between the edges of two roads' lanes that are nearly one line, at two
// heights. It stands upright.
bool StandsUpright(const Mesh& mesh, std::size_t triangle) {
  const auto c = CornersOf(mesh, triangle);
  const Eigen::Vector3d u = c[1] - c[0], v = c[2] - c[0];
  const double longest_m = std::max({u.head<2>().norm(), v.head<2>().norm(), (u - v).head<2>().norm()});
  return !(std::fabs(u.x() * v.y() - u.y() * v.x()) > 0.001 * longest_m);
}

// In files of other programs roads that overlap have heights of their own. Where edges of two meet while a third lies
// there at another height SUELO steps, or is as steep as one likes, and no triangle of a few centimetres follows it.
// Everywhere else it is met.
TEST(Ground, IsWhereTheTyresAreOnRealFilesButAtTheirSteps) {
  constexpr double kStep_m = 0.3;
  for (const std::string& name : RealGrounds()) {
    if (!std::filesystem::exists(SharedXodr(name))) GTEST_SKIP() << "skipped: " << SharedXodr(name) << " is absent";
    const auto loaded = road::World::Load(SharedXodr(name));
    ASSERT_TRUE(loaded.ok()) << loaded.error().Text();
    const road::World& world = *loaded.value();
    const auto tiles = BuildAll(world);
    int at_steps = 0;
    const auto counts = [](const Mesh& mesh, std::size_t i) { return IsRoad(mesh) && !StandsUpright(mesh, i); };
    const Correlation found = Correlate(world, tiles, Points(), 2, counts, Tolerances{}, [&](const Eigen::Vector3d& p) {
      const road::SurfacePoint at = world.At(p.x(), p.y(), p.z() + 0.3);
      const bool off = !at.inside || std::fabs(at.z_m - p.z()) > Tolerances{}.height_m;
      if (!off || !(StepsNearby(world, p, kStep_m) || IsSteepNearby(world, p, kStep_m))) return true;
      ++at_steps;
      return false;
    });
    EXPECT_EQ(found.asked, Points()) << name;
    EXPECT_EQ(found.far, 0) << name << ": worst " << found.worst_m << " m at " << found.where.transpose();
    EXPECT_LT(at_steps, 0.002 * found.asked) << name;
    EXPECT_LT(found.stepped, 0.002 * found.asked) << name;
    std::printf("%s: %d points, %d more than 5 mm from SUELO, worst %.4f m, and %d more at its steps\n", name.c_str(),
                found.asked, found.far, found.worst_m, at_steps);
  }
}

// A road over a crest and through a hollow, with the edge between two tiles along its left lane: both draw it where
// SUELO is, in a world without a terrain too.
TEST(Ground, IsWhereTheTyresAreOnTheEdgesOfTiles) {
  const std::string lane = "<width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/></lane>";
  const auto world = OpenDriveWorld(fmt::format(
      "<road id=\"1\" length=\"230\" junction=\"-1\"><planView><geometry s=\"0\" x=\"{}\" y=\"13\" hdg=\"{}\" "
      "length=\"230\"><line/></geometry></planView>"
      "<elevationProfile><elevation s=\"0\" a=\"3\" b=\"0.08\" c=\"-0.002\" d=\"0.00001\"/></elevationProfile>"
      "<lanes><laneSection s=\"0\"><left><lane id=\"1\" type=\"driving\">{}</left><center><lane "
      "id=\"0\"/></center><right><lane id=\"-1\" type=\"driving\">{}</right></laneSection></lanes></road>\n",
      kTile_m + 1.7, 0.5 * M_PI, lane, lane));
  ASSERT_NE(world, nullptr);
  int sides = 0;
  double worst_m = 0.0;
  for (const GroundTile& tile : BuildAll(*world)) {
    for (const Mesh& mesh : tile.levels[0].ground) {
      for (std::size_t i = 0; IsRoad(mesh) && i < mesh.triangle_count(); ++i) {
        const auto corners = CornersOf(mesh, i);
        for (std::size_t k = 0; k < 3; ++k) {
          const Eigen::Vector3d &a = corners[k], &b = corners[(k + 1) % 3];
          if (std::fabs(a.x() - kTile_m) > 1e-6 || std::fabs(b.x() - kTile_m) > 1e-6) continue;
          ++sides;
          for (int n = 1; n < 32; ++n) {
            const Eigen::Vector3d p = a + n / 32.0 * (b - a);
            worst_m = std::max(worst_m, std::fabs(world->At(p.x(), p.y(), p.z() + 0.3).z_m - p.z()));
          }
        }
      }
    }
  }
  EXPECT_GT(sides, 100);  // of both tiles
  EXPECT_LT(worst_m, 0.005);
  std::printf("%d sides on the edge, worst %.4f m from SUELO\n", sides, worst_m);
}

// A wide road that climbs 20 m within 100, in a bend that tightens: many rounds of points until it is met everywhere.
TEST(Ground, IsMetToTheLastPlaceWhereAWideRoadClimbsInABend) {
  const auto width = [](double a) { return fmt::format("<width sOffset=\"0\" a=\"{}\" b=\"0\" c=\"0\" d=\"0\"/>", a); };
  const auto side = [&](int sign) {
    std::string lanes;
    for (const auto& [id, wide] : {std::pair(1, 3.0), std::pair(2, 5.0), std::pair(3, 20.0)})
      lanes +=
          fmt::format("<lane id=\"{}\" type=\"{}\">{}</lane>", sign * id, id == 1 ? "driving" : "border", width(wide));
    return lanes;
  };
  const auto world = OpenDriveWorld(
      "<road id=\"1\" length=\"200\" junction=\"-1\"><planView><geometry s=\"0\" x=\"350\" y=\"-50\" hdg=\"0\" "
      "length=\"100\"><spiral curvStart=\"0\" curvEnd=\"0.02\"/></geometry>"
      "<geometry s=\"100\" x=\"440.45242379\" y=\"-18.97316983\" hdg=\"1\" length=\"100\"><spiral curvStart=\"0.02\" "
      "curvEnd=\"0\"/></geometry></planView>"
      "<elevationProfile><elevation s=\"0\" a=\"0\" b=\"0\" c=\"0\" d=\"0\"/><elevation s=\"20\" a=\"0\" b=\"0\" "
      "c=\"0.006\" d=\"-0.00004\"/><elevation s=\"120\" a=\"20\" b=\"0\" c=\"-0.006\" "
      "d=\"0.00004\"/></elevationProfile>"
      "<lanes><laneSection s=\"0\"><left>" +
      side(1) + "</left><center><lane id=\"0\"/></center><right>" + side(-1) +
      "</right></laneSection></lanes></road>\n");
  ASSERT_NE(world, nullptr);
  const std::vector<GroundTile> tiles = BuildAll(*world);
  const Correlation found = Correlate(*world, tiles, std::max(Points(), 100'000), 13);
  EXPECT_EQ(found.far, 0) << "worst " << found.worst_m << " m at " << found.where.transpose();
  std::printf("%d points, worst %.4f m from SUELO\n", found.asked, found.worst_m);
}

// The land beside the roads of real files and under their decks, as far as SUELO knows it. Where edges of different
// heights touch it steps, and is drawn over a metre at most; in the middle of bends it turns about a point, and is as
// steep there as one likes.
TEST(Ground, LandOfRealFilesIsWhereTheTyresAre) {
  constexpr double kStep_m = 1.2;
  std::vector<std::string> names{"esmini_curves_elevation",
                                 "esmini_e6mini",
                                 "esmini_tunnels",
                                 "carla_Town04",
                                 "esmini_fabriksgatan",
                                 "esmini_highway_exit",
                                 "esmini_multi_intersections",
                                 "esmini_straight_500_superelevation_elevation_curve",
                                 "esmini_straight_500m_roadmarks",
                                 "esmini_straight_500m_signs",
                                 "asamqc_lane_gap_issue119",
                                 "asamqc_positive_v18"};
  names.resize(std::min<std::size_t>(names.size(), Setting("RODEIRA_LAND_FILES", 2)));
  for (const std::string& name : names) {
    if (!std::filesystem::exists(SharedXodr(name))) GTEST_SKIP() << "skipped: " << SharedXodr(name) << " is absent";
    const auto loaded = road::World::Load(SharedXodr(name));
    ASSERT_TRUE(loaded.ok()) << loaded.error().Text();
    const road::World& world = *loaded.value();
    std::vector<std::array<Eigen::Vector3d, 3>> triangles;
    std::vector<double> sums_m2;
    for (const GroundTile& tile : BuildAll(world)) {
      for (const Mesh& mesh : tile.levels[0].ground) {
        for (std::size_t i = 0; i < mesh.triangle_count() && !IsRoad(mesh); ++i) {
          if (IsWall(mesh, i)) continue;
          const auto c = triangles.emplace_back(CornersOf(mesh, i));
          const Eigen::Vector3d u = c[1] - c[0], v = c[2] - c[0];
          sums_m2.push_back((sums_m2.empty() ? 0.0 : sums_m2.back()) + 0.5 * (u.x() * v.y() - u.y() * v.x()));
        }
      }
    }
    ASSERT_FALSE(triangles.empty());
    int asked = 0, far = 0, stepped = 0;
    double worst_m = 0.0;
    Eigen::Vector3d where = Eigen::Vector3d::Zero();
    for (std::uint64_t n = 0; asked < Points() && n < 50 * static_cast<std::uint64_t>(Points()); ++n) {
      const Eigen::Vector3d p = PointIn(triangles, sums_m2, 59, n);
      const road::SurfacePoint highest = world.At(p.x(), p.y());
      if (!highest.inside) continue;
      ++asked;
      const double off_m = FromNearest(world, p);  // where a deck begins land lies less than a hint can tell below it
      if (off_m > 0.005 && StepsNearby(world, p, kStep_m)) {
        ++stepped;
        continue;
      }
      far += off_m > 0.005;
      if (off_m > worst_m) worst_m = off_m, where = p;
    }
    EXPECT_EQ(asked, Points()) << name;
    EXPECT_LE(far, 0.0002 * asked) << name << ": worst " << worst_m << " m at " << where.transpose();
    EXPECT_LE(stepped, 0.001 * asked) << name;
    std::printf("%s: %d points of land, %d at steps, %d more than 5 mm from SUELO, worst %.4f m\n", name.c_str(), asked,
                stepped, far, worst_m);
  }
}

// A straight road of two lanes of 3.75 m on a bank of 0.05 rad: its edges lie 3.75 m times the sine above and below the
// axis, and the land beside it is level. What is drawn goes on so where SUELO ends, 100 m from the edges, and needs no
// more triangles than beside a level road.
TEST(Ground, GoesOnLevelBeyondTheLandOfABankedRoad) {
  const auto text = [](double bank_rad) {
    return fmt::format(
        "<OpenDRIVE><header revMajor=\"1\" revMinor=\"7\"/><road id=\"1\" length=\"700\" junction=\"-1\"><planView>"
        "<geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"700\"><line/></geometry></planView><lateralProfile>"
        "<superelevation s=\"0\" a=\"{}\" b=\"0\" c=\"0\" d=\"0\"/></lateralProfile><lanes><laneSection s=\"0\"><left>"
        "<lane id=\"1\" type=\"driving\"><width sOffset=\"0\" a=\"3.75\" b=\"0\" c=\"0\" "
        "d=\"0\"/></lane></left><center>"
        "<lane id=\"0\" type=\"none\"/></center><right><lane id=\"-1\" type=\"driving\"><width sOffset=\"0\" "
        "a=\"3.75\" b=\"0\" c=\"0\" d=\"0\"/></lane></right></laneSection></lanes></road></OpenDRIVE>",
        bank_rad);
  };
  const cli::TemporaryFolder folder;
  const auto flat = road::World::Load(folder.Write("flat.xodr", text(0.0))),
             banked = road::World::Load(folder.Write("banked.xodr", text(0.05)));
  ASSERT_TRUE(flat.ok() && banked.ok());
  std::vector<road::SurfacePoint> levels;
  for (const double side : {-1.0, 1.0}) {
    for (const double away_m : {20.0, 99.0, 110.0, 300.0, 490.0}) {
      LevelsAt(*banked.value(), {333.3, side * away_m}, 1, levels);
      ASSERT_EQ(levels.size(), 1u);
      EXPECT_NEAR(levels[0].z_m, side * 3.75 * std::sin(0.05), 1e-6) << away_m;
    }
  }
  // The tile in the road's middle, away from its ends.
  const auto triangles = [](const road::World& world) {
    const GroundPlan plan(world);
    std::size_t count = 0;
    for (const TileKey& key : plan.tiles()) {
      if (key.column != 1 || (key.row != 0 && key.row != -1)) continue;
      for (const Mesh& mesh : plan.BuildLevel(key, 0).ground) count += mesh.triangles.size() / 3;
    }
    return count;
  };
  const std::size_t level = triangles(*flat.value());
  EXPECT_GT(level, 50u);
  EXPECT_LE(triangles(*banked.value()), level + level / 4);
}

}  // namespace
}  // namespace rodeira::scene
