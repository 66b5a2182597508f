// SPDX-License-Identifier: Apache-2.0
#include "common/world/terrain/elevation_grid.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "common/core/base/random.hpp"
#include "common/world/terrain/nearest_ground.hpp"

namespace rodeira::terrain {
namespace {

ElevationGrid Rough(int columns, int rows, std::uint64_t seed) {
  std::vector<float> heights;
  for (int i = 0; i < columns * rows; ++i)
    heights.push_back(static_cast<float>(base::RandomUniform({seed, std::uint64_t(i)}, -20.0, 20.0)));
  return ElevationGrid({columns, rows, 100.0, 200.0, 100.0 + 10.0 * (columns - 1), 200.0 + 5.0 * (rows - 1)},
                       std::move(heights));
}

TEST(ElevationGrid, SplitsACellFromSouthEastToNorthWest) {
  // Only the north-east post is raised: south-west of the diagonal nothing of it is seen.
  const ElevationGrid grid({2, 2, 0.0, 0.0, 10.0, 10.0}, {0.0F, 0.0F, 0.0F, 8.0F});
  EXPECT_EQ(grid.At(4.0, 5.0).z_m, 0.0);
  EXPECT_EQ(grid.At(4.0, 5.0).normal_W(), Eigen::Vector3d::UnitZ());
  EXPECT_NEAR(grid.At(5.0, 7.0).z_m, 8.0 * 0.2, 1e-12);  // (u + v - 1) of the height
  EXPECT_NEAR(grid.At(10.0, 10.0).z_m, 8.0, 1e-12);
  EXPECT_NEAR((grid.At(9.0, 9.0).normal_W() - Eigen::Vector3d(-0.8, -0.8, 1.0).normalized()).norm(), 0.0, 1e-12);
}

// A frame of ground, two posts wide, around a void: the nearest place with ground 3 m about it is told by looking at
// every place of a fine raster.
TEST(ElevationGrid, FindsTheNearestGroundBesideAVoid) {
  const int columns = 21, rows = 15;
  std::vector<float> heights(static_cast<std::size_t>(columns * rows), 7.0F);
  for (int column = 3; column < 18; ++column) {
    for (int row = 3; row < 12; ++row) heights[static_cast<std::size_t>(column * rows + row)] = ElevationGrid::kVoid;
  }
  const ElevationGrid grid({columns, rows, 0.0, 0.0, 200.0, 140.0}, heights);
  const auto nearest = NearestGround(grid, 99.0, 68.0);
  ASSERT_TRUE(nearest.has_value());
  double least = std::numeric_limits<double>::infinity();
  for (double x = 3.5; x < 197.0; x += 0.5) {
    for (double y = 3.5; y < 137.0; y += 0.5) {
      bool all = true;
      for (const double dx : {-3.0, 0.0, 3.0}) {
        for (const double dy : {-3.0, 0.0, 3.0}) all = all && grid.At(x + dx, y + dy).inside;
      }
      if (all) least = std::min(least, std::hypot(x - 99.0, y - 68.0));
    }
  }
  EXPECT_TRUE(grid.At(nearest->x(), nearest->y()).inside);
  EXPECT_LT(std::hypot(nearest->x() - 99.0, nearest->y() - 68.0), least + 7.1);  // half a cell's diagonal
  EXPECT_EQ(*NearestGround(grid, 5.0, 5.0), Eigen::Vector2d(5.0, 5.0));
  const ElevationGrid none({2, 2, 0.0, 0.0, 1.0, 1.0}, std::vector<float>(4, ElevationGrid::kVoid));
  EXPECT_FALSE(NearestGround(none, 0.5, 0.5).has_value());
}

// z = 3 + x/4 - y/2 + x^2/64 + xy/32 - y^2/128 over cells of 8 m by 4 m: what the two triangles of a cell leave of it
// is known. With u and v from the cell's south-western post, of x^2 it is 64 u (u - 1), of y^2 16 v (v - 1), and of xy
// 32 u v below the diagonal, 32 (1 - u) (1 - v) above it.
TEST(ElevationGrid, OfAPolynomialLeavesWhatItsTrianglesMust) {
  const auto z = [](double x, double y) {
    return 3.0 + x / 4.0 - y / 2.0 + x * x / 64.0 + x * y / 32.0 - y * y / 128.0;
  };
  const int columns = 17, rows = 9;
  std::vector<float> heights(static_cast<std::size_t>(columns * rows));
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column)
      heights[static_cast<std::size_t>(column * rows + row)] =
          static_cast<float>(z(8.0 * column, 4.0 * row));  // exact in 24 bits
  }
  const ElevationGrid grid({columns, rows, 0.0, 0.0, 8.0 * (columns - 1), 4.0 * (rows - 1)}, std::move(heights));
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    const double x = base::RandomUniform({i, 1}, 0.0, 128.0), y = base::RandomUniform({i, 2}, 0.0, 32.0);
    const double u = x / 8.0 - std::floor(x / 8.0), v = y / 4.0 - std::floor(y / 4.0);
    const double both = u + v <= 1.0 ? u * v : (1.0 - u) * (1.0 - v);
    ASSERT_NEAR(grid.At(x, y).z_m,
                z(x, y) - 64.0 * u * (u - 1.0) / 64.0 - 32.0 * both / 32.0 + 16.0 * v * (v - 1.0) / 128.0, 1e-11)
        << x << " " << y;
  }
}

