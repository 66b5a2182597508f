// SPDX-License-Identifier: Apache-2.0
#pragma once

/// @file
/// Physical and mathematical constants.

#include <numbers>

namespace rodeira::base {

/// Acceleration of free fall in m/s², used unless a model has its own value. Rounded, as usual in vehicle dynamics.
inline constexpr double kGravity_mps2 = 9.81;

inline constexpr double kPi = std::numbers::pi;           ///< circle constant π
inline constexpr double kRadiansPerDegree = kPi / 180.0;  ///< factor from degrees to radians
inline constexpr double kDegreesPerRadian = 180.0 / kPi;  ///< factor from radians to degrees

}  // namespace rodeira::base
