// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/view/scene/mesh/mesh.hpp"

// What is about the driver in a car, without instruments and steering wheel (cabin.hpp): doors, posts, roof, seats. In
// frame E: origin in the driver's eye, axes of the car's body (x forward, y left, z up).
namespace rodeira::scene {

// What the cabin's measures follow from.
struct CabinShape {
  double width_m = 1.65, height_m = 1.42;         // of the car, outside
  double eye_left_m = 0.36, eye_height_m = 1.20;  // of the eye, from its middle and its ground

  double half_m() const { return 0.5 * width_m; }
  bool operator==(const CabinShape&) const = default;

  // So far to the left of the car's middle.
  double Y(double aside_m) const { return aside_m - eye_left_m; }
  // The lining's height over the eye.
  double roof_m() const;
};
// The upper edge of doors, below the eye.
inline constexpr double kSill_m = 0.262;
// The lining's front edge, ahead of the eye.
inline constexpr double kHeader_m = 0.39;

// All of it in one mesh of closed parts.
Mesh BuildCabinBody(const CabinShape& shape);

}  // namespace rodeira::scene
