// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/right_of_way/grants.hpp"

#include <algorithm>
#include <cstddef>

#include "common/traffic/right_of_way/travel_time.hpp"

namespace rodeira::traffic {
namespace {

// A vehicle that has waited longer has priority over vehicles that have waited less.
constexpr double kPriorityWait_s = 40.0;

constexpr double kGap_s = 1.0;     // after the own clearing before the one with priority may arrive
constexpr double kTouch_s = 0.3;   // the same, of one that its leader keeps from clearing sooner
constexpr double kBehind_s = 0.5;  // after the own arrival a zone's holder may be out of it at the latest
constexpr double kZipSpeed_mps = 7.0,
                 kZipTime_s = 4.0;  // a vehicle this slow and this close to a merge takes turns with the other lane

// The side of the last reservation of a zone, by both sides; -1: there is none.
int LastGranted(const ReservationTable& book, std::size_t zone, std::size_t agents) {
  int last = -1;
  std::uint64_t number = 0;
  for (const int side : {0, 1}) {
    for (const Reservation& holder : book.ReservationsOf(zone, static_cast<std::size_t>(side))) {
      if (holder.id < agents && holder.number > number) number = holder.number, last = side;
    }
  }
  return last;
}

}  // namespace

// Whether it waits past a light for oncoming traffic, and the light is green no more.
bool Grants::ClearsJunction(std::uint32_t id) const {
  return out_.agents[id].waits_inside() && !in_.signals.IsGreen(out_.agents[id].grants.back().light);
}

bool Grants::Urgent(std::uint32_t id) const { return out_.agents[id].waited_s > kPriorityWait_s || ClearsJunction(id); }

// Where two ways merge the holder of the zone takes up room behind it, too.
bool Grants::RoomBehind(std::uint32_t id, const Crossing& crossing, const Reservation& holder) {
  const ConflictPassage& passage = out_.passages[id];
  if (!passage.able || in_.map.zones[static_cast<std::uint32_t>(crossing.zone)].kind != lanes::ZoneKind::kMerge)
    return true;
  const double its_rear = out_.agents[holder.id].o_m - 0.5 * in_.traits[holder.id].length_m;
  if (crossing.out_m + its_rear + out_.room.ReachOf(holder.id, 0) - holder.out_m < passage.room_m) return false;
  return out_.room.LeavesInTime(id, holder.id, passage.room_m - crossing.out_m + holder.out_m - its_rear);
}

bool Grants::TakesRoom(const Crossing& crossing) const {
  const lanes::Zone& zone = in_.map.zones[static_cast<std::uint32_t>(crossing.zone)];
  return zone.kind == lanes::ZoneKind::kMerge && in_.map.plans[zone.track[0]].turn != kRing &&
         in_.map.plans[zone.track[1]].turn != kRing;
}

// Whether a vehicle keeps it out of the zone: one in it, or with a grant, that is not surely out before it
// comes; and, where that is `heeded`, one that has waited longer.
bool Grants::Held(std::uint32_t id, const Crossing& crossing, bool heeded) {
  const auto zone = static_cast<std::size_t>(crossing.zone);
  const auto mine = static_cast<std::size_t>(crossing.side), theirs = 1 - mine;
  const Agent& agent = out_.agents[id];
  const double to_zone = crossing.in_m - agent.o_m - 0.5 * in_.traits[id].length_m;
  double arrives = -1.0;
  for (const Reservation& holder : out_.book.ReservationsOf(zone, theirs)) {
    if (holder.id == id) continue;
    if (holder.id < out_.agents.size()) {
      const Agent& other = out_.agents[holder.id];
      const double way_out = holder.out_m - other.o_m + 0.5 * in_.traits[holder.id].length_m;
      const double clears =
          TravelTime(way_out, other.speed_mps, in_.limits.AllowedAt(holder.id, holder.out_m),
                     in_.traits[holder.id].start_mps2, {other.desired_mps2, in_.settings.smooth.planned_mps3});
      if (arrives < 0.0)
        arrives = TravelTime(to_zone, agent.speed_mps, in_.limits.AllowedAt(id, crossing.in_m),
                             in_.traits[id].start_mps2, {agent.desired_mps2, in_.settings.smooth.planned_mps3});
      if (holder.sure && (clears < arrives + kBehind_s || in_.merging.MayFollow(id, crossing, holder)) &&
          RoomBehind(id, crossing, holder))
        continue;
      out_.passages[id].delay_s = clears - arrives;
    }
    out_.passages[id].waits_for = holder.id == out_.agents.size() ? -1 : static_cast<std::int64_t>(holder.id);
    return true;
  }
  if (!heeded) return false;
  if (const ReservationTable::SpaceRequest request = out_.book.RoomWanted(zone, mine);
      request.waited_s > agent.waited_s) {
    out_.passages[id].waits_for = static_cast<std::int64_t>(request.id);
    return true;
  }
  return out_.book.IsAwaited(zone, mine) && !Urgent(id);
}

// The same of any of its zones.
bool Grants::IsHeld(std::uint32_t id, bool heeded) {
  const auto& crossings = out_.passages[id].crossings;
  return std::any_of(crossings.begin(), crossings.end(),
                     [&](const Crossing& crossing) { return crossing.zone >= 0 && Held(id, crossing, heeded); });
}

// Seconds until a vehicle that follows another one out of the zone is clear of it, at the earliest: in a queue each one
// drives as its leader does, later by its time gap and behind by a minimum gap (Newell 2002). 0: it follows none.
double Grants::ClearsBehindLeader(std::uint32_t id, double out_m) const {
  const Leader& ahead = in_.ahead[id];
  if (ahead.id < 0) return 0.0;
  const auto leader = static_cast<std::uint32_t>(ahead.id);
  const double own_rear_there = out_m + in_.traits[id].length_m;  // odometer of the front
  const double its_rear = out_.agents[id].o_m + 0.5 * in_.traits[id].length_m + ahead.gap_m;
  const double way = own_rear_there + in_.traits[id].idm.min_gap_m - its_rear;
  if (way <= 0.0) return 0.0;
  return in_.traits[id].idm.time_gap_s +
         TravelTime(way, ahead.speed_mps, in_.limits.Desired_mps(leader), in_.traits[leader].start_mps2,
                    {out_.agents[leader].desired_mps2, in_.settings.smooth.planned_mps3});
}

// Whether one with priority is about to come to the zone before this one is out of it. Where lanes zip, it is the
// other side's turn as long as the last reservation is from this one.
bool Grants::Yields(std::uint32_t id, const Crossing& crossing) {
  const auto index = static_cast<std::size_t>(crossing.zone);
  const int theirs = 1 - crossing.side;
  const lanes::Zone& zone = in_.map.zones[static_cast<std::uint32_t>(index)];
  const auto comers = out_.book.ApproachingTo(index, static_cast<std::size_t>(theirs));
  if (comers.empty()) return false;
  const int last = in_.map.zips[index] ? LastGranted(out_.book, index, out_.agents.size()) : -1;
  if (zone.first == crossing.side && last != crossing.side) return false;
  const Agent& agent = out_.agents[id];
  const double way_out = crossing.out_m - agent.o_m + 0.5 * in_.traits[id].length_m;
  const double clears = TravelTime(way_out, agent.speed_mps, in_.limits.AllowedAt(id, crossing.out_m),
                                   in_.traits[id].start_mps2, {agent.desired_mps2, in_.settings.smooth.planned_mps3});
  const double follows = ClearsBehindLeader(id, crossing.out_m);
  for (const ApproachingVehicle& comer : comers) {
    if (comer.id == id) continue;
    const bool agents = comer.id < out_.agents.size();
    const bool slow =
        agents && out_.agents[comer.id].speed_mps < kZipSpeed_mps && out_.passages[comer.id].arrives_s < kZipTime_s;
    const bool its_turn = slow && last == crossing.side;
    if (slow && last == theirs) continue;
    if (agents && Urgent(id) && out_.agents[comer.id].waited_s < agent.waited_s) continue;
    if (agents && ClearsJunction(id) && !ClearsJunction(comer.id)) continue;
    if (!its_turn) {
      if (zone.first == crossing.side) continue;
      const double arrives = in_.claims.ArrivesAt(comer);
      if ((arrives > clears + kGap_s && arrives > follows + kTouch_s) ||
          in_.claims.IsFarEnough(id, crossing, comer, arrives, clears))
        continue;
    }
    out_.passages[id].waits_for = agents ? static_cast<std::int64_t>(comer.id) : -1;
    const double to_zone = crossing.in_m - agent.o_m - 0.5 * in_.traits[id].length_m;
    out_.passages[id].delay_s =
        in_.claims.ClearsAt(comer) - TravelTime(to_zone, agent.speed_mps, in_.limits.AllowedAt(id, crossing.in_m),
                                                in_.traits[id].start_mps2,
                                                {agent.desired_mps2, in_.settings.smooth.planned_mps3});
    return true;
  }
  return false;
}

bool Grants::Grant(std::uint32_t id, bool yields) {
  ConflictPassage& passage = out_.passages[id];
  if (IsHeld(id, yields)) return false;
  for (const Crossing& crossing : passage.crossings) {
    if (yields && crossing.zone >= 0 && Yields(id, crossing)) return false;
  }
  for (ZoneGrant& grant : out_.agents[id].grants) grant.sure = grant.sure || (grant.light >= 0 && passage.able);
  Take(id, passage.crossings.size(),
       {passage.end_m, out_.next_grant++, passage.able, passage.lit ? passage.line_m : -1.0, passage.end_m});
  return true;
}

bool Grants::GrantToWait(std::uint32_t id) {
  const ConflictPassage& passage = out_.passages[id];
  const WaitingPlace& place = passage.place;
  if (place.in_m < 0.0) return false;
  double clear = place.in_m;
  for (std::size_t i = 0; i < place.crossings; ++i) {
    const Crossing& crossing = passage.crossings[i];
    if (crossing.zone >= 0 && (Held(id, crossing, true) || Yields(id, crossing))) return false;
    clear = std::max(clear, crossing.out_m);
  }
  if (!out_.room.RoomToWait(id)) return false;
  Take(id, place.crossings, {place.in_m, out_.next_grant++, false, passage.line_m, clear, place.light});
  return true;
}

// Its own are so many of the crossings of its passage.
void Grants::Take(std::uint32_t id, std::size_t crossings, const ZoneGrant& grant) {
  out_.agents[id].granted_m = grant.to_m;
  out_.agents[id].grants.push_back(grant);
  for (std::size_t i = 0; i < crossings; ++i) {
    const Crossing& crossing = out_.passages[id].crossings[i];
    if (crossing.zone < 0) continue;
    out_.book.Hold(static_cast<std::size_t>(crossing.zone), static_cast<std::size_t>(crossing.side),
                   {id, grant.sure, grant.number, crossing.out_m});
  }
  out_.passages_ahead.FindPassage(id);  // how far it comes depends on its next line
}

}  // namespace rodeira::traffic
