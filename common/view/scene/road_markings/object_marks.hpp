// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/view/scene/road_markings/mark_strips.hpp"
#include "common/world/network/placing.hpp"

namespace rodeira::scene {

inline constexpr double kMaxPaintLength_m = 1e4;  // of a line or outline: a longer one would lie in too many tiles

// The lines of paint that an object has along its sides (of its length by width) and from corner to corner of its first
// outline, as ObjectMark says them, about these lines, added to `paint`. Strokes and gaps go on round the corners; the
// middle of a stroke bends there without a mitre. Nothing of what is wider than 10 m or longer than 10 km.
void PaintMarks(const network::Road& road, const network::Placed& placed, TilePaint& paint);

}  // namespace rodeira::scene
