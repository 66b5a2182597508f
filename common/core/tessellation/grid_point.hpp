// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

// Pieces of the plane cut up by lines, on a grid of whole numbers: every question about them has an exact answer.
namespace rodeira::tessellation {

// A point of a square piece of the plane, in steps of its grid. Both coordinates lie in [0, kMost].
struct GridPoint {
  static constexpr std::int32_t kMost = 1 << 24;

  std::int32_t x = 0;
  std::int32_t y = 0;

  auto operator<=>(const GridPoint&) const = default;
};

using GridLine = std::vector<GridPoint>;

// A segment between two points of the grid, without direction.
struct GridSegment {
  GridPoint a, b;  // a < b

  auto operator<=>(const GridSegment&) const = default;
};

// Twice the area of the triangle: positive where it goes counter-clockwise.
inline std::int64_t Turn(GridPoint a, GridPoint b, GridPoint c) {
  return static_cast<std::int64_t>(b.x - a.x) * (c.y - a.y) - static_cast<std::int64_t>(b.y - a.y) * (c.x - a.x);
}

// Whether d lies within the circle through a, b, c, which go counter-clockwise.
inline bool InCircle(GridPoint a, GridPoint b, GridPoint c, GridPoint d) {
  const std::int64_t ax = a.x - d.x, ay = a.y - d.y, bx = b.x - d.x, by = b.y - d.y, cx = c.x - d.x, cy = c.y - d.y;
  const __int128 a2 = ax * ax + ay * ay, b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
  return a2 * (bx * cy - cx * by) - b2 * (ax * cy - cx * ay) + c2 * (ax * by - bx * ay) > 0;
}

}  // namespace rodeira::tessellation
