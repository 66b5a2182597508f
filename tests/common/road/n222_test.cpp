// The world that is shipped is what it says it is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "common/base/random.hpp"
#include "common/road/world.hpp"
#include "tests/tree.hpp"

namespace rodeira::road {
namespace {

class N222 : public ::testing::Test {
 protected:
  void SetUp() override {
    static const auto loaded = World::Load(std::filesystem::path(SourceDir()) / "configs/worlds/n222.yaml");
    ASSERT_TRUE(loaded.ok()) << loaded.error().Text();
    world_ = loaded.value();
  }
  std::shared_ptr<const World> world_;
};

TEST_F(N222, IsAsLongBentAndWideAsItsModel) {
  const Road& road = world_->roads()[0];
  EXPECT_GT(road.length_m(), 5000.0);
  int bends = 0;
  for (const geometry::PlanPiece& piece : road.plan().pieces()) {
    const double curvature = std::max(std::fabs(piece.curvature_start_1pm), std::fabs(piece.curvature_end_1pm));
    if (curvature == 0.0) continue;
    EXPECT_TRUE(curvature <= 1.0 / 30.0 && curvature >= 1.0 / 200.0) << 1.0 / curvature;
    if (piece.curvature_start_1pm == piece.curvature_end_1pm) ++bends;
  }
  EXPECT_NEAR(bends / road.length_m() * 1000.0, 3.4, 0.35);  // 93 bends on 27 km
  const Section& section = road.section();
  EXPECT_GE(section.lanes_left_m() - section.lanes_right_m(), 5.5);
  EXPECT_EQ(section.spec().left.width_m, 0.5);
  EXPECT_EQ(section.spec().right.surface, terrain::Surface::kAsphalt);
}

TEST_F(N222, CurvatureHasNoJumps) {
  const auto& pieces = world_->roads()[0].plan().pieces();
  for (std::size_t i = 1; i < pieces.size(); ++i) EXPECT_EQ(pieces[i - 1].curvature_end_1pm, pieces[i].curvature_start_1pm) << i;
}

TEST_F(N222, HasHillsAndGradesOnWhichCarsDrive) {
  const auto heights = world_->grid()->heights_m();
  EXPECT_EQ(world_->grid()->frame().columns, 513);
  EXPECT_GT(*std::max_element(heights.begin(), heights.end()) - *std::min_element(heights.begin(), heights.end()), 200.0F);
  double up = 0.0, down = 0.0;
  for (double s = 0.0; s < world_->roads()[0].length_m(); s += 1.0) {
    const RoadFrame at = world_->roads()[0].Evaluate(s);
    up = std::max(up, at.grade), down = std::min(down, at.grade);
    EXPECT_LT(std::fabs(at.vertical_curvature_1pm), 1.0 / 400.0) << s;
  }
  EXPECT_TRUE(up > 0.04 && up < 0.08) << up;
  EXPECT_TRUE(down < -0.04 && down > -0.08) << down;
  EXPECT_FALSE(world_->grid()->projection_wkt().empty());
}

TEST_F(N222, MarksKeepTheConventionsMeasures) {
  for (const Mark& mark : world_->roads()[0].marks()) {
    EXPECT_GE(mark.width_m, 0.10);
    if (!mark.dashed()) continue;
    EXPECT_TRUE(mark.stroke_m >= 2.0 && mark.stroke_m <= 10.0);
    // Ordinary strokes are shorter than their gaps; approach strokes are two to three times as long.
    EXPECT_TRUE(mark.stroke_m < mark.gap_m || (mark.stroke_m >= 2.0 * mark.gap_m && mark.stroke_m <= 3.0 * mark.gap_m));
  }
}

// Ordinary strokes on the middle line: there overtaking is legal. Everywhere on such a stretch a driver's eye sees the roof of an oncoming
// car (1.2 m both) 100 m on, over the land that lies between.
TEST_F(N222, OvertakingIsLegalWhereOneSeesFarEnough) {
  const Road& road = world_->roads()[0];
  double all_m = 0.0, longest_m = 0.0;
  for (const Mark& mark : road.marks()) {
    if (std::fabs(mark.t_m) > 0.2 || !mark.dashed() || mark.stroke_m > mark.gap_m) continue;
    const double length_m = mark.to_s_m - mark.from_s_m;
    all_m += length_m;
    longest_m = std::max(longest_m, length_m);
    for (double s = mark.from_s_m; s <= mark.to_s_m; s += 10.0) {
      if (s + 100.0 > mark.to_s_m) continue;
      const Eigen::Vector3d up(0.0, 0.0, 1.2), eye = road.Position(s, -1.5) + up, roof = road.Position(s + 100.0, 1.5) + up;
      for (double share = 0.05; share < 1.0; share += 0.05) {
        const Eigen::Vector3d sight = eye + share * (roof - eye);
        EXPECT_GT(sight.z(), world_->At(sight.x(), sight.y()).z_m) << s << " " << share;
      }
    }
  }
  EXPECT_GT(all_m, 2000.0);
  EXPECT_GT(longest_m, 1000.0);
}

TEST_F(N222, TheRoadIsWhereTheGroundIs) {
  const auto ground = world_->MakeGround();
  const Road& road = world_->roads()[0];
  for (std::uint64_t i = 0; i < 5000; ++i) {
    const double s = base::RandomUniform({i, 1}, 0.0, road.length_m()), t = base::RandomUniform({i, 2}, -3.4, 3.4);
    const Eigen::Vector3d p = road.Position(s, t);
    const terrain::GroundPoint at = ground->At(p.x(), p.y());
    EXPECT_NEAR(at.z_m, p.z(), 1e-9);
    EXPECT_TRUE(at.surface == terrain::Surface::kAsphalt || at.surface == terrain::Surface::kRoadMark);
  }
  const StartPose& start = world_->start();
  EXPECT_EQ(start.lane, -1);
  EXPECT_NEAR(road.Locate(start.x_m, start.y_m)->t_m, road.LaneCentre(-1, start.s_m), 1e-9);
}

}  // namespace
}  // namespace rodeira::road
