// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "common/core/base/result.hpp"
#include "common/core/geometry/polyline.hpp"

namespace rodeira::cli {

// "WORLD.yaml#ROAD" or "FILE.xodr#ROAD": the file and the road's id; nothing for other names.
struct AxisName {
  std::string file, road;
};
// Whether file and road exist is not looked at.
std::optional<AxisName> AxisNameOf(std::string_view text);

// The axis of a world's road as a chain of points with heights, `step_m` apart (the last piece may be shorter). Wrong
// input where the world cannot be read or has no such road (with the nearest name).
base::Result<geometry::Polyline> AxisOf(const AxisName& name, double step_m);

}  // namespace rodeira::cli
