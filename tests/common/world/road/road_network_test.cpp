// SPDX-License-Identifier: Apache-2.0
// A world file's road as a network road: the same surface, lanes, limits and paint.
#include "common/world/road/road_network.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "common/core/base/random.hpp"
#include "common/world/network/strokes.hpp"
#include "common/world/road/world.hpp"
#include "tests/common/world/road/sample_world.hpp"
#include "tests/n222.hpp"

namespace rodeira::road {
namespace {

void ExpectTheSame(const World& world, const Version1Road& road) {
  ASSERT_NE(world.network(), nullptr);
  EXPECT_FALSE(world.open_drive());
  const network::Network& network = *world.network();
  const network::Road& ours = network.roads()[0];
  EXPECT_NEAR(ours.length_m(), road.length_m(), 1e-9);
  const auto [low, high] = network.Bounds();
  for (std::uint64_t i = 0; i < 5000; ++i) {
    const double s = base::RandomUniform({i, 1}, 0.01, road.length_m() - 0.01);
    const double t =
        base::RandomUniform({i, 2}, road.section().verge_right_m() + 1e-3, road.section().verge_left_m() - 1e-3);
    const Eigen::Vector3d p = road.Position(s, t);
    EXPECT_NEAR((ours.Surface(s, t).p_W - p).norm(), 0.0, 1e-8) << s << " " << t;
    const SurfacePoint at = world.At(p.x(), p.y());
    const Eigen::Vector3d normal = ours.Surface(s, t).ds_W.cross(ours.Surface(s, t).dt_W);
    EXPECT_NEAR(at.z_m, p.z(), 1e-8);
    EXPECT_NEAR(at.slope_x, -normal.x() / normal.z(), 1e-8);
    EXPECT_NEAR(at.slope_y, -normal.y() / normal.z(), 1e-8);
    EXPECT_TRUE(p.x() > low.x() && p.y() > low.y() && p.x() < high.x() && p.y() < high.y());
    const auto place = network.Locate(p.x(), p.y());
    ASSERT_TRUE(place.has_value());
    EXPECT_EQ(place->distance_m, 0.0);
    EXPECT_NEAR(place->s_m, s, 1e-6);
    EXPECT_NEAR(place->t_m, t, 1e-6);
    const network::Lane& lane = *network.Find(place->lane);
    const Lane* theirs = road.LaneAt(t);
    if (theirs != nullptr) {
      EXPECT_EQ(lane.id, theirs->id);
      EXPECT_EQ(lane.direction, theirs->direction);
      EXPECT_NEAR(*ours.SpeedLimitAt(lane, s), theirs->speed_limit_mps, 1e-12);
    }
    if (at.surface != ground::Surface::kRoadMark) {
      EXPECT_EQ(ours.MaterialAt(lane, s)->surface, SurfaceName(at.surface));
      EXPECT_EQ(*ours.MaterialAt(lane, s)->friction, at.friction);
    }
  }
}

TEST(RoadNetwork, TheSampleIsTheSame) { ExpectTheSame(*Sample(), SampleRoad()); }

TEST(RoadNetwork, N222OfVersion1IsTheSame) { ExpectTheSame(*N222OfVersion1(), N222Road()); }

TEST(RoadNetwork, LinesArePaintedWhereTheMarksWere) {
  const auto world = Sample();
  const Version1Road& road = SampleRoad();
  const network::Road& ours = world->network()->roads()[0];
  ASSERT_EQ(ours.spec().lines.size(), road.marks().size());
  for (std::size_t i = 0; i < road.marks().size(); ++i) {
    const auto wanted = road.Strokes(road.marks()[i]);
    const auto found = network::Strokes(ours, ours.spec().lines[i]);
    ASSERT_EQ(found.size(), wanted.size()) << i;
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      EXPECT_NEAR(found[k].from_s_m, wanted[k].from_s_m, 1e-8) << i << " " << k;
      EXPECT_NEAR(found[k].to_s_m, wanted[k].to_s_m, 1e-8) << i << " " << k;
    }
  }
  EXPECT_EQ(ours.spec().lines[1].colour, "yellow");
}

TEST(RoadNetwork, AWorldWithoutRoadsHasNoNetwork) {
  const auto plane = World::Load(std::filesystem::path(SourceDir()) / "configs/worlds/plane.yaml").value();
  EXPECT_EQ(plane->network(), nullptr);
}

}  // namespace
}  // namespace rodeira::road
