// SPDX-License-Identifier: Apache-2.0
// The world that is shipped is what it says it is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "common/core/base/random.hpp"
#include "common/world/network/placing.hpp"
#include "common/world/road/world.hpp"
#include "common/world/road/world_report.hpp"
#include "tests/n222.hpp"

namespace rodeira::road {
namespace {

constexpr double kEdge_m = 4.6;  // of verge, from the axis

class N222 : public ::testing::Test {
 protected:
  const World& world_ = *rodeira::N222();
  const network::Road& road_ = world_.network()->roads()[0];
};

double GradeAt(const network::Road& road, double s_m) { return road.spec().elevation.Evaluate(s_m).slope; }

TEST_F(N222, IsAsLongBentAndWideAsItsModel) {
  EXPECT_GT(road_.length_m(), 5000.0);
  int bends = 0;
  for (const geometry::PlanElement& element : road_.axis().elements()) {
    const double curvature = std::max(std::fabs(element.curvature_start_1pm), std::fabs(element.curvature_end_1pm));
    if (curvature == 0.0) continue;
    EXPECT_TRUE(curvature <= 1.0 / 30.0 && curvature >= 1.0 / 200.0) << 1.0 / curvature;
    if (element.curvature_start_1pm == element.curvature_end_1pm) ++bends;
  }
  EXPECT_NEAR(bends / road_.length_m() * 1000.0, 3.4, 0.35);  // 93 bends on 27 km
  const auto& right = road_.spec().sections[0].right;
  ASSERT_EQ(right.size(), 3u);
  EXPECT_GE(2.0 * right[0].width.Value(0.0), 5.5);
  EXPECT_EQ(right[1].width.Value(0.0), 0.5);
  EXPECT_EQ(right[1].materials[0].surface, "asphalt");
  EXPECT_EQ(*road_.SpeedLimitAt(right[0], 100.0), 70.0 / 3.6);
}

TEST_F(N222, CurvatureHasNoJumps) {
  const auto& elements = road_.axis().elements();
  ASSERT_GT(elements.size(), 50u);
  for (std::size_t i = 1; i < elements.size(); ++i)
    EXPECT_EQ(elements[i - 1].curvature_end_1pm, elements[i].curvature_start_1pm) << i;
  EXPECT_TRUE(WorldWarnings(SourceDir() + "/configs/worlds/n222.yaml").empty());
}

// The world file changed its version; the road did not move.
TEST_F(N222, LiesWhereItDidInVersion1) {
  ASSERT_EQ(road_.length_m(), N222Road().length_m());
  for (std::uint64_t i = 0; i < 5000; ++i) {
    const double s = base::RandomUniform({i, 1}, 0.0, road_.length_m()),
                 t = base::RandomUniform({i, 2}, -kEdge_m, kEdge_m);
    ASSERT_NEAR((road_.Surface(s, t).p_W - N222Road().Position(s, t)).norm(), 0.0, 1e-6) << s << " " << t;
  }
  const StartPose &start = world_.start(), &before = N222OfVersion1()->start();
  EXPECT_EQ(start.lane, before.lane);
  EXPECT_NEAR(std::hypot(start.x_m - before.x_m, start.y_m - before.y_m), 0.0, 1e-9);
  EXPECT_EQ(world_.extents().west_m, N222OfVersion1()->extents().west_m);
}

// Paint is where it was, so that overtaking is legal where it was.
TEST_F(N222, IsPaintedAsItWasInVersion1) {
  const auto now = world_.MakeGround(), before = N222OfVersion1()->MakeGround();
  int painted = 0, differ = 0;
  for (std::uint64_t i = 0; i < 40'000; ++i) {
    const double s = base::RandomUniform({i, 3}, 0.0, road_.length_m()), t = (i % 3 == 0   ? -2.96
                                                                              : i % 3 == 1 ? 2.96
                                                                                           : 0.0) +
                                                                             base::RandomUniform({i, 4}, -0.08, 0.08);
    const Eigen::Vector3d p = N222Road().Position(s, t);
    const bool is = now->At(p.x(), p.y()).surface == ground::Surface::kRoadMark,
               was = before->At(p.x(), p.y()).surface == ground::Surface::kRoadMark;
    painted += is, differ += is != was;
  }
  EXPECT_GT(painted, 10'000);
  EXPECT_LE(differ, 2) << "at most where a point falls on an edge";
}

TEST_F(N222, HasHillsAndGradesOnWhichCarsDrive) {
  const auto heights = world_.grid()->heights_m();
  EXPECT_EQ(world_.grid()->frame().columns, 513);
  EXPECT_GT(*std::max_element(heights.begin(), heights.end()) - *std::min_element(heights.begin(), heights.end()),
            200.0F);
  double up = 0.0, down = 0.0;
  for (double s = 0.0; s < road_.length_m(); s += 1.0) {
    up = std::max(up, GradeAt(road_, s)), down = std::min(down, GradeAt(road_, s));
    EXPECT_LT(std::fabs(road_.spec().elevation.Evaluate(s).bend), 1.0 / 400.0) << s;
  }
  EXPECT_TRUE(up > 0.04 && up < 0.08) << up;
  EXPECT_TRUE(down < -0.04 && down > -0.08) << down;
  EXPECT_FALSE(world_.grid()->projection_wkt().empty());
}

// All of a bend to the left with its clothoids, at more than 4 %.
TEST_F(N222, ClimbsThroughABendToTheLeft) {
  int climbing = 0;
  double from_m = 0.0, least = 1.0;
  for (double s = 0.0; s < road_.length_m(); s += 0.5) {
    if (road_.axis().Evaluate(s).curvature_1pm > 1e-9) {
      if (from_m == 0.0) from_m = s, least = 1.0;
      least = std::min(least, GradeAt(road_, s));
    } else if (from_m > 0.0) {
      if (least > 0.04 && s - from_m > 60.0) ++climbing;
      from_m = 0.0;
    }
  }
  EXPECT_GE(climbing, 1);
}

TEST_F(N222, MarksKeepTheConventionsMeasures) {
  int dashed = 0;
  for (const network::PaintedLine& line : road_.spec().lines) {
    EXPECT_GE(line.width_m, 0.10);
    if (line.gap_m == 0.0) continue;
    ++dashed;
    EXPECT_TRUE(line.stroke_m >= 2.0 && line.stroke_m <= 10.0);
    // Ordinary strokes are shorter than their gaps; approach strokes are two to three times as long.
    EXPECT_TRUE(line.stroke_m < line.gap_m || (line.stroke_m >= 2.0 * line.gap_m && line.stroke_m <= 3.0 * line.gap_m));
  }
  EXPECT_GT(dashed, 10);
}

// Ordinary strokes on the middle line: there overtaking is legal. Everywhere on such a stretch a driver's eye sees the
// roof of an oncoming car (1.2 m both) 100 m on, over the land that lies between.
TEST_F(N222, OvertakingIsLegalWhereOneSeesFarEnough) {
  double all_m = 0.0, longest_m = 0.0;
  for (const network::PaintedLine& line : road_.spec().lines) {
    if (std::fabs(line.t.Value(line.from_s_m)) > 0.2 || line.gap_m == 0.0 || line.stroke_m > line.gap_m) continue;
    const double length_m = line.to_s_m - line.from_s_m;
    all_m += length_m;
    longest_m = std::max(longest_m, length_m);
    for (double s = line.from_s_m; s <= line.to_s_m; s += 10.0) {
      if (s + 100.0 > line.to_s_m) continue;
      const Eigen::Vector3d up(0.0, 0.0, 1.2), eye = road_.Surface(s, -1.5).p_W + up,
                                               roof = road_.Surface(s + 100.0, 1.5).p_W + up;
      for (double share = 0.05; share < 1.0; share += 0.05) {
        const Eigen::Vector3d sight = eye + share * (roof - eye);
        EXPECT_GT(sight.z(), world_.At(sight.x(), sight.y()).z_m) << s << " " << share;
      }
    }
  }
  EXPECT_GT(all_m, 2000.0);
  EXPECT_GT(longest_m, 1000.0);
}

TEST_F(N222, TheRoadIsWhereTheGroundIs) {
  const auto ground = world_.MakeGround();
  for (std::uint64_t i = 0; i < 5000; ++i) {
    const double s = base::RandomUniform({i, 1}, 0.0, road_.length_m()), t = base::RandomUniform({i, 2}, -3.39, 3.39);
    const Eigen::Vector3d p = road_.Surface(s, t).p_W;
    const ground::GroundPoint at = ground->At(p.x(), p.y());
    EXPECT_NEAR(at.z_m, p.z(), 1e-9);
    EXPECT_TRUE(at.surface == ground::Surface::kAsphalt || at.surface == ground::Surface::kRoadMark);
  }
}

// The road is cut into the hills and stands on fills, and neither is steeper than the file says.
TEST_F(N222, IsCutIntoTheHillsAndFilled) {
  int cut = 0, filled = 0;
  for (double s = 2.0; s < road_.length_m(); s += 5.0) {
    for (const double side : {-1.0, 1.0}) {
      const Eigen::Vector3d edge = road_.Surface(s, side * kEdge_m).p_W;
      const Eigen::Vector3d beside = road_.Surface(s, side * (kEdge_m + 3.0)).p_W;
      const SurfacePoint at = world_.At(beside.x(), beside.y()), hill = world_.TerrainAt(beside.x(), beside.y());
      cut += at.z_m<hill.z_m - 0.1, filled += at.z_m> hill.z_m + 0.1;
      EXPECT_LT(at.z_m - edge.z(), 3.0 / 1.5 + 0.2) << s;
      EXPECT_GT(at.z_m - edge.z(), -3.0 / 2.0 - 0.2) << s;
    }
  }
  EXPECT_GT(cut, 20);
  EXPECT_GT(filled, 20);
}

// Beyond a rail the land falls away, 12 m beside the verge more than 2 m on most of its length; and nowhere does it
// fall by 4 m without a rail.
TEST_F(N222, GuardRailsStandOnTheValleysSide) {
  const network::Furniture furniture = network::PlaceFurniture(*world_.network());
  const auto fall = [&](double s, double side) {
    const Eigen::Vector3d edge = road_.Surface(s, side * kEdge_m).p_W,
                          beside = road_.Surface(s, side * (kEdge_m + 12.0)).p_W;
    return edge.z() - world_.At(beside.x(), beside.y()).z_m;
  };
  int railed = 0, falling = 0;
  for (const network::PlacedRun& run : furniture.runs) {
    ASSERT_EQ(run.object->subtype, "guard_rail");
    for (double s = run.from_s_m; s <= run.to_s_m; s += 3.0)
      ++railed, falling += fall(s, run.t_start_m > 0.0 ? 1.0 : -1.0) > 2.0;
  }
  EXPECT_GT(railed, 300);
  EXPECT_GT(falling, 7 * railed / 10);
  for (double s = 3.0; s < road_.length_m(); s += 3.0) {
    for (const double side : {-1.0, 1.0}) {
      if (fall(s, side) < 4.0 || std::fabs(road_.axis().Evaluate(s).curvature_1pm) * (kEdge_m + 12.0) > 0.5) continue;
      const bool held = std::any_of(furniture.runs.begin(), furniture.runs.end(), [&](const auto& run) {
        return run.t_start_m * side > 0.0 && run.from_s_m <= s && s <= run.to_s_m;
      });
      EXPECT_TRUE(held) << s << " " << side;
    }
  }
}

// Limits, warnings and chevrons beside the road, each before its bend; trees, vines, houses and posts: none on the
// road, none in another's place.
TEST_F(N222, SignsAndThingsStandBesideTheRoad) {
  const network::Furniture furniture = network::PlaceFurniture(*world_.network());
  std::map<std::string, int> count;
  for (const network::Placed& placed : furniture.things) {
    ++count[placed.signal != nullptr ? placed.signal->name : placed.object->subtype];
    const auto place = world_.network()->Locate(placed.foot_W.x(), placed.foot_W.y());
    ASSERT_TRUE(place);
    const bool post = placed.object != nullptr && placed.object->subtype == "post";
    EXPECT_GT(std::fabs(place->t_m), placed.signal != nullptr ? 4.0 : post ? 3.6 : kEdge_m + 4.0) << placed.s_m;
    if (placed.signal == nullptr || !placed.signal->name.starts_with("bend_")) continue;
    // Within 200 m on, as its reader goes, the road bends to that side, with a radius of at most 50 m.
    const double way = placed.signal->orientation == "-" ? -1.0 : 1.0,
                 to_left = placed.signal->name == "bend_left" ? 1.0 : -1.0;
    double first = 0.0;
    for (double ahead = 0.0; ahead < 200.0 && std::fabs(first) < 1.0 / 51.0; ahead += 1.0)
      first = way * road_.axis().Evaluate(placed.s_m + way * ahead).curvature_1pm;
    EXPECT_GT(first * to_left, 1.0 / 51.0) << placed.signal->name << " " << placed.s_m;
  }
  for (const char* kind :
       {"speed_limit", "bend_left", "bend_right", "uphill", "downhill", "chevron", "post", "tree", "bush", "house"})
    EXPECT_GT(count[kind], 1) << kind;
}

}  // namespace
}  // namespace rodeira::road
