// SPDX-License-Identifier: Apache-2.0
#include "common/world/lanes/right_of_way.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "common/core/geometry/angle.hpp"
#include "common/core/geometry/plane.hpp"
#include "common/world/lanes/approach.hpp"
#include "common/world/lanes/lights.hpp"
#include "common/world/lanes/ring.hpp"
#include "common/world/lanes/signs.hpp"

namespace rodeira::lanes {
namespace {

constexpr double kSameTurn_rad = 0.1;

// How far a track turns to the left from beginning to end.
double Turn(const Curve& curve) {
  double turn = 0.0;
  for (std::size_t i = 1; i < curve.nodes().size(); ++i) {
    const Eigen::Vector2d a = curve.nodes()[i - 1].along_W.head<2>(), b = curve.nodes()[i].along_W.head<2>();
    turn += std::atan2(geometry::Cross(a, b), a.dot(b));
  }
  return turn;
}

// What a junction says of two of its roads: the side that is higher, or -1.
int NamedBy(const network::Junction& junction, const std::string& id_a, const std::string& id_b) {
  for (const auto& priority : junction.priorities) {
    if (priority.high == id_a && priority.low == id_b) return 0;
    if (priority.high == id_b && priority.low == id_a) return 1;
  }
  return -1;
}

// The side with the road that a junction names as higher than the other's, or -1. Past a junction in the middle of a
// road that road goes first, if the junction does not say otherwise.
int NamedFirst(const Graph& graph, const Zone& zone) {
  const Track &a = graph[zone.track[0]], &b = graph[zone.track[1]];
  const auto junctions = graph.network().junctions();
  const auto& id_a = graph.network().roads()[a.lane.road].id();
  const auto& id_b = graph.network().roads()[b.lane.road].id();
  if (a.junction >= 0 && a.junction == b.junction)
    return NamedBy(junctions[static_cast<std::size_t>(a.junction)], id_a, id_b);
  for (const auto& [in, id, first] : {std::tuple(a.junction, id_b, 1), std::tuple(b.junction, id_a, 0)}) {
    if (in < 0 || junctions[static_cast<std::size_t>(in)].main_road != id) continue;
    const int named = NamedBy(junctions[static_cast<std::size_t>(in)], id_a, id_b);
    return named >= 0 ? named : first;
  }
  if (a.junction >= 0 || b.junction >= 0) return -1;
  for (const network::Junction& junction : junctions) {  // of roads that cross and do not meet
    if (junction.type != "crossing") continue;
    if (const int named = NamedBy(junction, id_a, id_b); named >= 0) return named;
  }
  return -1;
}

int FirstByRule(const Graph& graph, const Zone& zone) {
  const Track &a = graph[zone.track[0]], &b = graph[zone.track[1]];
  const bool ring_a = OnRing(graph, zone.track[0]), ring_b = OnRing(graph, zone.track[1]);
  if (ring_a != ring_b) return ring_a ? 0 : 1;
  const Eigen::Vector2d from_a = a.curve.nodes().front().along_W.head<2>(),
                        from_b = b.curve.nodes().front().along_W.head<2>();
  // Positive: b points to the left of a, so that it comes from a's right.
  const double turned = std::atan2(geometry::Cross(from_a, from_b), from_a.dot(from_b));
  const double left_a = a.left_hand ? -Turn(a.curve) : Turn(a.curve),
               left_b = b.left_hand ? -Turn(b.curve) : Turn(b.curve);
  if (std::fabs(turned) < kSameDirection_rad) {
    const double end_a = a.curve.nodes().back().width_m, end_b = b.curve.nodes().back().width_m;
    if (zone.kind == ZoneKind::kMerge && std::fabs(end_a - end_b) > 1.0) return end_a > end_b ? 0 : 1;
    if (std::fabs(std::fabs(left_a) - std::fabs(left_b)) > kSameTurn_rad)
      return std::fabs(left_a) < std::fabs(left_b) ? 0 : 1;
    return 0;
  }
  if (std::fabs(turned) > kHeadOn_rad) {
    if (std::fabs(left_a - left_b) > kSameTurn_rad)
      return left_a < left_b ? 0 : 1;  // the vehicle that turns left yields
    return 0;
  }
  return (turned > 0.0) != a.left_hand ? 1 : 0;
}

}  // namespace

void Decide(const Graph& graph, Zone& zone) {
  const int sign_a = static_cast<int>(SignFor(graph, zone.track[0], zone.in_m[0]));
  const int sign_b = static_cast<int>(SignFor(graph, zone.track[1], zone.in_m[1]));
  zone.signed_ = true;
  if (LightFor(graph, zone.track[0], zone.in_m[0]) &&
      LightFor(graph, zone.track[1], zone.in_m[1])) {  // signs hold where lights are dark
    zone.first = FirstByRule(graph, zone), zone.signed_ = false;
    return;
  }
  if (sign_a != sign_b)
    zone.first = sign_a > sign_b ? 0 : 1;
  else if (const int named = NamedFirst(graph, zone); named >= 0)
    zone.first = named;
  else
    zone.first = FirstByRule(graph, zone), zone.signed_ = false;
}

}  // namespace rodeira::lanes
