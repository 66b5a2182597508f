// SPDX-License-Identifier: Apache-2.0
// Who may go: conflict zones are granted all at once from one place to stand to the next, in an order that depends on
// nothing but who waits, who has the right of way, and the agents' numbers.
#include <algorithm>
#include <cmath>

#include "common/traffic/perception/each_driving.hpp"
#include "common/traffic/right_of_way/queueing.hpp"
#include "common/traffic/right_of_way/travel_time.hpp"
#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {
namespace {

// A vehicle that has waited longer has priority over vehicles that have waited less.
constexpr double kPriorityWait_s = 40.0;
constexpr double kGap_s = 1.0;     // after the own clearing before who goes first may arrive
constexpr double kBehind_s = 0.5;  // after the own arrival who holds a zone may be out of it at the latest
constexpr double kZipSpeed_mps = 7.0,
                 kZipTime_s = 4.0;  // a vehicle this slow and this close to a merge takes turns with the other lane
constexpr std::size_t kZonePrefetch = 6;  // agents ahead whose zones are prefetched
constexpr double kAtLine_m = 1.5;         // a full stop counts within this before the line

// The side of who was let in last of those who hold a zone, by both sides; -1: nobody does.
int LastLetIn(const ZoneBook& book, std::size_t zone, std::size_t agents) {
  int last = -1;
  std::uint64_t number = 0;
  for (const int side : {0, 1}) {
    for (const Holder& holder : book.HoldersOf(zone, static_cast<std::size_t>(side))) {
      if (holder.id < agents && holder.number > number) number = holder.number, last = side;
    }
  }
  return last;
}

}  // namespace

bool TrafficModel::Urgent(std::uint32_t id) const { return agents_[id].waited_s > kPriorityWait_s; }

// Where two ways merge who holds the zone takes up room behind it, too.
bool TrafficModel::RoomBehind(std::uint32_t id, const Crossing& crossing, const Holder& holder) {
  const Passage& passage = passages_[id];
  if (!passage.able || zones()[static_cast<std::uint32_t>(crossing.zone)].kind != lanes::ZoneKind::kMerge) return true;
  const double its_rear = agents_[holder.id].o_m - 0.5 * traits_[holder.id].length_m;
  if (crossing.out_m + its_rear + ReachOf(holder.id, 0) - holder.out_m < passage.room_m) return false;
  return LeavesInTime(id, holder.id, passage.room_m - crossing.out_m + holder.out_m - its_rear);
}

// Whether who holds the zone takes up the same room behind it, and does not go round there.
bool TrafficModel::TakesRoom(const Crossing& crossing) const {
  const lanes::Zone& zone = zones()[static_cast<std::uint32_t>(crossing.zone)];
  return zone.kind == lanes::ZoneKind::kMerge && map_->plans[zone.track[0]].turn != kRing &&
         map_->plans[zone.track[1]].turn != kRing;
}

// Whether somebody keeps it out of the zone: who is in it, or has been granted it, and is not surely out before it
// comes; and, where that is `heeded`, who has waited longer.
bool TrafficModel::Held(std::uint32_t id, const Crossing& crossing, bool heeded) {
  const auto zone = static_cast<std::size_t>(crossing.zone);
  const auto mine = static_cast<std::size_t>(crossing.side), theirs = 1 - mine;
  const Agent& agent = agents_[id];
  const double to_zone = crossing.in_m - agent.o_m - 0.5 * traits_[id].length_m;
  double arrives = -1.0;
  for (const Holder& holder : book_.HoldersOf(zone, theirs)) {
    if (holder.id == id) continue;
    if (holder.id < agents_.size()) {
      const Agent& other = agents_[holder.id];
      const double way_out = holder.out_m - other.o_m + 0.5 * traits_[holder.id].length_m;
      const double clears = TravelTime(way_out, other.speed_mps, AllowedAt(holder.id, holder.out_m),
                                       traits_[holder.id].start_mps2, {other.wish_mps2, settings_.smooth.planned_mps3});
      if (arrives < 0.0)
        arrives = TravelTime(to_zone, agent.speed_mps, AllowedAt(id, crossing.in_m), traits_[id].start_mps2,
                             {agent.wish_mps2, settings_.smooth.planned_mps3});
      if (holder.sure && (clears < arrives + kBehind_s || MayFollow(id, crossing, holder)) &&
          RoomBehind(id, crossing, holder))
        continue;
      passages_[id].delay_s = clears - arrives;
    }
    passages_[id].waits_for = holder.id == agents_.size() ? -1 : static_cast<std::int64_t>(holder.id);
    return true;
  }
  if (!heeded) return false;
  if (const ZoneBook::Wish wish = book_.RoomWanted(zone, mine); wish.waited_s > agent.waited_s) {
    passages_[id].waits_for = static_cast<std::int64_t>(wish.id);
    return true;
  }
  return book_.IsAwaited(zone, mine) && !Urgent(id);
}

