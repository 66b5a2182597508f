// SPDX-License-Identifier: Apache-2.0
// Tunnels as they are seen: a tube around the road at every level of detail, that leaves it clear; portals where it
// begins and ends.
#include "common/view/scene/road_furniture/tubes.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "common/core/geometry/angle.hpp"
#include "common/view/scene/visual_world/ground_tile.hpp"
#include "tests/common/view/scene/ground_worlds.hpp"

namespace rodeira::scene {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A tunnel that bends and climbs 20 m under a plane.
std::shared_ptr<const road::World> UnderAPlane(const char* tunnels = "    tunnels: [{from_s_m: 60, to_s_m: 200}]\n") {
  const auto world = road::World::Parse(
      std::string("rodeira: world/2\nname: t\nground: {kind: plane, z_m: 20, surface: grass}\nroads:\n  - id: a\n    "
                  "start: {x_m: 10, y_m: -20, heading_deg: 30}\n    axis: [line: {length_m: 110}, arc: {radius_m: 60, "
                  "turn_deg: 100}]\n"
                  "    vertical: [{s_m: 0, z_m: 0}, {s_m: 210, z_m: 6}]\n    section: {template: rural}\n") +
          tunnels,
      "t.yaml");
  EXPECT_TRUE(world.ok()) << (world.ok() ? "" : world.error().Text());
  return world.ok() ? world.value() : nullptr;
}

std::vector<Mesh> DrawnAt(const road::World& world, int level) {
  const StaticObjects things(world);
  std::vector<Mesh> all;
  for (const auto& [key, tile] : things.tiles()) {
    for (Mesh& mesh : DrawStaticObjects(tile, key, level).meshes) all.push_back(std::move(mesh));
  }
  return all;
}

// How far along a ray (unit) the first face lies that looks towards its beginning; nothing where there is none.
std::optional<double> FirstFace(const std::vector<Mesh>& meshes, const Vector3d& from, const Vector3d& ray) {
  std::optional<double> first;
  for (const Mesh& mesh : meshes) {
    for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
      const Vector3d a = mesh.PositionW(mesh.triangles[3 * i]), b = mesh.PositionW(mesh.triangles[3 * i + 1]),
                     c = mesh.PositionW(mesh.triangles[3 * i + 2]);
      const Vector3d normal = (b - a).cross(c - a);
      const double towards = normal.dot(ray);
      if (!(towards < -1e-12)) continue;  // the renderer leaves out what is seen from behind
      const double away = normal.dot(a - from) / towards;
      if (away < 0.0 || (first && away >= *first)) continue;
      const Vector3d p = from + away * ray;
      const double slack = -1e-6 * normal.norm();
      if ((b - a).cross(p - a).dot(normal) >= slack * normal.norm() &&
          (c - b).cross(p - b).dot(normal) >= slack * normal.norm() &&
          (a - c).cross(p - c).dot(normal) >= slack * normal.norm())
        first = away;
    }
  }
  return first;
}

TEST(Tubes, FromWithinOneSeesWallsAndACeilingAllAroundAtEveryLevel) {
  const auto world = UnderAPlane();
  ASSERT_NE(world, nullptr);
  const network::Road& road = world->network()->roads()[0];
  double right, left;
  road.SectionAt(100.0).Bounds(road.spec().lane_offset, 100.0, 100.0, right, left);
  for (int level = 0; level < kGroundLevels; ++level) {
    const std::vector<Mesh> drawn = DrawnAt(*world, level);
    for (double s = 60.3; s < 200.0; s += 3.1) {
      const geometry::PlanPoint axis = road.axis().Evaluate(s);
      const Vector3d across(axis.left_W().x(), axis.left_W().y(), 0.0),
          eye = road.Surface(s, -1.75).p_W + 1.2 * Vector3d::UnitZ();
      for (double up_deg = -5.0; up_deg <= 185.0; up_deg += 5.0) {
        const double up = up_deg * geometry::kPi / 180.0;
        const Vector3d ray = std::cos(up) * across + std::sin(up) * Vector3d::UnitZ();
        const auto away = FirstFace(drawn, eye, ray);
        ASSERT_TRUE(away) << "level " << level << ", s = " << s << ", " << up_deg << " deg from the left";
        const double t = -1.75 + *away * std::cos(up), z = 1.2 + *away * std::sin(up);
        // A wall 6 cm within the road's edge, a ceiling 4.5 to 5 m over the road, or the haunch between them.
        const bool wall = std::fabs(t - (left - 0.06)) < 0.03 || std::fabs(t - (right + 0.06))<0.03, ceiling = z> 4.4 &&
                                                                     z<5.0, haunch = z> 3.9 &&
                                                                     (t < right + 0.7 || t > left - 0.7);
        EXPECT_TRUE(wall || ceiling || haunch) << "level " << level << ", s = " << s << ": t = " << t << ", z = " << z;
      }
      for (const double t : {right + 0.7, -1.75, 0.0, 1.75, left - 0.7}) {
        const Vector3d on_road = road.Surface(s, t).p_W;
        const auto clear = FirstFace(drawn, on_road, Vector3d::UnitZ());
        ASSERT_TRUE(clear);
        EXPECT_GE(*clear, 4.5);
        EXPECT_LE(*clear, 5.0);
      }
    }
    // Before the mouths nothing is around; nothing hangs into the way through them.
    for (const double s : {50.0, 205.0})
      EXPECT_FALSE(FirstFace(drawn, road.Surface(s, 0.0).p_W, Vector3d::UnitZ())) << s;
    const Vector3d before = road.Surface(50.0, -1.75).p_W + 1.2 * Vector3d::UnitZ();
    const auto ahead =
        FirstFace(drawn, before, (road.Surface(110.0, -1.75).p_W - road.Surface(50.0, -1.75).p_W).normalized());
    EXPECT_TRUE(!ahead || *ahead > 60.0);
    // The portal's front, over the opening and beside it.
    for (const auto& [t, up] :
         {std::pair(0.0, 5.2), std::pair(left + 0.5, 2.0), std::pair(right - 0.5, 2.0), std::pair(right - 0.5, 5.2)}) {
      const Vector3d along = (road.Surface(60.0, 0.0).p_W - road.Surface(50.0, 0.0).p_W) / 10.0;
      const auto front = FirstFace(drawn, road.Surface(50.0, t).p_W + up * Vector3d::UnitZ(), along);
      ASSERT_TRUE(front) << level << " " << t << " " << up;
      EXPECT_NEAR(*front, 9.5, 0.01);
    }
  }
}

