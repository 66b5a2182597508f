// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/following/decisions.hpp"

#include <algorithm>
#include <cmath>

#include "common/driving/driver/idm.hpp"
#include "common/traffic/lane_change/turn.hpp"
#include "common/traffic/right_of_way/queueing.hpp"
#include "common/traffic/state/vehicle_way.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kSoon_s = 2.0;      // to a contact at the present speeds
constexpr double kMinRoom_m = 0.02;  // decelerations are divided by no less

// By which vehicles take turns. That of a flow's vehicle depends on no other flow.
std::uint32_t NumberOf(const Agent& agent, std::uint32_t id) { return agent.flow >= 0 ? agent.arrival : id; }

// Whether it was decided on this trip. What a driver is told has made it no trip's.
bool IsOf(const Decided& decided, const Agent& agent) {
  return decided.trip < 0 || decided.trip == static_cast<std::int64_t>(agent.trip);
}

}  // namespace

void Decided::Save(base::StateWriter& writer) const {
  writer.Put("wanted_mps2", wanted_mps2);
  writer.Put("granted_m", granted_m);
  writer.Put("leader", leader);
  writer.Put("trip", trip);
  writer.Put("due", due);
  writer.Put("follows", follows);
  writer.Put("kept", kept);
  writer.Put("kept_trip", kept_trip);
  writer.Put("apart_m", apart_m);
}

void Decided::Restore(base::StateReader& reader) {
  reader.Get("wanted_mps2", wanted_mps2);
  reader.Get("granted_m", granted_m);
  reader.Get("leader", leader);
  reader.Get("trip", trip);
  reader.Get("due", due);
  reader.Get("follows", follows);
  reader.Get("kept", kept);
  reader.Get("kept_trip", kept_trip);
  reader.Get("apart_m", apart_m);
}

double Decisions::Wanted(std::uint32_t id, std::int64_t step_ns) {
  Decided& last = out_.decided[id];
  if (!MayKeep(id, step_ns)) {
    const Agent& agent = out_.agents[id];
    const Leader& ahead = in_.ahead[id];
    const ConflictPassage& passage = in_.passages[id];
    last = {in_.acceleration.Wanted(id), agent.granted_m, ahead.any ? ahead.id : -1, agent.trip,
            passage.any && passage.due};
    last.follows = last.wanted_mps2 <= BehindLeader(id);
  }
  NoteLeader(id);
  return last.wanted_mps2;
}

// What its leader, as it sees it, lets it want.
double Decisions::BehindLeader(std::uint32_t id) const {
  const Agent& agent = out_.agents[id];
  const Leader& ahead = in_.ahead[id];
  const driver::IdmSettings& idm = in_.traits[id].idm;
  if (!ahead.any || ahead.id < 0 || ahead.gap_m >= in_.settings.sight_m) return idm.acceleration_mps2;
  if (ahead.id == agent.eased_for)
    return in_.following.FollowComing(id, static_cast<std::uint32_t>(ahead.id), ahead.gap_m);
  return driver::IdmAcceleration(idm, agent.speed_mps, in_.limits.Desired_mps(id), ahead.gap_m, ahead.speed_mps);
}

void Decisions::NoteLeader(std::uint32_t id) {
  Decided& last = out_.decided[id];
  const Leader& ahead = out_.seen[id];
  last.kept = ahead.any ? ahead.id : -1;
  if (last.kept < 0) return;
  const Agent& other = out_.agents[static_cast<std::size_t>(last.kept)];
  last.kept_trip = other.trip;
  last.apart_m = ahead.gap_m - (other.o_m - out_.agents[id].o_m);
}

void Decisions::KeepLeader(std::uint32_t id) {
  const Decided& last = out_.decided[id];
  Leader& ahead = out_.seen[id] = Leader();
  const Agent& agent = out_.agents[id];
  if (last.kept < 0 || !IsOf(last, agent)) return;
  const Agent& other = out_.agents[static_cast<std::size_t>(last.kept)];
  if (!other.on_road || last.kept_trip != static_cast<std::int64_t>(other.trip)) return;
  ahead.any = true, ahead.id = last.kept;
  ahead.gap_m = last.apart_m + (other.o_m - agent.o_m);
  ahead.speed_mps = other.speed_mps;
}

double Decisions::Kept(std::uint32_t id) {
  Decided& last = out_.decided[id];
  const Agent& agent = out_.agents[id];
  const double v = agent.speed_mps, granted_m = agent.granted_m;
  out_.signals.ApplyLights(id);
  if (agent.granted_m < granted_m)
    last.wanted_mps2 = std::min(last.wanted_mps2, in_.following.StopAt(id, agent.granted_m - kStopDistance_m));
  double wanted = IsOf(last, agent) ? last.wanted_mps2 : 0.0;
  if (last.follows) wanted = std::min(wanted, BehindLeader(id));
  wanted = std::min(wanted, (Cap_mps(agent, in_.traits[id]) - v) / in_.settings.tracking_s);
  wanted = std::max(wanted, -in_.traits[id].idm.max_deceleration_mps2);
  return agent.brake_mps2 > 0.0 ? std::min(wanted, -agent.brake_mps2) : wanted;
}

// A light that changes, a reservation that is given or taken back, and a vehicle in a zone before it show in what its
// passage and its zones leave it.
bool Decisions::MayKeep(std::uint32_t id, std::int64_t step_ns) const {
  const Decided& last = out_.decided[id];
  const Agent& agent = out_.agents[id];
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
  const Agent& agent = out_.agents[id];
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
  const double v = out_.agents[id].speed_mps, b = in_.traits[id].idm.braking_mps2;
  if ((ahead.any ? ahead.id : -1) != out_.decided[id].leader || (ahead.any && ahead.id < 0)) return true;
  if (v < kStandstill_mps) return false;
  if (out_.decided[id].wanted_mps2 < -b) return true;
  if (!ahead.any) return false;
  const double closes = v - ahead.speed_mps,
               room = std::max(kMinRoom_m, ahead.gap_m - 0.5 * in_.traits[id].idm.min_gap_m);
  return (closes > 0.0 && (closes * closes > 2.0 * b * room || room < kSoon_s * closes)) ||
         out_.agents[static_cast<std::size_t>(ahead.id)].desired_mps2 < -b;
}

}  // namespace rodeira::traffic
