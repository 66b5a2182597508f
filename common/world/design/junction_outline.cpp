// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/junction_outline.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/geometry/plane.hpp"

namespace rodeira::design {
namespace {

constexpr double kOutlineStep_m = 0.25;  // between points of a corner

// The corner from one road's edge to the next one's, without its two ends.
std::vector<Eigen::Vector2d> Corner(const Eigen::Vector2d& from, const Eigen::Vector2d& inward,
                                    const Eigen::Vector2d& to, const Eigen::Vector2d& outward) {
  const Eigen::Vector2d chord = to - from;
  const double sine = geometry::Cross(inward, outward);
  double first = chord.norm() / 3.0, second = first;
  if (std::fabs(sine) > 0.2) {  // handles of a circle's arc towards where the edges meet, where they do so ahead
    const double ahead = geometry::Cross(chord, outward) / sine, behind = geometry::Cross(inward, chord) / sine;
    if (ahead > 0.0 && behind > 0.0) first = 0.552 * ahead, second = 0.552 * behind;
  }
  const Eigen::Vector2d p1 = from + first * inward, p2 = to - second * outward;
  const int steps = std::max(4, static_cast<int>(std::ceil(chord.norm() / kOutlineStep_m)));
  std::vector<Eigen::Vector2d> corners;
  for (int i = 1; i < steps; ++i) {
    const double q = static_cast<double>(i) / steps, r = 1.0 - q;
    corners.emplace_back(r * r * r * from + 3.0 * r * r * q * p1 + 3.0 * r * q * q * p2 + q * q * q * to);
  }
  return corners;
}

}  // namespace

Outline MakeOutline(const std::vector<Mouth>& mouths) {
  Outline outline;
  for (std::size_t i = 0; i < mouths.size(); ++i) {
    const Mouth &here = mouths[i], &next = mouths[(i + 1) % mouths.size()];
    outline.corners_W.push_back(here.right_W);
    outline.corners_W.push_back(here.left_W);
    Eigen::Vector2d before = here.left_W;
    for (const Eigen::Vector2d& corner : Corner(here.left_W, -here.outward_W, next.right_W, next.outward_W)) {
      outline.free_edges.push_back({before, corner});
      outline.corners_W.push_back(corner);
      before = corner;
    }
    outline.free_edges.push_back({before, next.right_W});
  }
  return outline;
}

}  // namespace rodeira::design