TEST(ElevationGrid, StandsOnItsPostsAndAllFourEdgesBelongToIt) {
  const ElevationGrid grid = Rough(7, 5, 1);
  for (int column = 0; column < 7; ++column) {
    for (int row = 0; row < 5; ++row) {
      const GridSample sample = grid.At(100.0 + 10.0 * column, 200.0 + 5.0 * row);
      ASSERT_TRUE(sample.inside) << column << " " << row;
      EXPECT_NEAR(sample.z_m, static_cast<double>(grid.Post(column, row)), 1e-11);
    }
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(grid.At(std::nextafter(160.0, 200.0), 210.0).inside);
  EXPECT_FALSE(grid.At(std::nextafter(100.0, 0.0), 210.0).inside);
  EXPECT_FALSE(grid.At(120.0, std::nextafter(220.0, 300.0)).inside);
  EXPECT_FALSE(grid.At(120.0, std::nextafter(200.0, 0.0)).inside);
  EXPECT_FALSE(grid.At(nan, 210.0).inside);
  EXPECT_FALSE(grid.At(120.0, nan).inside);
}

TEST(ElevationGrid, AVoidPostTakesItsTrianglesAway) {
  const ElevationGrid grid({2, 2, 0.0, 0.0, 1.0, 1.0}, {ElevationGrid::kVoid, 1.0F, 1.0F, 1.0F});
  EXPECT_FALSE(grid.At(0.2, 0.2).inside);
  EXPECT_TRUE(grid.At(0.8, 0.8).inside);
  EXPECT_EQ(grid.At(0.8, 0.8).z_m, 1.0);
}

TEST(ElevationGrid, IsContinuousAcrossEdgesAndDiagonalsToANanometre) {
  // A tile of 513 x 513 posts every 10 m from (0, 0) on, differences of up to 1000 m from post to post.
  std::vector<float> heights;
  for (std::uint64_t i = 0; i < 513 * 513; ++i)
    heights.push_back(static_cast<float>(base::RandomUniform({i, 77}, -500.0, 500.0)));
  const ElevationGrid grid({513, 513, 0.0, 0.0, 5120.0, 5120.0}, std::move(heights));
  for (std::uint64_t i = 0; i < 200'000; ++i) {
    const double column = std::floor(base::RandomUniform({i, 1}, 0.0, 512.0)),
                 row = std::floor(base::RandomUniform({i, 2}, 0.0, 512.0));
    const double share = base::RandomUniform({i, 3});
    double x = 10.0 * column, y = 10.0 * row;
    Eigen::Vector2d across(1.0, 0.0);
    if (i % 3 == 0)
      y += 10.0 * share;  // on the edge between two columns
    else if (i % 3 == 1)
      x += 10.0 * share, across = {0.0, 1.0};  // between two rows
    else
      x += 10.0 * share, y += 10.0 * (1.0 - share), across = {0.7071, 0.7071};  // on the diagonal
    const GridSample at = grid.At(x, y);
    for (const double step : {-1e-12, 1e-12}) {  // the next numbers on either side
      const GridSample beside = grid.At(x + step * across.x(), y + step * across.y());
      if (!beside.inside) continue;  // beyond the grid's own edge
      ASSERT_NEAR(at.z_m, beside.z_m, 1e-9) << i;
    }
  }
}

TEST(ElevationGrid, AnInclinedPlaneIsExactEverywhere) {
  std::vector<float> heights;
  for (int column = 0; column < 33; ++column) {
    for (int row = 0; row < 17; ++row)
      heights.push_back(static_cast<float>(4 * column - 2 * row));  // every 8 m: slopes 0.5 and -0.25
  }
  const ElevationGrid grid({33, 17, 1000.0, -500.0, 1256.0, -372.0}, std::move(heights));
  for (std::uint64_t i = 0; i < 10'000; ++i) {
    const double x = base::RandomUniform({i, 5}, 1000.0, 1256.0), y = base::RandomUniform({i, 6}, -500.0, -372.0);
    const GridSample at = grid.At(x, y);
    ASSERT_TRUE(at.inside);
    ASSERT_NEAR(at.z_m, 0.5 * (x - 1000.0) - 0.25 * (y + 500.0), 1e-12);
    ASSERT_EQ(at.slope_x, 0.5);
    ASSERT_EQ(at.slope_y, -0.25);
  }
}

RC_GTEST_PROP(ElevationGrid, HasNoCracks, (std::uint64_t seed)) {
  // Walking a millimetre never changes the height by more than the steepest slope allows.
  const ElevationGrid grid = Rough(6, 9, seed);
  const double steepest = std::hypot(40.0 / 10.0, 40.0 / 5.0);
  for (std::uint64_t i = 0; i < 200; ++i) {
    // Every other point lies close to a cell's edge or to its diagonal.
    double x = base::RandomUniform({seed, i, 1}, 100.0, 150.0), y = base::RandomUniform({seed, i, 2}, 200.0, 240.0);
    if (i % 2 == 1) x = std::round((x - 100.0) / 10.0) * 10.0 + 100.0;
    const double angle = base::RandomUniform({seed, i, 3}, 0.0, 6.28);
    const GridSample a = grid.At(x, y), b = grid.At(x + 1e-3 * std::cos(angle), y + 1e-3 * std::sin(angle));
    if (!a.inside || !b.inside) continue;
    RC_ASSERT(std::fabs(a.z_m - b.z_m) <= 1e-3 * steepest + 1e-9);
  }
}

}  // namespace
}  // namespace rodeira::terrain
