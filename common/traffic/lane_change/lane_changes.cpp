// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/lane_change/lane_changes.hpp"

#include <optional>
#include <utility>

#include "common/traffic/lane_change/lane_change.hpp"
#include "common/traffic/state/vehicle_way.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kSeeks_m = 350.0;  // so far before its lane parts from its route it looks for a gap by driving slower

}  // namespace

void LaneChanges::BeginChange(std::uint32_t id, LaneChangeOption&& way) {
  Agent& agent = out_.agents[id];
  agent.seeks = false;
  agent.change = {way.side, way.piece.blend_from_m, way.piece.blend_from_m + way.piece.blend_m};
  agent.path.push_back(way.piece);
  if (const Route* route = RouteOf(in_.map, agent)) agent.leg = route->LegOn(agent.leg, way.piece.track);
  out_.stretches[id] = std::move(way.stretches);
  const double front = way.piece.begin_m - way.piece.zero_m;
  out_.observation.Part(way.piece.track);
  out_.occupants.Insert(way.piece.track, {id, -1, front - in_.traits[id].length_m, front});
  out_.ahead[id] = in_.neighbours.FindLeader(id);
}

// To which side it is to go over now: of a road of several lanes, the leader is passed on the lane beside. 0: to
// none, or there is no lane.
int LaneChanges::ToldSide(std::uint32_t id) const {
  const Agent& agent = out_.agents[id];
  const lanes::Track& track = in_.map.graph[agent.path.back().track];
  const auto beside = [&](int side) { return side > 0 ? track.left.has_value() : track.right.has_value(); };
  if (agent.told_side != 0) return beside(agent.told_side) ? agent.told_side : 0;
  const int passes = track.left_hand ? -1 : 1;
  return agent.told_past && out_.ahead[id].any && beside(passes) ? passes : 0;
}

// As soon as it is safe, whatever it brings.
void LaneChanges::ChangeAsTold(std::uint32_t id, int side) {
  if (!MayLeaveLane(id)) return;
  auto way = Weigh(id, side, true);
  if (!way) return;
  if (out_.agents[id].told_side != 0)
    out_.agents[id].told_side = 0;
  else
    out_.agents[id].told_past = false;
  BeginChange(id, std::move(*way));
}

// One after the other by their numbers: one that has begun is seen by the next.
void LaneChanges::ChangeLanes(std::int64_t step_ns) {
  for (std::uint32_t id = 0; id < out_.agents.size(); ++id) {
    if (in_.beside[id] == 0) continue;
    Agent& agent = out_.agents[id];
    if (!agent.on_road || agent.overtaking.active()) continue;
    if (agent.change.side != 0) {
      if (agent.o_m - 0.5 * in_.traits[id].length_m <= agent.change.to_m) continue;
      agent.change = {};
      agent.settled_ns = in_.time_ns + kLaneChangeCooldown_ns;
    }
    if (agent.brake_mps2 > 0.0 || !in_.tracks.HasBeside(id, agent.path.back().track)) continue;
    if (const int side = ToldSide(id); side != 0) {
      ChangeAsTold(id, side);
      continue;
    }
    if (!in_.settings.changes_lanes || !ThinksOfLanes(id, step_ns)) continue;
    std::optional<LaneChangeOption> best;
    for (const int side : {1, -1}) {
      auto way = Weigh(id, side);
      if (way && way->surplus_mps2 > 0.0 && (!best || way->surplus_mps2 > best->surplus_mps2)) best = std::move(way);
    }
    agent.seeks = !best && (in_.lanes_beside.RouteEnds(id) - agent.o_m < kSeeks_m || in_.lanes_beside.EndAhead(id) ||
                            GoesRound(id));
    if (best) BeginChange(id, std::move(*best));
  }
}

}  // namespace rodeira::traffic