// The same of any of its zones.
bool TrafficModel::IsHeld(std::uint32_t id, bool heeded) {
  const auto& crossings = passages_[id].crossings;
  return std::any_of(crossings.begin(), crossings.end(),
                     [&](const Crossing& crossing) { return crossing.zone >= 0 && Held(id, crossing, heeded); });
}

// Whether somebody who goes first is about to come to the zone before this one is out of it. Where lanes zip, it is the
// other side's turn as long as who was let in last is from this one.
bool TrafficModel::Yields(std::uint32_t id, const Crossing& crossing) {
  const auto index = static_cast<std::size_t>(crossing.zone);
  const int theirs = 1 - crossing.side;
  const lanes::Zone& zone = zones()[static_cast<std::uint32_t>(index)];
  const auto comers = book_.ComersTo(index, static_cast<std::size_t>(theirs));
  if (comers.empty()) return false;
  const int last = map_->zips[index] ? LastLetIn(book_, index, agents_.size()) : -1;
  if (zone.first == crossing.side && last != crossing.side) return false;
  const Agent& agent = agents_[id];
  const double way_out = crossing.out_m - agent.o_m + 0.5 * traits_[id].length_m;
  const double clears = TravelTime(way_out, agent.speed_mps, AllowedAt(id, crossing.out_m), traits_[id].start_mps2,
                                   {agent.wish_mps2, settings_.smooth.planned_mps3});
  for (const Comer& comer : comers) {
    if (comer.id == id) continue;
    const bool agents = comer.id < agents_.size();
    const bool slow =
        agents && agents_[comer.id].speed_mps < kZipSpeed_mps && passages_[comer.id].arrives_s < kZipTime_s;
    const bool its_turn = slow && last == crossing.side;
    if (slow && last == theirs) continue;
    if (agents && Urgent(id) && agents_[comer.id].waited_s < agent.waited_s) continue;
    if (!its_turn) {
      if (zone.first == crossing.side) continue;
      const double arrives = ArrivesAt(comer);
      if (arrives > clears + kGap_s || IsFarEnough(id, crossing, comer, arrives, clears)) continue;
    }
    passages_[id].waits_for = agents ? static_cast<std::int64_t>(comer.id) : -1;
    const double to_zone = crossing.in_m - agent.o_m - 0.5 * traits_[id].length_m;
    passages_[id].delay_s =
        ClearsAt(comer) - TravelTime(to_zone, agent.speed_mps, AllowedAt(id, crossing.in_m), traits_[id].start_mps2,
                                     {agent.wish_mps2, settings_.smooth.planned_mps3});
    return true;
  }
  return false;
}

// Grants the passage unless somebody is in its way: holds one of the zones or, where the agent has to yield, comes to
// one or has waited longer.
bool TrafficModel::Grant(std::uint32_t id, bool yields) {
  Passage& passage = passages_[id];
  if (IsHeld(id, yields)) return false;
  for (const Crossing& crossing : passage.crossings) {
    if (yields && crossing.zone >= 0 && Yields(id, crossing)) return false;
  }
  const ZoneGrant grant{passage.end_m, next_grant_++, passage.able, passage.lit ? passage.line_m : -1.0};
  agents_[id].granted_m = passage.end_m;
  agents_[id].grants.push_back(grant);
  for (const Crossing& crossing : passage.crossings) {
    if (crossing.zone < 0) continue;
    book_.Hold(static_cast<std::size_t>(crossing.zone), static_cast<std::size_t>(crossing.side),
               {id, grant.sure, grant.number, crossing.out_m});
  }
  passage.any = false, passage.key = {};
  return true;
}

