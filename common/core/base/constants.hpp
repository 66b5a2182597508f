// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

namespace rodeira::base {

// Acceleration of free fall wherever a model does not say otherwise. A rounded value, as vehicle dynamics uses it.
inline constexpr double kGravity_mps2 = 9.81;

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kRadiansPerDegree = kPi / 180.0;
inline constexpr double kDegreesPerRadian = 180.0 / kPi;

}  // namespace rodeira::base
