// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "common/world/road/world.hpp"
#include "tests/version1_road.hpp"

namespace rodeira::road {

// A small world with everything in it: a line, a clothoid, an arc, an S of two clothoids; a crest and a sag; two lanes,
// a paved and a gravel shoulder; steep hills close to the road, so that the blend has work to do.
inline const std::string kSample = R"(rodeira: world/1
name: sample
description: for tests
friction: {asphalt: 0.95, gravel: 0.6, grass: 0.5}
terrain:
  surface: soil
  generate:
    seed: 7
    columns: 61
    rows: 51
    spacing_m: 8.5
    west_m: -100
    south_m: -180
    below_m: 0.4
    flat_m: 6
    full_m: 40
    relief:
      - {wavelength_m: 90, amplitude_m: 22.5}
      - {wavelength_m: 30, amplitude_m: 3}
start: {road: main, lane: -1, s_m: 12.5}
roads:
  - id: main
    start: {x_m: -50.25, y_m: 10, heading_deg: 5}
    axis:
      - line: {length_m: 80}
      - clothoid: {length_m: 20, radius_end_m: 45}
      - arc: {length_m: 25, radius_m: 45}
      - clothoid: {length_m: 30, radius_start_m: 45, radius_end_m: -60}
      - arc: {length_m: 100, radius_m: -60}
      - clothoid: {length_m: 20.5, radius_start_m: -60}
      - line: {length_m: 30}
    vertical:
      - {s_m: 0, z_m: 100}
      - {s_m: 90, z_m: 105, parabola_m: 60}
      - {s_m: 190, z_m: 98.5, parabola_m: 80}
      - {s_m: 306, z_m: 104}
    section:
      lanes:
        - {id: -1, width_m: 3.25, speed_limit_kmh: 70}
        - {id: 1, width_m: 3, speed_limit_kmh: 60}
      surface: asphalt
      crossfall: {kind: crown, fall: 0.025}
      shoulders:
        left: {width_m: 0.5, surface: asphalt, fall: 0.025}
        right: {width_m: 1.25, surface: gravel, fall: 0.06}
      verge: {width_m: 1.5, fall: 0.1, surface: grass}
      blend_m: 8
    marks:
      - {t_m: -3.3, width_m: 0.12, kind: continuous}
      - {t_m: 3, width_m: 0.12, from_s_m: 10, to_s_m: 250, kind: dashed, stroke_m: 3, gap_m: 5, colour: yellow}
      - {t_m: 0, width_m: 0.1, kind: dashed, stroke_m: 4, gap_m: 8}
)";

// The sample with one piece of text replaced.
inline std::string SampleWith(const std::string& old_text, const std::string& new_text) {
  std::string text = kSample;
  const auto at = text.find(old_text);
  EXPECT_NE(at, std::string::npos) << old_text;
  if (at != std::string::npos) text.replace(at, old_text.size(), new_text);
  return text;
}

inline std::shared_ptr<const World> MustParse(const std::string& text) {
  const auto world = World::Parse(text, "sample.yaml");
  EXPECT_TRUE(world.ok()) << world.error().Text();
  return world.ok() ? world.value() : nullptr;
}

inline std::shared_ptr<const World> Sample() {
  static const auto world = MustParse(kSample);
  return world;
}

// Its road by the formulas of version 1.
inline const Version1Road& SampleRoad() {
  static const auto road = Version1Road::Parse(kSample);
  return road;
}

}  // namespace rodeira::road