// Its grants and its next passage, and whether it has come to rest at a STOP line or waits for others.
void TrafficModel::ComeToLine(std::uint32_t id, double dt_s) {
  Agent& agent = agents_[id];
  const double half = 0.5 * traits_[id].length_m;
  if (!agent.grants.empty())
    agent.grants.erase(std::remove_if(agent.grants.begin(), agent.grants.end(),
                                      [&](const ZoneGrant& grant) { return grant.to_m <= agent.o_m - half; }),
                       agent.grants.end());
  ObeyLights(id);
  FindPassage(id);
  Passage& passage = passages_[id];
  passage.barred = bars_[id] < passage.line_m;
  const double to_line = passage.line_m - agent.o_m - half;
  if (passage.any && passage.must_stop && agent.speed_mps < kStandstill_mps && to_line < kAtLine_m) {
    agent.stopped_m = passage.line_m;
    passage.must_stop = false;
  }
  if (!passage.any || agent.speed_mps > 1.0)
    agent.waited_s = 0.0;
  else if (agent.speed_mps < kStandstill_mps && !passage.red && !passage.barred)
    agent.waited_s += dt_s;
}

void TrafficModel::Arbitrate(double dt_s) {
  const std::int64_t step_ns = std::llround(dt_s * 1e9);
  book_.Clear();
  EachDriving([&](std::uint32_t id) {
    if (!people_) ahead_[id] = FindAhead(id);
    ComeToLine(id, dt_s);
  });
  std::fill(reaches_.begin(), reaches_.end(), -1.0);
  heads_.clear(), order_.clear(), coming_.clear(), held_up_.clear();
  for (std::uint32_t id = 0; id < agents_.size(); ++id) {
    Passage& passage = passages_[id];
    if (!agents_[id].on_road) {
      passage.any = false, passage.key = {};
      continue;
    }
    FetchZones(id + kZonePrefetch);
    HoldZones(id);
    if (!agents_[id].grants.empty() && agents_[id].speed_mps < kStandstill_mps) held_up_.push_back(id);
  }
  for (std::uint32_t id = 0; id < agents_.size(); ++id) {  // how far who is ahead comes depends on who holds his zones
    Passage& passage = passages_[id];
    if (!passage.any) continue;
    coming_.push_back(id);
    if (!passage.due) continue;
    TellComing(id);
    if (passage.red || passage.barred)
      passage.waits_for = -1;
    else if (passage.head && !passage.must_stop)
      order_.push_back(id);
    if (passage.head) heads_.push_back(id);
  }
  AskForZones();
  for (const std::uint32_t id : coming_) ComeToZones(id);
  OthersAtZones();
  // Who has lost patience, by how long; then by when they come to the line, as told by their own motion; then by
  // number.
  std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
    const double patience_a = Urgent(a) ? agents_[a].waited_s : 0.0, patience_b = Urgent(b) ? agents_[b].waited_s : 0.0;
    if (patience_a != patience_b) return patience_a > patience_b;
    if (passages_[a].arrives_s != passages_[b].arrives_s) return passages_[a].arrives_s < passages_[b].arrives_s;
    return a < b;
  });
  for (const std::uint32_t id : order_) {
    Passage& passage = passages_[id];
    if (passage.able && Grant(id, true)) continue;
    if (!Urgent(id)) {
      if (passage.able) ComeLater(id);
      continue;
    }
    // Nobody else takes up what it waits for; nor, where there is not room enough for it yet, what there is of it, if
    // he is shorter.
    const bool comes_free = !passage.able && passage.lacks_m < traits_[id].length_m + settings_.idm.standing_gap_m;
    for (const Crossing& crossing : passage.crossings) {
      if (crossing.zone < 0 || !(passage.able || (comes_free && TakesRoom(crossing)))) continue;
      const auto zone = static_cast<std::size_t>(crossing.zone), theirs = static_cast<std::size_t>(1 - crossing.side);
      if (passage.able)
        book_.Await(zone, theirs);
      else
        book_.WantRoom(zone, theirs, {agents_[id].waited_s, id});
    }
  }
  for (const std::uint32_t id : order_) {  // … and now who had to yield to such as cannot come yet
    if (passages_[id].any && passages_[id].able) Grant(id, true);
  }
  ResolveDeadlocks();
  EachDriving([&](std::uint32_t id) {
    FetchZones(id + kZonePrefetch);
    YieldInZones(id);
    const Agent& agent = agents_[id];
    beside_[id] = agent.change.side != 0 || HasBeside(id, agent.path.back().track);
    passes_[id] =
        agent.overtaking.active() || agent.told_past || (settings_.overtaking.allowed && IsItsTurn(id, step_ns));
  });
}

}  // namespace rodeira::traffic
