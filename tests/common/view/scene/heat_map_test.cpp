// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/heat_map/heat_raster.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/common/view/scene/worlds.hpp"

namespace rodeira::scene {
namespace {

constexpr std::int64_t kStep_ns = 20'000'000;

SceneSnapshot At(std::int64_t time_ns, const std::vector<Eigen::Vector3d>& places) {
  SceneSnapshot moment;
  moment.time_ns = time_ns;
  for (std::size_t i = 0; i < places.size(); ++i) {
    AgentPose agent;
    agent.id = i;
    agent.p_WB_W = places[i];
    moment.agents.push_back(agent);
  }
  return moment;
}

TEST(HeatMap, ColoursGoFromRedThroughYellowToGreen) {
  const auto is = [](double share, int red, int green) {
    const Colour c = HeatColour(share);
    return c.red == red && c.green == green && c.blue == 0;
  };
  EXPECT_TRUE(is(0.0, 255, 0));
  EXPECT_TRUE(is(0.25, 255, 128));
  EXPECT_TRUE(is(0.5, 255, 255));
  EXPECT_TRUE(is(0.75, 128, 255));
  EXPECT_TRUE(is(1.0, 0, 255));
  EXPECT_TRUE(is(-3.0, 255, 0));
  EXPECT_TRUE(is(7.0, 0, 255));
}

// A car that drives evenly, and one that stands, for ten seconds: distance, time and the identity q = k v in every
// square.
TEST(HeatMap, SumsAreWhatWasDrivenAndFlowIsDensityTimesSpeed) {
  const auto world = PlaneWithRoad();
  HeatMap map(*world);
  constexpr double kSpeed = 12.5;
  for (int i = 0; i <= 500; ++i) map.Add(At(i * kStep_ns, {{-60.0 + kSpeed * 0.02 * i, -70.0, 0.0}, {5.0, 60.0, 0.0}}));
  EXPECT_NEAR(map.watched_s(), 10.0, 1e-9);
  double time_s = 0.0, distance_m = 0.0;
  for (const auto& [key, cell] : map.cells()) {
    time_s += cell.time_s, distance_m += cell.distance_m;
    const double q = *map.Value(HeatKind::kFlow, cell), k = *map.Value(HeatKind::kDensity, cell),
                 v_kmh = 3.6 * cell.distance_m / cell.time_s;
    EXPECT_NEAR(q, k * v_kmh, 1e-6 * std::max(q, 1.0));
    EXPECT_FALSE(map.Value(HeatKind::kFuel, cell)) << "the traffic does not say what it burns";
  }
  EXPECT_NEAR(time_s, 20.0, 1e-9);
  EXPECT_NEAR(distance_m, 10.0 * kSpeed, 1e-6);
  // One vehicle passes a square once in 10 s: 360 an hour, where the square was crossed whole.
  const HeatCell& crossed = map.cells().at({-5, -18, 0});
  EXPECT_NEAR(*map.Value(HeatKind::kFlow, crossed), 360.0, 360.0 * 0.26 / 4.0) << "but for the step at either edge";
  EXPECT_NEAR(*map.Value(HeatKind::kSpeed, crossed), 100.0 * kSpeed / (100.0 / 3.6), 1e-6);
  const HeatCell& stood = map.cells().at({1, 15, 0});
  EXPECT_NEAR(*map.Value(HeatKind::kDensity, stood), 1000.0 / 4.0, 1e-6) << "one vehicle on 4 m all the time";
  EXPECT_EQ(*map.Value(HeatKind::kSpeed, stood), 0.0);
}

// 7.2 l/h at 72 km/h is 10 l for 100 km, in every square; a car without its fuel counts for the other statistics
// alone.
TEST(HeatMap, WhatTheTrafficSaysThatItBurns) {
  const auto world = PlaneWithRoad();
  HeatMap map(*world);
  for (int i = 0; i <= 300; ++i) {
    SceneSnapshot moment = At(i * kStep_ns, {{-60.0 + 0.4 * i, -70.0, 0.0}, {-60.0 + 0.4 * i, 60.0, 0.0}});
    moment.agents[0].detail.emplace().fuel_lph = 7.2;
    map.Add(moment);
  }
  std::size_t known = 0;
  for (const auto& [key, cell] : map.cells()) {
    const auto burnt = map.Value(HeatKind::kFuel, cell);
    ASSERT_EQ(burnt.has_value(), key.row < 0);
    if (!burnt) continue;
    EXPECT_NEAR(*burnt, 10.0, 1e-9);
    ++known;
  }
  EXPECT_GE(known, 30u);
}

TEST(HeatMap, GreenIsTheLimitOfTheLane) {
  const auto world = PlaneWithRoad();
  const Version1Road& road = PlaneRoad();
  HeatMap map(*world);
  const double speed = 0.5 * 70.0 / 3.6;
  for (int i = 0; i <= 100; ++i)
    map.Add(At(i * kStep_ns, {road.Position(20.0 + 0.02 * i * speed, road.LaneCentre(-1))}));
  for (const auto& [key, cell] : map.cells()) EXPECT_NEAR(*map.Value(HeatKind::kSpeed, cell), 50.0, 0.5);
  const HeatRaster raster = MakeHeatRaster(map, HeatKind::kSpeed, road.Position(20.0, 0.0));
  std::size_t coloured = 0;
  for (std::size_t row = 0; row < raster.rows; ++row) {
    for (std::size_t column = 0; column < raster.columns; ++column) {
      const std::uint16_t* texel = raster.At(column, row);
      if (texel[1] == 0) continue;
      ++coloured;
      EXPECT_NEAR(texel[0], 32768, 400) << "half of the limit is yellow";
      const double x = raster.west_m + 4.0 * (static_cast<double>(column) + 0.5),
                   y = raster.south_m + 4.0 * (static_cast<double>(row) + 0.5);
      EXPECT_NEAR(raster.lowest_m + raster.range_m * texel[1] / 65535.0, world->At(x, y).z_m, 0.25);
    }
  }
  EXPECT_EQ(coloured, map.cells().size());
}

// Over one square a road at 4.9 to 5.1 m, where the map's levels meet, and a bridge 6 m over it: two surfaces, each
// with its own flow.
TEST(HeatRaster, ABridgeAndTheRoadBelowAreTwoSurfacesOfASquare) {
  const auto world = PlaneWithRoad();
  HeatMap map(*world);
  for (int i = 0; i <= 200; ++i) {
    const double along = 0.2 * i, across = 0.1 * i;
    map.Add(At(i * kStep_ns, {{along - 20.0, -70.0, 5.0 + 0.1 * std::sin(3.0 * along)}, {0.5, across - 80.0, 11.0}}));
  }
  EXPECT_GT(map.cells().size(), 16u) << "both levels were met on the way";
  const HeatRaster raster = MakeHeatRaster(map, HeatKind::kSpeed, {0.0, -70.0, 5.0});
  EXPECT_EQ(raster.columns, 10u);
  EXPECT_EQ(raster.west_m, -20.0);
  EXPECT_NEAR(raster.lowest_m, 5.0, 0.1);
  const auto row = static_cast<std::size_t>((-70.0 - raster.south_m) / HeatMap::kSquare_m);
  for (std::size_t column = 0; column < raster.columns; ++column) {
    const std::uint16_t* texel = raster.At(column, row);
    EXPECT_NEAR(texel[0], 65535 * 10.0 / (100.0 / 3.6), 50.0) << "10 m/s of 100 km/h below";
    ASSERT_GT(texel[1], 0) << column;
    const bool below_the_bridge = column == 5;
    EXPECT_EQ(texel[3] != 0, below_the_bridge) << column;
    if (!below_the_bridge) continue;
    EXPECT_NEAR(texel[2], 65535 * 5.0 / (100.0 / 3.6), 50.0) << "5 m/s above";
    EXPECT_NEAR(raster.lowest_m + raster.range_m * texel[3] / 65535.0, 11.0, 0.01);
  }
  EXPECT_EQ(MakeHeatRaster(map, HeatKind::kFuel, {0.0, -70.0, 5.0}).At(3, row)[1], 0)
      << "nothing is known of their fuel";
  EXPECT_EQ(MakeHeatRaster(map, HeatKind::kSpeed, {9'000.0, -70.0, 5.0}).columns, 0u) << "too far off";
}

// In a recording one goes there and back: each way counts. A leap begins anew, a car that is placed drives nowhere.
TEST(HeatMap, BackwardCountsALeapBeginsAnewAndPlacingIsNoWay) {
  const auto world = PlaneWithRoad();
  const auto at = [](int i) { return At(i * kStep_ns, {{0.2 * i, -70.0, 0.0}}); };
  HeatMap map(*world);
  for (int i = 0; i <= 100; ++i) map.Add(at(i));
  for (int i = 99; i >= 0; --i) map.Add(at(i));
  double distance_m = 0.0;
  for (const auto& [key, cell] : map.cells()) distance_m += cell.distance_m;
  EXPECT_NEAR(distance_m, 40.0, 1e-9);
  map.Add(at(0));
  EXPECT_NEAR(map.watched_s(), 4.0, 1e-9) << "standing still";
  map.Add(at(200));
  EXPECT_TRUE(map.cells().empty());
  SceneSnapshot placed = at(201);
  placed.agents[0].p_WB_W.y() = 40.0;
  map.Add(placed);
  EXPECT_TRUE(map.cells().empty());
}

TEST(HeatMap, ADriversCarSaysWhatItBurns) {
  const auto world = PlaneWithRoad();
  HeatMap map(*world);
  for (int i = 0; i <= 500; ++i) {
    SceneSnapshot moment;
    moment.time_ns = i * kStep_ns;
    moment.cars.emplace_back();
    moment.cars[0].p_WB_W = {0.4 * i, -70.0, 0.0};
    moment.cars[0].fuel_used_l = 0.4 * i * 7.0 / 1e5;
    map.Add(moment);
  }
  ASSERT_FALSE(map.cells().empty());
  for (const auto& [key, cell] : map.cells()) EXPECT_NEAR(*map.Value(HeatKind::kFuel, cell), 7.0, 1e-6);
}

}  // namespace
}  // namespace rodeira::scene
