// SPDX-License-Identifier: Apache-2.0
#pragma once

// Tolerances that several files of this module share.
namespace rodeira::geometry {

// Newton's iteration ends with a step of at most this length: it doubles the digits, so that only rounding is left.
inline constexpr double kLastNewtonStep_m = 1e-7;
// Two points at most this far apart in plan are the same point: no direction leads from one to the other.
inline constexpr double kSamePoint_m = 1e-9;
// Added to the boxes and circles of a search. Far above all rounding, so that the nearest piece is never left out.
inline constexpr double kSearchMargin_m = 1e-6;

}  // namespace rodeira::geometry
