// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/world/design/axis_reader.hpp"

namespace rodeira::design {

// 'points': a file of points or a list of them, smoothed or as they are, into elements and heights.
void ReadPoints(const config::DeclaredMap& points, const terrain::GroundMove& move, AxisReading& axis);

}  // namespace rodeira::design
