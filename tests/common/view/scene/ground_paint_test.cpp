// SPDX-License-Identifier: Apache-2.0
// The paint as it is drawn, against what the file says.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "common/world/network/marking.hpp"
#include "tests/common/view/scene/correlation.hpp"
#include "tests/common/view/scene/ground_tiles.hpp"
#include "tests/common/view/scene/ground_worlds.hpp"
#include "tests/long_form.hpp"
#include "tests/setting.hpp"
#include "tests/tree.hpp"

namespace rodeira::scene {
namespace {

// Lines of one road's lanes, as strokes of its own stations: how far a place lies beside the nearest one.
class LinesOfRoad {
 public:
  explicit LinesOfRoad(const network::Road& road) : road_(road) {
    for (const network::Marking& line : network::MarkingsOf(road)) {
      lines_.push_back({line, network::StrokesOf(road, line)});
      for (const network::Stroke& stroke : lines_.back().strokes)
        area_m2_ += line.width_m * network::MarkingLength(road, line, stroke.from_s_m, stroke.to_s_m);
    }
  }
  std::size_t size() const { return lines_.size(); }
  double area_m2() const { return area_m2_; }
  double Beside(double s_m, double t_m) const {
    double nearest = 1e9;
    for (const Line& known : lines_) {
      const double aside = std::fabs(t_m - network::MarkingAt(road_, known.line, s_m).value) - 0.5 * known.line.width_m;
      for (const network::Stroke& stroke : known.strokes) {
        const double beyond = std::max({0.0, stroke.from_s_m - s_m, s_m - stroke.to_s_m});
        nearest = std::min(nearest, std::max({0.0, aside, beyond}));
      }
    }
    return nearest;
  }

 private:
  struct Line {
    network::Marking line;
    std::vector<network::Stroke> strokes;
  };
  const network::Road& road_;
  std::vector<Line> lines_;
  double area_m2_ = 0.0;
};

// What is painted, point by point: on the line that the file says, and within its dashes.
TEST(Ground, PaintLiesWhereTheFileSays) {
  const auto world = OpenDriveWorld(BendUnderBridge());
  ASSERT_NE(world, nullptr);
  const network::Road& road = world->network()->roads()[0];
  const LinesOfRoad lines(road);
  double painted_m2 = 0.0, off_m2 = 0.0;
  ASSERT_EQ(lines.size(), 4u);
  double worst_m = 0.0;
  const auto ask = [&](const Eigen::Vector3d& p) {
    const auto place = world->network()->Locate(p.x(), p.y(), p.z());
    ASSERT_TRUE(place.has_value());
    worst_m = std::max(worst_m, lines.Beside(place->s_m, place->t_m));
  };
  const auto is_on_suelo = [&](const Eigen::Vector3d& p) {
    return std::fabs(world->At(p.x(), p.y(), p.z() + 0.3).z_m - p.z()) < 0.006 || MeetsNearby(*world, p, 0.006);
  };
  std::vector<std::array<Eigen::Vector3d, 3>> triangles;
  std::vector<double> sums_m2;
  for (const GroundTile& tile : BuildAll(*world)) {
    const Mesh& marks = tile.levels[0].marks;
    for (std::size_t i = 0; i < marks.triangle_count(); ++i) {
      const auto c = triangles.emplace_back(CornersOf(marks, i));
      const double area_m2 =
          0.5 * std::fabs((c[1] - c[0]).x() * (c[2] - c[0]).y() - (c[1] - c[0]).y() * (c[2] - c[0]).x());
      sums_m2.push_back(painted_m2 += area_m2);
      bool on_suelo = true;
      for (const Eigen::Vector3d& p : {c[0], c[1], c[2], Eigen::Vector3d((c[0] + c[1] + c[2]) / 3.0)}) {
        ask(p);
        on_suelo = on_suelo && is_on_suelo(p);
      }
      if (!on_suelo) off_m2 += area_m2;
    }
  }
  const std::uint64_t more = Setting("RODEIRA_PAINT_POINTS", 5'000);
  for (std::uint64_t i = 0; i < more && !sums_m2.empty(); ++i) ask(PointIn(triangles, sums_m2, 4, i));
  if (HasFatalFailure()) return;
  EXPECT_LT(off_m2, 1e-5 * painted_m2);  // slivers at the road's ends, thinner than a step of the grid
  EXPECT_GT(triangles.size(), 2'500u);
  EXPECT_LT(worst_m, 0.002);
  EXPECT_NEAR(painted_m2 / lines.area_m2(), 1.0, 0.01);
  std::printf("%zu points of lines, worst %.5f m beside what the file says\n", 4 * triangles.size() + more, worst_m);
}

// The same on the project's own roads, hills, banks and bends included: nothing is painted beside the lines that the
// world says, and as much of them as there is. What else is painted (zebra crossings, arrows, stop lines) is not on
// these two.
TEST(Ground, PaintOfTheProjectsRoadsLiesWhereTheWorldSays) {
  for (const std::string& name : BriefOrLong<std::vector<std::string>>({"n222"}, {"n222", "motorway"})) {
    const auto loaded = road::World::Load(SourceDir() + "/configs/worlds/" + name + ".yaml");
    ASSERT_TRUE(loaded.ok()) << loaded.error().Text();
    const road::World& world = *loaded.value();
    std::vector<LinesOfRoad> roads;
    double expected_m2 = 0.0, painted_m2 = 0.0, worst_m = 0.0;
    for (const network::Road& road : world.network()->roads()) expected_m2 += roads.emplace_back(road).area_m2();
    std::vector<std::array<Eigen::Vector3d, 3>> triangles;
    std::vector<double> sums_m2;
    const GroundPlan plan(world);
    for (const auto& tile_key : plan.tiles()) {
      const Mesh marks = plan.BuildLevel(tile_key, 0).marks;
      for (std::size_t i = 0; i < marks.triangle_count(); ++i) {
        const auto c = triangles.emplace_back(CornersOf(marks, i));
        sums_m2.push_back(painted_m2 += 0.5 * std::fabs((c[1] - c[0]).x() * (c[2] - c[0]).y() -
                                                        (c[1] - c[0]).y() * (c[2] - c[0]).x()));
      }
    }
    Eigen::Vector3d where = Eigen::Vector3d::Zero();
    const std::uint64_t points = Setting("RODEIRA_PAINT_POINTS", 5'000) * 4;
    for (std::uint64_t i = 0; i < points; ++i) {
      const Eigen::Vector3d p = PointIn(triangles, sums_m2, 4, i);
      const auto place = world.network()->Locate(p.x(), p.y(), p.z());
      ASSERT_TRUE(place.has_value());
      const double beside_m = roads[place->lane.road].Beside(place->s_m, place->t_m);
      if (beside_m > worst_m) worst_m = beside_m, where = p;
    }
    EXPECT_LT(worst_m, 0.002) << name << " at " << where.transpose();
    EXPECT_NEAR(painted_m2 / expected_m2, 1.0, 0.01) << name;
    std::printf("%s: %llu points of %.0f m2 of lines, worst %.5f m beside what the world says\n", name.c_str(),
                static_cast<unsigned long long>(points), painted_m2, worst_m);
  }
}

}  // namespace
}  // namespace rodeira::scene
