// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/perception/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "common/driving/driver/idm.hpp"
#include "common/traffic/lane_change/lane_change.hpp"
#include "common/traffic/perception/passing_by.hpp"
#include "common/traffic/perception/seen_on.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kAnySpeed_mps = 1e3;

}  // namespace

std::optional<std::uint32_t> Neighbours::LaneLeft(std::uint32_t id, const RouteSegment& stretch,
                                                  double odometer_m) const {
  const Agent& agent = in_.agents[id];
  if (agent.change.side == 0 || stretch.changes || stretch.end_m < agent.change.from_m) return std::nullopt;
  const lanes::Track& track = in_.map.graph[stretch.track];
  const auto old = agent.change.side > 0 ? track.right : track.left;
  if (!old || odometer_m >= agent.change.to_m)
    return std::nullopt;  // beyond it a lane that goes on begins a piece without any offset
  std::size_t i = agent.path.size() - 1;
  while (i > 0 && agent.path[i].begin_m > odometer_m) --i;
  if (odometer_m < agent.change.from_m) return old;
  const double gone =
      std::fabs(agent.path[i].offset_m) - std::fabs(FrameAt(in_.map.graph, agent.path, odometer_m).offset_m);
  return gone < 0.5 * in_.traits[id].width_m + kBesideLane_m ? old : std::nullopt;
}

