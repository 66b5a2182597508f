// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/world/traffic_map/cubic.hpp"

namespace rodeira::editor {

// The curve beside a curve: its ends lie left_m to the left of the other's ends (negative: to the right), point the
// same way, and its middle (t = 1/2) lies beside the other's middle. Exact for straight lines; a circular arc of a
// quarter turn gives one within 1e-3 of the offset.
traffic_map::Cubic Beside(const traffic_map::Cubic& curve, double left_m);

}  // namespace rodeira::editor
