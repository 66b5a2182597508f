// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/world/surface/crg_surface.hpp"

namespace rodeira::surface {

// The same grid with its short waves taken out: each height is the mean of those within `reach_m` along u and across v,
// twice. Towards a border the reach shrinks with the distance to it, and as many count on either side, so that on an
// even grid what is bilinear stays as it is. Missing heights stay missing and do not count. The reference line and its
// banking are not changed. reach_m > 0.
CrgSurface Smoothed(const CrgSurface& surface, double reach_m);

}  // namespace rodeira::surface
