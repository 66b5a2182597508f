// SPDX-License-Identifier: Apache-2.0
// Who holds and who comes to each conflict zone.
#include <algorithm>
#include <cmath>
#include <utility>

#include "common/traffic/right_of_way/queueing.hpp"
#include "common/traffic/right_of_way/travel_time.hpp"
#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kLaterThan_s = 30.0;  // of no interest now

}  // namespace

// Zones lie in far memory where there are thousands of agents: those of who soon asks for his own are brought near
// meanwhile.
void TrafficModel::FetchZones(std::size_t id) const {
  if (id >= agents_.size() || agents_[id].granted_m < agents_[id].o_m) return;
  for (const Stretch& stretch : stretches_[id]) {
    if (stretch.begin_m > agents_[id].granted_m) break;
    if (!stretch.crosses) continue;
    const auto sides = zones().ConflictsOf(stretch.track);
    constexpr std::size_t kLine_bytes = 64;
    const auto* first = reinterpret_cast<const char*>(sides.data());
    for (std::size_t at = 0; at < sides.size_bytes(); at += kLine_bytes) __builtin_prefetch(first + at);
  }
}

// Its own are the zones that are granted to it and those that it stands in.
void TrafficModel::HoldZones(std::uint32_t id) {
  const Agent& agent = agents_[id];
  const double half = 0.5 * traits_[id].length_m, front = agent.o_m + half, rear = agent.o_m - half;
  const double to = std::max(front - kZoneOverhang_m, agent.granted_m);
  for (const Stretch& stretch : stretches_[id]) {
    if (stretch.begin_m > to) break;
    if (stretch.end_m < rear || !stretch.crosses) continue;
    for (const lanes::ZoneSide& part : zones().ConflictsOf(stretch.track)) {
      const double in = stretch.zero_m + part.in_m, out = stretch.zero_m + part.out_m;
      if (in >= to || out <= rear) continue;
      const ZoneGrant grant = agent.GrantOf(out);
      book_.Hold(part.zone, static_cast<std::size_t>(part.side), {id, grant.sure, grant.number, out});
    }
  }
}

// Which sides of zones those ask about who may be let in now.
void TrafficModel::AskForZones() {
  for (const std::uint32_t side : asked_sides_) is_asked_[side] = 0;
  asked_sides_.clear();
  for (const std::uint32_t id : order_) {
    if (!passages_[id].able) continue;
    for (const Crossing& crossing : passages_[id].crossings) {
      if (crossing.zone < 0) continue;
      const auto theirs = static_cast<std::uint32_t>(2 * crossing.zone + 1 - crossing.side);
      if (std::exchange(is_asked_[theirs], 1) == 0) asked_sides_.push_back(theirs);
    }
  }
}

// A head that waits to be granted its zones comes to them; where nobody asks it is not told.
void TrafficModel::ComeToZones(std::uint32_t id) {
  const Passage& passage = passages_[id];
  if (agents_[id].brake_mps2 > 0.0 || passage.red || passage.barred || (passage.due && !(passage.head && passage.able)))
    return;
  const auto is_asked = [&](const Crossing& crossing) {
    return crossing.zone >= 0 && is_asked_[static_cast<std::size_t>(2 * crossing.zone + crossing.side)] != 0;
  };
  if (std::none_of(passage.crossings.begin(), passage.crossings.end(), is_asked)) return;
  if (!passage.due) TellComing(id);
  if (!passage.head || !passage.able || passage.arrives_s > kLaterThan_s) return;
  for (const Crossing& crossing : passage.crossings) {
    if (is_asked(crossing))
      book_.Come(static_cast<std::size_t>(crossing.zone), static_cast<std::size_t>(crossing.side),
                 {id, crossing.in_m, crossing.out_m});
  }
}

// Its front at the zone's beginning.
double TrafficModel::ArrivesAt(const Comer& comer) const {
  if (comer.id >= agents_.size()) return comer.arrives_s;
  return ComesWithin(comer, comer.in_m - FrontOf(comer.id)) + passages_[comer.id].later_s;
}

// Its rear at the zone's end.
double TrafficModel::ClearsAt(const Comer& comer) const {
  if (comer.id >= agents_.size()) return comer.clears_s;
  return ComesWithin(comer, comer.out_m - (FrontOf(comer.id) - traits_[comer.id].length_m)) +
         passages_[comer.id].later_s;
}

// When it has come so far, if it may go on as fast as it may at the zone's beginning.
double TrafficModel::ComesWithin(const Comer& comer, double way_m) const {
  const Agent& agent = agents_[comer.id];
  return TravelTime(way_m, agent.speed_mps, AllowedAt(comer.id, comer.in_m), traits_[comer.id].start_mps2,
                    {agent.wish_mps2, settings_.smooth.planned_mps3});
}

// Who has just been refused does not come before whoever keeps it out is gone.
void TrafficModel::ComeLater(std::uint32_t id) {
  Passage& passage = passages_[id];
  passage.later_s = std::max(0.0, passage.delay_s);
}

// Vehicles that are no agents.
void TrafficModel::OthersAtZones() {
  if (!any_block_) return;
  const auto nobody = static_cast<std::uint32_t>(agents_.size());
  for (std::uint32_t track = 0; track < blocks_.size(); ++track) {
    for (const Block& block : blocks_[track]) {
      for (const lanes::ZoneSide& part : zones().Of(track)) {
        const lanes::Zone& zone = zones()[part.zone];
        const auto mine = static_cast<std::size_t>(part.side);
        if (zone.kind == lanes::ZoneKind::kDiverge ||
            std::min(std::fabs(block.span.left_m), std::fabs(block.span.right_m)) > 1.2)
          continue;
        if (block.span.front_m <= zone.in_m[mine] || block.span.rear_m >= zone.out_m[mine]) continue;
        book_.Hold(part.zone, mine, {nobody});
      }
      if (block.span.speed_mps < 0.5 || block.span.left_m < -1.0 || block.span.right_m > 1.0) continue;
      // Where it goes is not known: it comes to all zones within six seconds, on every way; but not past a light that
      // is not green, if it can stop there.
      struct At {
        std::uint32_t track;
        double ahead_m;
      };
      std::vector<At> open{{track, -block.span.front_m}};
      for (std::size_t i = 0; i < open.size() && i < 64; ++i) {
        const At at = open[i];
        const double stops_m = RedAhead(at.track, -at.ahead_m, block.span.speed_mps);
        for (const lanes::ZoneSide& part : zones().Of(at.track)) {
          const lanes::Zone& zone = zones()[part.zone];
          const auto mine = static_cast<std::size_t>(part.side);
          const double way = at.ahead_m + zone.in_m[mine], length = block.span.front_m - block.span.rear_m;
          if (zone.kind == lanes::ZoneKind::kDiverge || way < 0.0 || way > 6.0 * block.span.speed_mps ||
              zone.in_m[mine] > stops_m)
            continue;
          book_.Come(part.zone, mine,
                     {nobody, 0.0, 0.0, way / block.span.speed_mps,
                      (at.ahead_m + zone.out_m[mine] + length) / block.span.speed_mps});
        }
        const double end = at.ahead_m + graph()[at.track].length_m();
        if (end > 6.0 * block.span.speed_mps || stops_m < kNoBarrier_m) continue;
        for (const lanes::Link& link : graph()[at.track].next) open.push_back({link.to, end - link.from_d_m});
      }
    }
  }
}

}  // namespace rodeira::traffic