// The nearest of agents on the tracks of the way and what else stands in it. Or, of those on the lane that it is
// leaving, and of agents on tracks that part from the way, as long as they are not clear, the one that lets it drive on
// least (it need not be the nearest: of two that turn off to different sides one may drive away while the other one
// stands, and one that drives away on the new lane may be nearer than a queue on the old one), if that is less.
Leader Neighbours::FindLeader(std::uint32_t id) const {
  const Agent& agent = in_.agents[id];
  const double half = 0.5 * in_.traits[id].length_m, front = agent.o_m + half;
  const double half_width = 0.5 * in_.traits[id].width_m + in_.settings.side_margin_m;
  const double aside = agent.path.back().aside_m;  // it drives there, and everywhere between
  Leader ahead, apart;
  double apart_lets = 0.0;
  const auto lets = [&](const Leader& other) {
    return driver::IdmAcceleration(in_.traits[id].idm, agent.speed_mps, kAnySpeed_mps, other.gap_m, other.speed_mps);
  };
  const auto is_before = [&](const Occupant& other, double zero_m) {
    return other.id != id && zero_m + other.middle_m() > agent.o_m + kWithout_m;
  };
  const auto is_beside = [&](const Occupant& other, double gap) {
    if (agent.overtaking.active() && IsPassed(agent.overtaking, front, other.id, -1, gap)) return true;
    return in_.any_overtaking && in_.agents[other.id].overtaking.passed == id && !in_.agents[other.id].overtaking.back;
  };
  const auto seen = [&](const Occupant& other, double gap) -> Leader {
    const double side = 0.5 * in_.traits[other.id].width_m;
    return {gap, in_.agents[other.id].speed_mps, other.id, true, -1, in_.traits[other.id].length_m, side, -side};
  };
  const auto consider = [&](const Occupant& other, double zero_m) {
    const double gap = zero_m + other.rear_m - front;
    if (!is_before(other, zero_m) || (ahead.any && gap >= ahead.gap_m) || is_beside(other, gap)) return;
    ahead = seen(other, gap);
  };
  const auto consider_apart = [&](const Leader& next) {
    const double next_lets = lets(next);
    if (!apart.any || next_lets < apart_lets) apart = next, apart_lets = next_lets;
  };
  const auto consider_beside_way = [&](const Occupant& other, double zero_m) {
    const double gap = zero_m + other.rear_m - front;
    if (is_before(other, zero_m) && !is_beside(other, gap)) consider_apart(seen(other, gap));
  };
  const auto seen_block = [&](const Block& block, double zero_m) -> std::optional<Leader> {
    const bool comes =
        block.span.speed_mps < 0.0;  // what comes on the lane beside is looked for otherwise (oncoming.cpp)
    const double left = half_width + (comes ? 0.0 : std::max(0.0, aside)),
                 right = -half_width + (comes ? 0.0 : std::min(0.0, aside));
    if (zero_m + block.middle_m <= agent.o_m || block.span.right_m > left || block.span.left_m < right)
      return std::nullopt;
    const double gap = zero_m + block.span.rear_m - front;
    const bool is_far = gap >= in_.settings.sight_m && !agent.overtaking.active();  // one that overtakes looks on
    if (is_far ||
        (agent.overtaking.active() && (IsPassed(agent.overtaking, front, -1, block.body, gap) ||
                                       IsCleared(agent.overtaking, front, block.body, gap, block.span.speed_mps))))
      return std::nullopt;
    return LeaderOf(block, gap);
  };
  std::int64_t before = -1;  // the track by which its own way comes
  for (const RouteSegment& stretch : in_.stretches[id]) {
    const std::int64_t from = std::exchange(before, stretch.track);
    if (stretch.end_m < agent.o_m || (stretch.changes && agent.change.side == 0)) continue;
    if (ahead.any && agent.change.side == 0 && stretch.begin_m > front + ahead.gap_m + 10.0) break;
    for (Occupant other : in_.occupants.Beyond(stretch.track, agent.o_m - stretch.zero_m)) {
      if (ahead.any && stretch.zero_m + other.middle_m() - in_.longest_half_m - front >= ahead.gap_m) break;
      // One that comes in from beside has its rear in the zone where the ways merge, which its own line keeps it out
      // of.
      if (from >= 0 && other.from >= 0 && other.from != from)
        other.rear_m = std::max(other.rear_m, stretch.begin_m - stretch.zero_m);
      consider(other, stretch.zero_m);
    }
    for (const lanes::DivergeZone& part : DivergeZonesOf(stretch.track)) {
      if (agent.o_m - half > stretch.zero_m + part.out_m) continue;
      for (const Occupant& other : in_.occupants.On(part.other)) {
        if (other.rear_m < part.other_out_m && other.front_m > part.other_in_m)
          consider_beside_way(other, stretch.zero_m);
      }
    }
    for (const Block& block : BlocksOn(in_.any_block, in_.blocks, stretch.track)) {
      if (const auto next = seen_block(block, stretch.zero_m); next && (!ahead.any || next->gap_m < ahead.gap_m))
        ahead = *next;
    }
    if (agent.change.side == 0) continue;
    if (const auto old = LaneLeft(id, stretch, front)) {
      const double at = std::max(agent.o_m, stretch.begin_m),
                   zero = at - in_.map.graph.Across(stretch.track, at - stretch.zero_m, *old);
      const auto passes = [&](Leader other) {
        other.gap_m = MeetsAfter_m(other.gap_m, agent.speed_mps, other.speed_mps);
        return other.speed_mps < kStandingLeader_mps && PassesBeside(in_.map.graph, agent, in_.traits[id], other);
      };
      for (const Occupant& other : in_.occupants.Beyond(*old, agent.o_m - zero)) {
        const double gap = zero + other.rear_m - front;
        if (is_before(other, zero) && !is_beside(other, gap) && !passes(seen(other, gap)))
          consider_apart(seen(other, gap));
      }
      for (const Block& block : BlocksOn(in_.any_block, in_.blocks, *old)) {
        if (const auto next = seen_block(block, zero); next && !passes(*next)) consider_apart(*next);
      }
    }
  }
  return apart.any && (!ahead.any || apart_lets < lets(ahead)) ? apart : ahead;
}

std::span<const lanes::DivergeZone> Neighbours::DivergeZonesOf(std::uint32_t track) const {
  return in_.parts[track] != 0 ? in_.map.zones.DivergeZonesOf(track) : std::span<const lanes::DivergeZone>();
}

}  // namespace rodeira::traffic
