// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "common/view/scene/raster/canvas.hpp"

namespace rodeira::scene {

// A round instrument with a needle: 0 lies at 225 degrees (lower left), and it turns clockwise by 270 degrees up to
// `most`.
struct Dial {
  double most = 1.0;
  double labelled = 1.0;  // one number each so much …
  double ticks = 1.0;     // … and a small tick each so much
  double divisor = 1.0;   // numbers are values by this
  const char* unit = "";
};
inline constexpr Dial kSpeedDial{220.0, 20.0, 10.0, 1.0, "KM/H"};
inline constexpr Dial kEngineDial{7000.0, 1000.0, 500.0, 1000.0, "1/MIN 1000"};
inline constexpr Dial kFuelDial{60.0, 30.0, 10.0, 1.0, "L"};

// Direction of the needle, from the dial's right counter-clockwise; values beyond the scale stay at its ends.
double NeedleAngle_rad(const Dial& dial, double value);
// The dial without its needle, square, light on dark.
Raster DrawDial(const Dial& dial, int size_px);
// A gear as the driver reads it: R, N, 1 … 9. Square.
Raster DrawGear(std::int32_t gear, int size_px);

}  // namespace rodeira::scene
