// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <set>

#include "common/editor/selection.hpp"

namespace rodeira::editor {

// Where a handle that is dragged to p comes to rest: an end on the nearest end of a curve that is not dragged; a handle
// beside an end on the line on which the curve would go on smoothly from another one that begins or ends there. p
// itself where nothing is within the radius.
struct Snapped {
  Eigen::Vector2d p_W;
  bool caught = false;
};
Snapped Snap(const Document& document, const Handle& handle, const std::set<std::int32_t>& dragged,
             const Eigen::Vector2d& p_W, double radius_m);

}  // namespace rodeira::editor
