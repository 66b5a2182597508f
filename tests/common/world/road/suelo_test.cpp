// SPDX-License-Identifier: Apache-2.0
// SUELO on worlds: what it answers, that the ground has no steps, that nothing but the world decides a bit.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "common/core/base/random.hpp"
#include "tests/common/world/road/sample_world.hpp"

namespace rodeira::road {
namespace {

using ground::GroundPoint;
using ground::GroundQuery;
using ground::Surface;

bool SameBits(const GroundPoint& a, const GroundPoint& b) {
  return std::memcmp(&a.z_m, &b.z_m, sizeof(double)) == 0 &&
         std::memcmp(a.normal_W.data(), b.normal_W.data(), 3 * sizeof(double)) == 0 &&
         std::memcmp(&a.friction, &b.friction, sizeof(double)) == 0 && a.surface == b.surface && a.inside == b.inside;
}

// Points near the road, near its ends, and anywhere, outside of the terrain too.
GroundQuery AnyPoint(const World& world, std::uint64_t seed, std::uint64_t i) {
  const auto draw = [&](std::uint64_t part, double low, double high) {
    return base::RandomUniform({seed, i, part}, low, high);
  };
  const Extents e = world.extents();
  if (i % 4 == 0) return {draw(0, e.west_m - 20.0, e.east_m + 20.0), draw(1, e.south_m - 20.0, e.north_m + 20.0)};
  const Version1Road& road = SampleRoad();
  if (i % 4 == 1) {
    const Eigen::Vector3d end = road.Evaluate(i % 8 == 1 ? 0.0 : road.length_m()).p_W;
    return {end.x() + draw(0, -16.0, 16.0), end.y() + draw(1, -16.0, 16.0)};
  }
  const Eigen::Vector3d p = road.Position(draw(0, 0.0, road.length_m()), draw(1, -16.0, 16.0));
  return {p.x(), p.y(), draw(2, 0.0, 300.0)};
}

TEST(Suelo, ShowsTheCrossfall) {
  const auto world = Sample();
  const Version1Road& road = SampleRoad();
  const auto ground = world->MakeGround();
  for (const double s : {20.0, 110.0, 140.0, 200.0, 290.0}) {
    const RoadFrame frame = road.Evaluate(s);
    const Eigen::Vector3d along(std::cos(frame.heading_rad), std::sin(frame.heading_rad), 0.0);
    const Eigen::Vector3d left(-along.y(), along.x(), 0.0);
    const auto at = [&](double t) {
      const Eigen::Vector3d p = road.Position(s, t);
      return ground->At(p.x(), p.y());
    };
    EXPECT_NEAR(at(2.0).z_m - at(1.0).z_m, -0.025, 1e-9) << s;
    EXPECT_NEAR(at(-2.0).z_m - at(-1.0).z_m, -0.025, 1e-9) << s;
    EXPECT_NEAR(at(-4.0).z_m - at(-3.5).z_m, -0.03, 1e-9) << s;  // the gravel shoulder
    // The normal leans outward by the crossfall, and backward by the grade as the offset line sees it.
    const Eigen::Vector3d normal = at(2.0).normal_W;
    EXPECT_NEAR(normal.dot(left) / normal.z(), 0.025, 1e-9) << s;
    EXPECT_NEAR(-normal.dot(along) / normal.z(), frame.grade / (1.0 - frame.curvature_1pm * 2.0), 1e-9) << s;
    EXPECT_EQ(at(1.4).surface, Surface::kAsphalt);
    EXPECT_EQ(at(1.4).friction, 0.95);
    EXPECT_EQ(at(-3.3).surface, Surface::kRoadMark);
    EXPECT_EQ(at(-3.3).friction, 0.9);
    EXPECT_EQ(at(-4.0).surface, Surface::kGravel);
    EXPECT_EQ(at(-5.0).surface, Surface::kGrass);
    EXPECT_EQ(at(-9.0).surface, Surface::kSoil);
  }
}

TEST(Suelo, IsTheTerrainAwayFromTheRoad) {
  const auto world = Sample();
  const auto ground = world->MakeGround();
  int compared = 0;
  for (std::uint64_t i = 0; i < 5000; ++i) {
    const GroundQuery q = AnyPoint(*world, 3, i);
    const double distance = SampleRoad().plan().Project(q.x_m, q.y_m).distance_m;
    if (distance < SampleRoad().section().reach_m()) continue;
    const terrain::GridSample sample = world->grid()->At(q.x_m, q.y_m);
    const GroundPoint point = ground->At(q.x_m, q.y_m);
    ASSERT_EQ(point.inside, sample.inside);
    if (!point.inside) {
      EXPECT_EQ(point.surface, Surface::kOutside);
      EXPECT_EQ(point.friction, 0.0);
      continue;
    }
    EXPECT_EQ(point.z_m, sample.z_m);
    EXPECT_NEAR((point.normal_W - sample.normal_W()).norm(), 0.0, 1e-14);
    ++compared;
  }
  EXPECT_GT(compared, 500);
}

RC_GTEST_PROP(Suelo, HasNoStepsAndUnitNormals, (std::uint64_t seed)) {
  // The sample's terrain rises by up to about 1 in 1 and the blend adds 1.5 times its step over its width: a slope of 8
  // is beyond both, and a millimetre then changes the height by less than 8 mm, where a crack would be centimetres.
  const auto world = Sample();
  for (std::uint64_t i = 0; i < 300; ++i) {
    const GroundQuery q = AnyPoint(*world, seed, i);
    const double angle = base::RandomUniform({seed, i, 9}, 0.0, 6.283);
    const SurfacePoint a = world->At(q.x_m, q.y_m);
    const SurfacePoint b = world->At(q.x_m + 1e-3 * std::cos(angle), q.y_m + 1e-3 * std::sin(angle));
    if (!a.inside || !b.inside) continue;
    const double steepest = std::max(std::hypot(a.slope_x, a.slope_y), std::hypot(b.slope_x, b.slope_y));
    RC_ASSERT(steepest < 8.0);
    // Where a kink of the ground lies between the two points the steeper side bounds the change.
    RC_ASSERT(std::fabs(a.z_m - b.z_m) <= 1e-3 * steepest + 1e-5);
    RC_ASSERT(std::fabs(world->MakeGround()->At(q.x_m, q.y_m).normal_W.norm() - 1.0) < 1e-14);
  }
}

TEST(Suelo, HasNoStepAtAnyEdgeOfTheSection) {
  const auto world = Sample();
  const Version1Road& road = SampleRoad();
  const Section& section = road.section();
  std::vector<double> edges = {section.blend_left_m(), section.blend_right_m()};
  for (const Band& band : section.bands()) edges.push_back(band.from_t_m), edges.push_back(band.to_t_m);
  for (const double t : edges) {
    for (double s = 0.5; s < road.length_m(); s += 0.37) {
      const Eigen::Vector3d inner = road.Position(s, t - 0.5e-6), outer = road.Position(s, t + 0.5e-6);
      const SurfacePoint a = world->At(inner.x(), inner.y()), b = world->At(outer.x(), outer.y());
      ASSERT_TRUE(a.inside && b.inside);
      EXPECT_NEAR(a.z_m, b.z_m, 1e-5) << "s " << s << " t " << t;
    }
  }
}

TEST(Suelo, SlopesAreTheDerivativesOfTheHeight) {
  const auto world = Sample();
  const double h = 1e-4;
  int compared = 0, kinks = 0;
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    const GroundQuery q = AnyPoint(*world, 5, i);
    const SurfacePoint at = world->At(q.x_m, q.y_m);
    const SurfacePoint east = world->At(q.x_m + h, q.y_m), west = world->At(q.x_m - h, q.y_m);
    const SurfacePoint north = world->At(q.x_m, q.y_m + h), south = world->At(q.x_m, q.y_m - h);
    if (!at.inside || !east.inside || !west.inside || !north.inside || !south.inside) continue;
    ++compared;
    const double dx = std::fabs((east.z_m - west.z_m) / (2.0 * h) - at.slope_x);
    const double dy = std::fabs((north.z_m - south.z_m) / (2.0 * h) - at.slope_y);
    if (std::max(dx, dy) > 1e-5) ++kinks;  // the edge of a triangle or of a strip runs between the points
  }
  EXPECT_GT(compared, 15'000);
  EXPECT_LT(kinks, compared / 500);
}

RC_GTEST_PROP(Suelo, APatchIsItsPoints, (std::uint64_t seed)) {
  const auto world = Sample();
  const GroundQuery middle = AnyPoint(*world, seed, 2 + seed % 2);
  const ground::GroundPatch patch{middle.x_m, middle.y_m,     base::RandomUniform({seed, 1}, -3.0, 3.0), 0.2, 0.18, 20,
                                  20,         middle.z_hint_m};
  std::vector<GroundPoint> points(patch.size());
  world->MakeGround()->Patch(patch, points);
  for (int row = 0; row < patch.along; ++row) {
    for (int column = 0; column < patch.across; ++column) {
      const GroundQuery query = ground::PatchPoint(patch, row, column);
      RC_ASSERT(SameBits(points[static_cast<std::size_t>(row * patch.across + column)],
                         world->MakeGround()->At(query.x_m, query.y_m, query.z_hint_m)));
    }
  }
  RC_ASSERT(world->MakeGround()->Layers(middle.x_m, middle.y_m).size() <= 1);
}

RC_GTEST_PROP(Suelo, BatchOrderAndHistoryChangeNoBit, (std::uint64_t seed)) {
  const auto world = Sample();
  std::vector<GroundQuery> queries;
  for (std::uint64_t i = 0; i < 97; ++i) queries.push_back(AnyPoint(*world, seed, i));
  std::vector<GroundPoint> batch(queries.size());
  world->MakeGround()->Query(queries, batch);
  // One by one, backward, on a ground that has answered other things before; with another hint.
  const auto other = world->MakeGround();
  for (std::uint64_t i = 0; i < 50; ++i)
    (void)other->At(AnyPoint(*world, seed + 1, i).x_m, AnyPoint(*world, seed + 1, i).y_m);
  for (std::size_t i = queries.size(); i-- > 0;)
    RC_ASSERT(SameBits(batch[i], other->At(queries[i].x_m, queries[i].y_m)));
  // Shuffled, in a world read anew.
  std::vector<std::size_t> order(queries.size());
  std::iota(order.begin(), order.end(), 0u);
  for (std::size_t i = order.size() - 1; i > 0; --i) std::swap(order[i], order[base::RandomBits({seed, i}) % (i + 1)]);
  std::vector<GroundQuery> shuffled;
  for (const std::size_t i : order) shuffled.push_back(queries[i]);
  static const auto again = MustParse(kSample);
  std::vector<GroundPoint> points(shuffled.size());
  again->MakeGround()->Query(shuffled, points);
  for (std::size_t i = 0; i < order.size(); ++i) RC_ASSERT(SameBits(points[i], batch[order[i]]));
}

// A grid larger than the processor's caches, with heights that are fetched ahead of the questions: at its edges and
// beyond too.
TEST(Suelo, ALargeGridIsItselfInABatch) {
  constexpr int kColumns = 1300, kRows = 900;
  std::vector<float> heights;
  for (std::uint64_t i = 0; i < kColumns * kRows; ++i)
    heights.push_back(static_cast<float>(base::RandomUniform({i, 5}, 0.0, 50.0)));
  WorldSpec spec;
  spec.grid = std::make_shared<terrain::ElevationGrid>(
      terrain::ElevationGrid::Frame{kColumns, kRows, -100.0, 50.0, -100.0 + 8.0 * (kColumns - 1),
                                    50.0 + 8.0 * (kRows - 1)},
      std::move(heights));
  const auto world = World::Make(spec);
  const Extents e = world->extents();
  std::vector<GroundQuery> queries = {{e.west_m, e.south_m}, {e.east_m, e.north_m}, {e.east_m, e.south_m},
                                      {e.west_m, e.north_m}, {std::nan(""), 60.0},  {1e300, -1e300}};
  for (std::uint64_t i = 0; i < 5000; ++i) {
    queries.push_back({base::RandomUniform({i, 6}, e.west_m - 50.0, e.east_m + 50.0),
                       base::RandomUniform({i, 7}, e.south_m - 50.0, e.north_m + 50.0)});
  }
  std::vector<GroundPoint> points(queries.size());
  world->MakeGround()->Query(queries, points);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const terrain::GridSample alone = spec.grid->At(queries[i].x_m, queries[i].y_m);
    ASSERT_EQ(points[i].inside, alone.inside);
    ASSERT_EQ(points[i].z_m, alone.inside ? alone.z_m : 0.0);
  }
}

TEST(Suelo, APlaneWorldNeedsNoRoad) {
  const auto world = MustParse(
      "rodeira: world/1\nname: plane\nground: {kind: plane, z_m: 2, slope_x: 0.05, slope_y: -0.02, friction: 0.8}\n");
  const auto ground = world->MakeGround();
  const GroundPoint at = ground->At(1000.0, 50.0);
  EXPECT_NEAR(at.z_m, 2.0 + 50.0 - 1.0, 1e-12);
  EXPECT_NEAR((at.normal_W - Eigen::Vector3d(-0.05, 0.02, 1.0).normalized()).norm(), 0.0, 1e-15);
  EXPECT_EQ(at.friction, 0.8);
  EXPECT_EQ(at.surface, Surface::kAsphalt);
  EXPECT_TRUE(ground->At(1e9, -1e9).inside);
  EXPECT_FALSE(ground->At(std::nan(""), 0.0).inside);
  EXPECT_TRUE(std::isinf(world->extents().east_m));
}

TEST(Suelo, ARoadOnAPlaneIsBlendedIntoIt) {
  auto text = kSample;
  const auto from = text.find("terrain:"), to = text.find("start: {road");
  text.replace(from, to - from, "ground: {kind: plane, z_m: 95, surface: gravel}\n");
  const auto world = MustParse(text);
  const Version1Road& road = SampleRoad();
  const Eigen::Vector3d on = road.Position(150.0, 1.5), off = road.Position(150.0, 30.0);
  EXPECT_NEAR(world->At(on.x(), on.y()).z_m, on.z(), 1e-9);
  EXPECT_EQ(world->At(off.x(), off.y()).z_m, 95.0);
  EXPECT_EQ(world->At(off.x(), off.y()).surface, Surface::kGravel);
  // In the middle of the blend: half the verge's prolongation, half the plane.
  const Eigen::Vector3d middle = road.Position(150.0, road.section().verge_left_m() + 4.0);
  EXPECT_NEAR(world->At(middle.x(), middle.y()).z_m, 0.5 * (middle.z() + 95.0), 1e-9);
}

}  // namespace
}  // namespace rodeira::road
