// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/following/decisions.hpp"

#include <algorithm>
#include <cmath>

#include "common/traffic/lane_change/turn.hpp"
#include "common/traffic/right_of_way/queueing.hpp"
#include "common/traffic/state/vehicle_way.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kSoon_s = 2.0;      // to a contact at the present speeds
constexpr double kMinRoom_m = 0.02;  // decelerations are divided by no less

// By which vehicles take turns. That of a flow's vehicle depends on no other flow.
std::uint32_t NumberOf(const Agent& agent, std::uint32_t id) { return agent.flow >= 0 ? agent.arrival : id; }

}  // namespace

void Decided::Save(base::StateWriter& writer) const {
  writer.Put("wanted_mps2", wanted_mps2);
  writer.Put("granted_m", granted_m);
  writer.Put("leader", leader);
  writer.Put("trip", trip);
  writer.Put("due", due);
}

void Decided::Restore(base::StateReader& reader) {
  reader.Get("wanted_mps2", wanted_mps2);
  reader.Get("granted_m", granted_m);
  reader.Get("leader", leader);
  reader.Get("trip", trip);
  reader.Get("due", due);
}

double Decisions::Wanted(std::uint32_t id, std::int64_t step_ns) {
  Decided& last = out_.decided[id];
  if (MayKeep(id, step_ns)) return last.wanted_mps2;
  const Agent& agent = in_.agents[id];
  const Leader& ahead = in_.ahead[id];
  const ConflictPassage& passage = in_.passages[id];
  last = {in_.acceleration.Wanted(id), agent.granted_m, ahead.any ? ahead.id : -1, agent.trip,
          passage.any && passage.due};
  return last.wanted_mps2;
}

// A light that changes, a reservation that is given or taken back, and a vehicle in a zone before it show in what its
// passage and its zones leave it.
bool Decisions::MayKeep(std::uint32_t id, std::int64_t step_ns) const {
  const Decided& last = out_.decided[id];
  const Agent& agent = in_.agents[id];
  const ConflictPassage& passage = in_.passages[id];
  if (last.trip != static_cast<std::int64_t>(agent.trip) ||
      IsItsTurn(in_.time_ns, NumberOf(agent, id), step_ns, std::llround(in_.settings.decide_s * 1e9)))
    return false;
  if ((passage.any && passage.due) != last.due || agent.granted_m != last.granted_m ||
      in_.leaves[id] < last.wanted_mps2 || in_.bars[id] < kNoBarrier_m)
    return false;
  return !IsManoeuvring(id) && !SeesOthers(id) && !IsPressed(id);
}

bool Decisions::IsManoeuvring(std::uint32_t id) const {
  const Agent& agent = in_.agents[id];
  return agent.brake_mps2 > 0.0 || agent.seeks || agent.change.side != 0 || agent.overtaking.active() ||
         in_.is_overtaken[id] != 0;
}

// Vehicles that are no agents, or overtake towards it, on its way.
bool Decisions::SeesOthers(std::uint32_t id) const {
  return (in_.any_block || in_.any_facing) && std::ranges::any_of(in_.stretches[id], [&](const RouteSegment& stretch) {
           return !in_.blocks[stretch.track].empty() || !in_.facing[stretch.track].empty();
         });
}

// Whether the leader is another one, or may soon ask for more than comfortable braking.
bool Decisions::IsPressed(std::uint32_t id) const {
  const Leader& ahead = in_.ahead[id];
  const double v = in_.agents[id].speed_mps, b = in_.traits[id].idm.braking_mps2;
  if ((ahead.any ? ahead.id : -1) != out_.decided[id].leader || (ahead.any && ahead.id < 0)) return true;
  if (v < kStandstill_mps) return false;
  if (out_.decided[id].wanted_mps2 < -b) return true;
  if (!ahead.any) return false;
  const double closes = v - ahead.speed_mps,
               room = std::max(kMinRoom_m, ahead.gap_m - 0.5 * in_.traits[id].idm.min_gap_m);
  return (closes > 0.0 && (closes * closes > 2.0 * b * room || room < kSoon_s * closes)) ||
         in_.agents[static_cast<std::size_t>(ahead.id)].desired_mps2 < -b;
}

}  // namespace rodeira::traffic
