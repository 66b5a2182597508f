// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/view/scene/road_markings/mark_strips.hpp"
#include "common/world/network/placing.hpp"

namespace rodeira::scene {

inline constexpr double kFlatSign_m = 0.05;  // a signal that is no higher lies on the road

// What of a road's signals and objects is paint, added to `paint`: `placed` is one of the network's furniture.
// - Crossings: objects of the type crosswalk (but virtual ones), in their outline's hull or their length by width;
// signals 293 and
//   OpenDRIVE's 1000003, over the lanes that are driven on, `value` (4) m long, moved along s so that they lie on their
//   road.
// - Lines where one stops (signals 294) or gives way (341), as wide as they say, to the right of t as their traffic
// sees it, or about t where more of that lies on lanes.
// - Arrows: objects of the type roadMark, flat signals, by the names of stencils.hpp; signals 297 straight on.
// - Marks of objects of any type (object_marks.hpp). Parking places without marks: lines of 0.12 m within their outline
// or rectangle.
// - What fills outlines that lie flat, and the frames within them (object_shapes.hpp).
// Crossings, arrows and parking places have the colour that their object's material says.
// Nothing of all else. The stripes of a crossing run along the road.
void PaintThing(const network::Network& network, const network::Placed& placed, TilePaint& paint);

// Whether a signal or an object is such paint, so that nothing stands there.
bool IsPaint(const network::Signal& signal);
bool IsPaint(const network::Object& object);

}  // namespace rodeira::scene
