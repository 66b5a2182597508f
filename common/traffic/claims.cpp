// Who holds and who comes to each conflict zone.
#include <algorithm>
#include <cmath>

#include "common/traffic/traffic_model.hpp"
#include "common/traffic/travel_time.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kOverLine_m = 0.3;    // a front so far beyond a line that lies where a zone begins still waits before it
constexpr double kLaterThan_s = 30.0;  // of no interest now

}  // namespace

// Only zones that something was said of are cleared for the next step.
void TrafficModel::Touch(std::uint32_t zone) {
  if (now_[zone].touched) return;
  now_[zone].touched = true;
  touched_.push_back(zone);
}

// Its own are the zones that are granted to it and those that it stands in.
void TrafficModel::HoldZones(std::uint32_t id) {
  const Agent& agent = agents_[id];
  const double half = 0.5 * traits_[id].length_m, front = agent.o_m + half, rear = agent.o_m - half;
  const double to = std::max(front - kOverLine_m, agent.granted_m);
  for (const Stretch& stretch : stretches_[id]) {
    if (stretch.begin_m > to) break;
    if (stretch.end_m < rear) continue;
    for (const lanes::ZoneSide& part : zones().Of(stretch.track)) {
      const double in = stretch.zero_m + part.in_m, out = stretch.zero_m + part.out_m;
      if (part.kind == lanes::ZoneKind::kDiverge || in >= to || out <= rear) continue;
      Touch(part.zone);
      now_[part.zone].holders[static_cast<std::size_t>(part.side)].push_back({id, agent.GrantOf(out), out});
    }
  }
}

// A head that waits to be granted its zones comes to them.
void TrafficModel::ComeToZones(std::uint32_t id) {
  const Passage& passage = passages_[id];
  if (!passage.able || passage.arrives_s > kLaterThan_s) return;
  if (agents_[id].brake_mps2 > 0.0 || passage.red || passage.barred) return;
  const double front = agents_[id].o_m + 0.5 * traits_[id].length_m, rear = front - traits_[id].length_m;
  const Setting off{agents_[id].wish_mps2, settings_.smooth.planned_mps3};
  for (const Crossing& crossing : passage.crossings) {
    if (crossing.zone < 0) continue;
    const double most = AllowedAt(id, crossing.in_m);
    Touch(static_cast<std::uint32_t>(crossing.zone));
    now_[static_cast<std::size_t>(crossing.zone)].comers[static_cast<std::size_t>(crossing.side)].push_back(
        {id, TravelTime(crossing.in_m - front, agents_[id].speed_mps, most, traits_[id].start_mps2, off),
         TravelTime(crossing.out_m - rear, agents_[id].speed_mps, most, traits_[id].start_mps2, off), crossing.out_m - front,
         TravelTime(crossing.out_m - front, agents_[id].speed_mps, most, traits_[id].start_mps2, off)});
  }
}

// Who has just been refused does not come before whoever keeps it out is gone.
void TrafficModel::ComeLater(std::uint32_t id) {
  const Passage& passage = passages_[id];
  if (passage.delay_s <= 0.0) return;
  for (const Crossing& crossing : passage.crossings) {
    if (crossing.zone < 0) continue;
    for (Claim& claim : now_[static_cast<std::size_t>(crossing.zone)].comers[static_cast<std::size_t>(crossing.side)]) {
      if (claim.id == id) claim.arrives_s += passage.delay_s, claim.clears_s += passage.delay_s;
    }
  }
}

// Vehicles that are no agents.
void TrafficModel::OthersAtZones() {
  const auto nobody = static_cast<std::uint32_t>(agents_.size());
  for (std::uint32_t track = 0; track < blocks_.size(); ++track) {
    for (const Block& block : blocks_[track]) {
      for (const lanes::ZoneSide& part : zones().Of(track)) {
        const lanes::Zone& zone = zones()[part.zone];
        const auto mine = static_cast<std::size_t>(part.side);
        if (zone.kind == lanes::ZoneKind::kDiverge || std::min(std::fabs(block.span.left_m), std::fabs(block.span.right_m)) > 1.2) continue;
        if (block.span.front_m <= zone.in_m[mine] || block.span.rear_m >= zone.out_m[mine]) continue;
        Touch(part.zone);
        now_[part.zone].holders[mine].push_back({nobody, {}, 0.0});
      }
      if (block.span.speed_mps < 0.5 || block.span.left_m < -1.0 || block.span.right_m > 1.0) continue;
      // Where it goes is not known: it comes to all zones within six seconds, on every way; but not past a light that is not green, if it can stop there.
      struct At { std::uint32_t track; double ahead_m; };
      std::vector<At> open{{track, -block.span.front_m}};
      for (std::size_t i = 0; i < open.size() && i < 64; ++i) {
        const At at = open[i];
        const double stops_m = RedAhead(at.track, -at.ahead_m, block.span.speed_mps);
        for (const lanes::ZoneSide& part : zones().Of(at.track)) {
          const lanes::Zone& zone = zones()[part.zone];
          const auto mine = static_cast<std::size_t>(part.side);
          const double way = at.ahead_m + zone.in_m[mine], length = block.span.front_m - block.span.rear_m;
          if (zone.kind == lanes::ZoneKind::kDiverge || way < 0.0 || way > 6.0 * block.span.speed_mps || zone.in_m[mine] > stops_m) continue;
          Touch(part.zone);
          now_[part.zone].comers[mine].push_back(
              {nobody, way / block.span.speed_mps, (at.ahead_m + zone.out_m[mine] + length) / block.span.speed_mps});
        }
        const double end = at.ahead_m + graph()[at.track].length_m();
        if (end > 6.0 * block.span.speed_mps || stops_m < kNoBarrier_m) continue;
        for (const lanes::Link& link : graph()[at.track].next) open.push_back({link.to, end - link.from_d_m});
      }
    }
  }
}

}  // namespace rodeira::traffic
