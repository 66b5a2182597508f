// SPDX-License-Identifier: Apache-2.0
// What a scenario tells agents to do.
#include <cmath>
#include <utility>

#include "common/core/base/assert.hpp"
#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {

void TrafficModel::Brake(std::uint32_t id, double deceleration_mps2) {
  RODEIRA_ASSERT(id < agents_.size() && deceleration_mps2 > 0.0);
  agents_[id].brake_mps2 = deceleration_mps2;
}

void TrafficModel::CapSpeed(std::uint32_t id, double speed_mps) {
  RODEIRA_ASSERT(id < agents_.size() && speed_mps > 0.0);
  agents_[id].cap_mps = speed_mps;
}

void TrafficModel::Release(std::uint32_t id) {
  RODEIRA_ASSERT(id < agents_.size());
  agents_[id].brake_mps2 = 0.0;
  agents_[id].cap_mps = Agent::kNoCap_mps;
  agents_[id].told_side = 0;
  agents_[id].told_past = false;
}

void TrafficModel::TellToPass(std::uint32_t id) {
  RODEIRA_ASSERT(id < agents_.size());
  agents_[id].told_past = true;
}

void TrafficModel::TellToChange(std::uint32_t id, int side) {
  RODEIRA_ASSERT(id < agents_.size() && (side == 1 || side == -1));
  agents_[id].told_side = side;
}

// To which side it is to go over now: of a road of several lanes, who is ahead is passed on the lane beside. 0: to
// none, or there is no lane.
int TrafficModel::ToldSide(std::uint32_t id) const {
  const Agent& agent = agents_[id];
  const lanes::Track& track = graph()[agent.path.back().track];
  const auto beside = [&](int side) { return side > 0 ? track.left.has_value() : track.right.has_value(); };
  if (agent.told_side != 0) return beside(agent.told_side) ? agent.told_side : 0;
  const int passes = track.left_hand ? -1 : 1;
  return agent.told_past && ahead_[id].any && beside(passes) ? passes : 0;
}

// As soon as it is safe, whatever it brings.
void TrafficModel::ChangeAsTold(std::uint32_t id, int side) {
  if (!MayLeaveLane(id)) return;
  auto way = Weigh(id, side, true);
  if (!way) return;
  if (agents_[id].told_side != 0)
    agents_[id].told_side = 0;
  else
    agents_[id].told_past = false;
  BeginChange(id, std::move(*way));
}

std::optional<std::uint32_t> TrafficModel::AheadOf(const driver::Footprint& other) const {
  constexpr double kWidest_m = 4.0;
  constexpr std::size_t kMostWays = 256;
  std::vector<std::vector<std::pair<double, std::uint32_t>>> on(
      graph().tracks().size());  // middles of the agents, by track
  for (std::uint32_t id = 0; id < agents_.size(); ++id) {
    if (!agents_[id].on_road || id == other.id) continue;
    for (const Piece& piece : agents_[id].path) on[piece.track].emplace_back(agents_[id].o_m - piece.zero_m, id);
  }
  struct Way {
    std::uint32_t track;
    double from_m;  // d of the track's beginning as seen from the rectangle's middle
  };
  std::vector<Way> ways;
  for (const lanes::Graph::Beside& beside : graph().TracksAt({other.x_m, other.y_m}, kWidest_m)) {
    const lanes::Curve& curve = graph()[beside.track].curve;
    const lanes::CurvePoint at = curve.At(beside.foot.d_m);
    if (std::fabs(beside.foot.offset_m) > 0.5 * curve.WidthAt(beside.foot.d_m)) continue;
    if (at.ahead_W.dot(Eigen::Vector2d(std::cos(other.heading_rad), std::sin(other.heading_rad))) <= 0.0) continue;
    if (std::fabs((Eigen::Vector2d(other.x_m, other.y_m) - at.p_W.head<2>()).dot(at.ahead_W)) > 1e-3)
      continue;  // beyond an end
    ways.push_back({beside.track, -beside.foot.d_m});
  }
  std::optional<std::uint32_t> nearest;
  double gap_m = settings_.sight_m;
  for (std::size_t i = 0; i < ways.size() && i < kMostWays; ++i) {
    const Way way = ways[i];
    const double end = way.from_m + graph()[way.track].length_m();
    for (const auto& [middle, id] : on[way.track]) {
      const double gap = way.from_m + middle;
      if (gap <= 0.0 || gap > gap_m || gap > end) continue;
      gap_m = gap;
      nearest = id;
    }
    if (end > gap_m) continue;
    for (const lanes::Link& link : graph()[way.track].next) ways.push_back({link.to, end - link.from_d_m});
  }
  return nearest;
}

}  // namespace rodeira::traffic
