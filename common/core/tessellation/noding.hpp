// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "common/core/tessellation/grid_point.hpp"

namespace rodeira::tessellation {

// The lines as segments that meet only at their ends: cut wherever they cross, touch or lie on one another, each piece
// once, in ascending order. Crossings are rounded to the grid, and a segment that passes nearer to a point than half a
// step goes through it (snap rounding, by GEOS). Lines of fewer than two different points are left out.
std::vector<GridSegment> Node(std::span<const GridLine> lines);

}  // namespace rodeira::tessellation
