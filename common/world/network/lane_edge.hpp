// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/geometry/cubic.hpp"

namespace rodeira::network {

// The outer edge of a lane as t, where its inner one is given; sign 1: to the left of the centre. `edge` is its border,
// which is t itself, or its width; a width below 0, or a border within the inner edge, is none.
inline geometry::CubicPoint OuterEdgeBy(bool bordered, const geometry::CubicPoint& edge, double sign,
                                        const geometry::CubicPoint& inner) {
  if (bordered)
    return sign * (edge.value - inner.value) > 0.0 ? geometry::CubicPoint{edge.value, edge.slope, 0.0} : inner;
  if (!(edge.value > 0.0)) return inner;
  return {inner.value + sign * edge.value, inner.slope + sign * edge.slope, 0.0};
}

}  // namespace rodeira::network
