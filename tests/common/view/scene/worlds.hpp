// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "common/world/road/world.hpp"
#include "tests/n222.hpp"

namespace rodeira::scene {

// A sloping plane with one road that bends once, a double white line and a dashed yellow one.
inline constexpr const char* kPlaneWithRoad = R"(rodeira: world/1
name: plane with a road
ground: {kind: plane, z_m: 10, slope_x: 0.02, slope_y: -0.01, friction: 1.0}
start: {road: r, lane: -1, s_m: 5}
roads:
  - id: r
    start: {x_m: 30, y_m: -20, heading_deg: 25}
    axis:
      - line: {length_m: 60}
      - clothoid: {length_m: 20, radius_end_m: 45}
      - arc: {length_m: 40, radius_m: 45}
    vertical: [{s_m: 0, z_m: 11}, {s_m: 70, z_m: 13, parabola_m: 60}, {s_m: 120, z_m: 11}]
    section:
      lanes: [{id: -1, width_m: 3.25, speed_limit_kmh: 70}, {id: 1, width_m: 3.25, speed_limit_kmh: 70}]
      surface: asphalt
      crossfall: {kind: crown, fall: 0.02}
      shoulders: {left: {width_m: 0.5, surface: asphalt, fall: 0.02}, right: {width_m: 0.5, surface: gravel,
        fall: 0.04}}
      verge: {width_m: 1.5, fall: 0.06, surface: grass}
      blend_m: 6
    marks:
      - {t_m: 0, width_m: 0.12, kind: dashed, stroke_m: 3, gap_m: 5, colour: yellow}
      - {t_m: 3.1, width_m: 0.12, kind: continuous}
)";

inline std::shared_ptr<const road::World> PlaneWithRoad() {
  static const auto world = road::World::Parse(kPlaneWithRoad, "plane_with_road.yaml");
  EXPECT_TRUE(world.ok()) << world.error().Text();
  return world.value();
}

// Its road by the formulas of version 1.
inline const Version1Road& PlaneRoad() {
  static const auto road = Version1Road::Parse(kPlaneWithRoad);
  return road;
}

}  // namespace rodeira::scene
