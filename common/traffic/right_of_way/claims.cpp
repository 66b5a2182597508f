// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/right_of_way/claims.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "common/traffic/right_of_way/queueing.hpp"
#include "common/traffic/right_of_way/travel_time.hpp"
#include "common/traffic/state/vehicle_way.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kLaterThan_s = 30.0;    // of no interest now
constexpr double kBodyHorizon_s = 12.0;  // a long vehicle from rest, behind another one, needs so long to cross
constexpr double kYielded_mps2 =
    1.0;                        // by which others may have to brake, on the average, for one that merges before them
constexpr double kLag_s = 1.0;  // … and so much later than that one they come
constexpr double kEntryStandingMargin_m = 2.0;  // beyond its length, to stand between two zones near its entry

}  // namespace

// Zones lie in far memory where there are thousands of agents: those of an agent that soon requests its own are brought
// near meanwhile.
void Claims::FetchZones(std::size_t id) const {
  if (id >= out_.agents.size() || out_.agents[id].granted_m < out_.agents[id].o_m) return;
  for (const RouteSegment& stretch : in_.stretches[id]) {
    if (stretch.begin_m > out_.agents[id].granted_m) break;
    if (!stretch.crosses) continue;
    const auto sides = in_.map.zones.ConflictsOf(stretch.track);
    constexpr std::size_t kLine_bytes = 64;
    const auto* first = reinterpret_cast<const char*>(sides.data());
    for (std::size_t at = 0; at < sides.size_bytes(); at += kLine_bytes) __builtin_prefetch(first + at);
  }
}

void Claims::HoldZones(std::uint32_t id) {
  const Agent& agent = out_.agents[id];
  const double half = 0.5 * in_.traits[id].length_m, front = agent.o_m + half, rear = agent.o_m - half;
  const double to = std::max(front - kZoneOverhang_m, agent.granted_m);
  for (const RouteSegment& stretch : in_.stretches[id]) {
    if (stretch.begin_m > to) break;
    if (stretch.end_m < rear || !stretch.crosses) continue;
    for (const lanes::ZoneSide& part : in_.map.zones.ConflictsOf(stretch.track)) {
      const double in = stretch.zero_m + part.in_m, out = stretch.zero_m + part.out_m;
      if (in >= to || out <= rear) continue;
      const ZoneGrant grant = agent.GrantOf(in);
      out_.book.Hold(part.zone, static_cast<std::size_t>(part.side), {id, grant.sure, grant.number, out});
    }
  }
}

void Claims::RequestZones() {
  for (const std::uint32_t side : out_.asked_sides) out_.is_asked[side] = 0;
  out_.asked_sides.clear();
  for (const std::uint32_t id : in_.order) {
    if (!out_.passages[id].able) continue;
    for (const Crossing& crossing : out_.passages[id].crossings) {
      if (crossing.zone < 0) continue;
      const auto theirs = static_cast<std::uint32_t>(2 * crossing.zone + 1 - crossing.side);
      if (std::exchange(out_.is_asked[theirs], 1) == 0) out_.asked_sides.push_back(theirs);
    }
  }
}

void Claims::ComeToZones(std::uint32_t id) {
  const ConflictPassage& passage = out_.passages[id];
  if (out_.agents[id].brake_mps2 > 0.0 || passage.red || passage.barred ||
      (passage.due && !(passage.head && passage.able)))
    return;
  const auto is_asked = [&](const Crossing& crossing) {
    return crossing.zone >= 0 && out_.is_asked[static_cast<std::size_t>(2 * crossing.zone + crossing.side)] != 0;
  };
  if (std::none_of(passage.crossings.begin(), passage.crossings.end(), is_asked)) return;
  if (!passage.due) out_.room.TellComing(id);
  if (!passage.head || !passage.able || passage.arrives_s > kLaterThan_s) return;
  for (const Crossing& crossing : passage.crossings) {
    if (is_asked(crossing))
      out_.book.Come(static_cast<std::size_t>(crossing.zone), static_cast<std::size_t>(crossing.side),
                     {id, crossing.in_m, crossing.out_m});
  }
}

double Claims::ArrivesAt(const ApproachingVehicle& comer) const {
  if (comer.id >= out_.agents.size()) return comer.arrives_s;
  return ComesWithin(comer, comer.in_m - FrontOf(out_.agents[comer.id], in_.traits[comer.id])) +
         out_.passages[comer.id].later_s;
}

double Claims::ClearsAt(const ApproachingVehicle& comer) const {
  if (comer.id >= out_.agents.size()) return comer.clears_s;
  return ComesWithin(comer, comer.out_m - (FrontOf(out_.agents[comer.id], in_.traits[comer.id]) -
                                           in_.traits[comer.id].length_m)) +
         out_.passages[comer.id].later_s;
}

