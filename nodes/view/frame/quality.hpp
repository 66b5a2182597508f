// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace rodeira::nodes {

// What a picture may cost; docs/reference/view.md lists what each of them leaves out.
enum class Quality { kLow, kMedium, kHigh };

// "low", "medium", "high": as settings and options name them.
std::span<const std::string_view> QualityNames();
// Nothing for another name.
std::optional<Quality> QualityOf(std::string_view name);

// What a quality means for the drawing.
struct QualityTraits {
  int samples = 0;            // a pixel, at most; 0: one, edges are steps
  float detail_scale = 1.0F;  // levels of detail change at so much smaller distances
  bool fine = true;           // the sky's clouds and the ground's grain of every pixel, from the sharpest textures
  int shadow_px = 0;          // side of the sun's shadow map; 0: none, soft spots below the cars instead
  double shadow_m = 0.0;      // side of the square of ground on which it lies
  float soft_px = 0.0F;       // of its pixels, over which a shadow's edge is drawn softly
  int ground_shadow_px = 0;   // of a second map, of the ground alone: what hills and bridges shade beyond the first one
  double ground_shadow_m = 0.0;
  bool instances = false;  // trees, posts and what else is repeated are drawn as one model at many places
  float slanted =
      1.0F;  // times a picture is looked up where it is seen at a slant, at most; 1 wherever the processor draws
  bool mirrors_in_turn = false;  // of a window: one of them is drawn anew in each picture while time goes on
};
// Lives as long as the program.
const QualityTraits& TraitsOf(Quality quality);

}  // namespace rodeira::nodes