TEST(Tubes, WhereNoTunnelIsThereIsNone) {
  for (const char* none : {"", "    bridges: [{from_s_m: 60, to_s_m: 200}]\n"}) {
    const auto world = UnderAPlane(none);
    ASSERT_NE(world, nullptr);
    EXPECT_TRUE(network::PlaceTubes(*world->network()).empty());
    EXPECT_TRUE(StaticObjects(*world).tiles().empty());
  }
}

// What a tile is made from says whether its tunnel was changed.
TEST(Tubes, ATilesDigestTellsOfThem) {
  const auto whole = UnderAPlane(), shorter = UnderAPlane("    tunnels: [{from_s_m: 60, to_s_m: 199}]\n");
  const StaticObjects things(*whole), others(*shorter);
  std::size_t differ = 0;
  for (const auto& [key, tile] : things.tiles()) {
    EXPECT_NE(things.DigestOf(key), 0u);
    differ += things.DigestOf(key) != others.DigestOf(key);
  }
  EXPECT_GT(differ, 0u);
}

// OpenDRIVE: two roads, one behind the other, in one tunnel, and one abreast of the second: a portal at each end and
// none between, a wall along all of it but where the road abreast lies.
TEST(Tubes, GoOnFromRoadToRoadAndLeaveRoadsBesideThemOpen) {
  const auto road = [](const char* id, double x, double y, double length, const char* link, double from,
                       double tunnel) {
    return fmt::format(
        "<road id=\"{}\" length=\"{}\" junction=\"-1\">{}<planView><geometry s=\"0\" x=\"{}\" y=\"{}\" hdg=\"0\" "
        "length=\"{}\"><line/></geometry></planView><lanes><laneSection s=\"0\"><center><lane id=\"0\"/></center>"
        "<right><lane id=\"-1\" type=\"driving\">{}<width sOffset=\"0\" a=\"4\" b=\"0\" c=\"0\" "
        "d=\"0\"/></lane></right></laneSection></lanes><objects><tunnel id=\"t{}\" s=\"{}\" length=\"{}\" "
        "type=\"standard\"/></objects></road>\n",
        id, length, link, x, y, length,
        *id == '1'   ? "<link><successor id=\"-1\"/></link>"
        : *id == '2' ? "<link><predecessor id=\"-1\"/></link>"
                     : "",
        id, from, tunnel);
  };
  const auto world = OpenDriveWorld(
      road("1", 0.0, 0.0, 100.0,
           "<link><successor elementType=\"road\" elementId=\"2\" contactPoint=\"start\"/></link>", 40.0, 60.0) +
      road("2", 100.0, 0.0, 100.0,
           "<link><predecessor elementType=\"road\" elementId=\"1\" contactPoint=\"end\"/></link>", 0.0, 70.0) +
      road("3", 120.0, -4.0, 30.0, "", 0.0, 0.0));
  ASSERT_NE(world, nullptr);
  const auto pieces = network::PlaceTubes(*world->network());
  ASSERT_FALSE(pieces.empty());
  double wall_m = 0.0, open_m = 0.0;
  int portals = 0;
  for (const network::TubePiece& piece : pieces) {
    const double low = piece.right_W[0].x(), high = piece.right_W[1].x();
    portals += piece.portal[0] + piece.portal[1];
    EXPECT_EQ(piece.portal[0], std::fabs(low - 40.0) < 1e-6);
    EXPECT_EQ(piece.portal[1], std::fabs(high - 170.0) < 1e-6);
    EXPECT_TRUE(piece.left_wall);
    EXPECT_NEAR(piece.ceiling_m[0], 4.55, 1e-9) << "level";
    EXPECT_NEAR(piece.right_W[0].y(), -4.0, 1e-9);
    (piece.right_wall ? wall_m : open_m) += high - low;
    EXPECT_FALSE(high > 120.1 && low < 149.9 && piece.right_wall) << low;
    EXPECT_TRUE((high >= 119.9 && low <= 150.1) || piece.right_wall) << low;
  }
  EXPECT_EQ(portals, 2);
  EXPECT_NEAR(wall_m + open_m, 130.0, 1e-6);
  EXPECT_GT(wall_m, 80.0);
}

}  // namespace
}  // namespace rodeira::scene