// When it has come so far, if it may go on as fast as it may at the zone's beginning.
double Claims::ComesWithin(const ApproachingVehicle& comer, double way_m) const {
  const Agent& agent = out_.agents[comer.id];
  return TravelTime(way_m, agent.speed_mps, in_.limits.AllowedAt(comer.id, comer.in_m), in_.traits[comer.id].start_mps2,
                    {agent.desired_mps2, in_.settings.smooth.planned_mps3});
}

bool Claims::IsFarEnough(std::uint32_t id, const Crossing& crossing, const ApproachingVehicle& comer, double comes_s,
                         double clears_s) const {
  if (in_.map.zones[static_cast<std::uint32_t>(crossing.zone)].kind != lanes::ZoneKind::kMerge ||
      comer.id >= out_.agents.size())
    return false;
  const Agent& agent = out_.agents[id];
  const double to_zone = crossing.in_m - agent.o_m - 0.5 * in_.traits[id].length_m;
  const double arrives = TravelTime(to_zone, agent.speed_mps, in_.limits.AllowedAt(id, crossing.in_m),
                                    in_.traits[id].start_mps2, {agent.desired_mps2, in_.settings.smooth.planned_mps3});
  if (!(comes_s > arrives + kLag_s)) return false;
  const double way = comer.out_m - FrontOf(out_.agents[comer.id], in_.traits[comer.id]), ends = ComesWithin(comer, way);
  const double comes = way * clears_s / std::max(0.1, ends), may_come = way - in_.settings.idm.min_gap_m;
  return 2.0 * (comes - may_come) < kYielded_mps2 * clears_s * clears_s;
}

void Claims::ComeLater(std::uint32_t id) {
  ConflictPassage& passage = out_.passages[id];
  passage.later_s = std::max(0.0, passage.delay_s);
}

void Claims::OthersAtZones() {
  if (!in_.any_block) return;
  const auto no_agent = static_cast<std::uint32_t>(out_.agents.size());
  for (std::uint32_t track = 0; track < in_.blocks.size(); ++track) {
    for (const Block& block : in_.blocks[track]) {
      for (const lanes::ZoneSide& part : in_.map.zones.Of(track)) {
        const lanes::Zone& zone = in_.map.zones[part.zone];
        const auto mine = static_cast<std::size_t>(part.side);
        if (zone.kind == lanes::ZoneKind::kDiverge ||
            std::min(std::fabs(block.span.left_m), std::fabs(block.span.right_m)) > 1.2)
          continue;
        if (block.span.front_m <= zone.in_m[mine] || block.span.rear_m >= zone.out_m[mine]) continue;
        out_.book.Hold(part.zone, mine, {no_agent});
      }
      if (block.span.speed_mps < 0.5 || block.span.left_m < -1.0 || block.span.right_m > 1.0) continue;
      // Where it goes is not known: it comes to all zones within kBodyHorizon_s, on every way; but not past a light
      // that is not green, if it can stop there.
      struct At {
        std::uint32_t track;
        double ahead_m;
      };
      std::vector<At> open{{track, -block.span.front_m}};
      for (std::size_t i = 0; i < open.size() && i < 64; ++i) {
        const At at = open[i];
        const double stops_m = in_.signals.RedAhead(at.track, -at.ahead_m, block.span.speed_mps);
        for (const lanes::ZoneSide& part : in_.map.zones.Of(at.track)) {
          const lanes::Zone& zone = in_.map.zones[part.zone];
          const auto mine = static_cast<std::size_t>(part.side);
          const double way = at.ahead_m + zone.in_m[mine], length = block.span.front_m - block.span.rear_m;
          if (zone.kind == lanes::ZoneKind::kDiverge || way < 0.0 || way > kBodyHorizon_s * block.span.speed_mps ||
              zone.in_m[mine] > stops_m)
            continue;
          out_.book.Come(part.zone, mine,
                         {no_agent, 0.0, 0.0, way / block.span.speed_mps,
                          (at.ahead_m + zone.out_m[mine] + length) / block.span.speed_mps});
        }
        const double end = at.ahead_m + in_.map.graph[at.track].length_m();
        if (end > kBodyHorizon_s * block.span.speed_mps || stops_m < kNoBarrier_m) continue;
        for (const lanes::Link& link : in_.map.graph[at.track].next) open.push_back({link.to, end - link.from_d_m});
      }
    }
  }
}

bool Claims::TakeFirstZones(std::uint32_t id) {
  Agent& agent = out_.agents[id];
  const double stand = in_.traits[id].length_m + kEntryStandingMargin_m;
  for (const RouteSegment& stretch : in_.stretches[id]) {
    if (stretch.begin_m > agent.granted_m + stand) break;
    for (const lanes::ZoneSide& part : in_.map.zones.ConflictsOf(stretch.track)) {
      if (stretch.zero_m + part.in_m > agent.granted_m + stand) break;
      if (!out_.book.ReservationsOf(part.zone, static_cast<std::size_t>(1 - part.side)).empty()) return false;
      agent.granted_m = std::max(agent.granted_m, stretch.zero_m + part.out_m);
    }
  }
  return true;
}

}  // namespace rodeira::traffic
