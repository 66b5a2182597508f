// SPDX-License-Identifier: Apache-2.0
#include "common/core/geometry/polygon.hpp"

#include "common/core/geometry/plane.hpp"

namespace rodeira::geometry {

bool InPolygon(const std::vector<Eigen::Vector2d>& corners, const Eigen::Vector2d& p) {
  bool inside = false;
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    const Eigen::Vector2d &a = corners[i], &b = corners[j];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    // On which side of the edge, looking from its lower end: the same answer whichever way it is run through.
    const bool up = a.y() < b.y();
    const double side = up ? Cross(b - a, p - a) : Cross(a - b, p - b);
    if (side > 0.0) inside = !inside;
  }
  return inside;
}

}  // namespace rodeira::geometry
