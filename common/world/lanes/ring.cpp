// SPDX-License-Identifier: Apache-2.0
#include "common/world/lanes/ring.hpp"

#include <cmath>
#include <optional>

#include "common/core/geometry/angle.hpp"
#include "common/core/geometry/plane.hpp"

namespace rodeira::lanes {
namespace {

constexpr double kLongest_m = 250.0;
constexpr double kStraight_1pm = 1.0 / 80.0;  // less bent than this is straight
constexpr double kStraightShare = 0.2;
constexpr double kTurnError_rad = 0.3;
constexpr double kBack_rad = 0.15;

struct Bend {
  double turn_rad = 0.0;
  double back_rad = 0.0;  // turned the wrong way
  double straight_m = 0.0;
};

Bend BendOf(const Track& track) {
  Bend bend;
  const double sign = track.left_hand ? -1.0 : 1.0;
  const auto& nodes = track.curve.nodes();
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    const Eigen::Vector2d a = nodes[i - 1].along_W.head<2>(), b = nodes[i].along_W.head<2>();
    const double turn = sign * std::atan2(geometry::Cross(a, b), a.dot(b));
    bend.turn_rad += turn;
    if (turn < 0.0) bend.back_rad -= turn;
    if (turn < kStraight_1pm * (nodes[i].d_m - nodes[i - 1].d_m)) bend.straight_m += nodes[i].d_m - nodes[i - 1].d_m;
  }
  return bend;
}

}  // namespace

bool OnRing(const Graph& graph, std::uint32_t track) {
  double length = 0.0, turn = 0.0, straight = 0.0, back = 0.0;
  std::uint32_t at = track;
  while (true) {
    const Bend here = BendOf(graph[at]);
    length += graph[at].length_m();
    turn += here.turn_rad;
    straight += here.straight_m;
    back += here.back_rad;
    if (length > kLongest_m || back > kBack_rad || turn > 2.0 * geometry::kPi + kTurnError_rad) return false;
    std::optional<std::uint32_t> inside;
    double most = 0.0;
    for (const Link& link : graph[at].next) {
      const double bent = BendOf(graph[link.to]).turn_rad / graph[link.to].length_m();
      if (!inside || bent > most) inside = link.to, most = bent;
    }
    if (!inside) return false;
    if (*inside == track) break;
    at = *inside;
  }
  return std::fabs(turn - 2.0 * geometry::kPi) < kTurnError_rad && straight < kStraightShare * length;
}

}  // namespace rodeira::lanes
