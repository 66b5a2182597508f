// The next conflict zones on an agent's way, and who holds or comes to each zone.
#include <algorithm>
#include <cmath>

#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kLine_m = 0.6;         // before the first zone the front stops
constexpr double kStand_m = 2.5;        // more than its length a car needs to stand between two zones
constexpr double kReaction_s = 1.0;
constexpr double kEarly_m = 4.0;
constexpr double kStart_mps2 = 1.3;     // acceleration by which times are told in advance
constexpr double kHardest_mps2 = 3.0;   // braking by which it is told where a car ahead could stand
constexpr double kLaterThan_s = 30.0;   // of no interest now
constexpr double kStopped_m = 2.0;      // at most so far before a STOP line

// From speed v over a distance, faster by kStart_mps2 up to `most`.
double TravelTime(double distance_m, double v, double most_mps) {
  if (distance_m <= 0.0) return 0.0;
  const double top = std::max({most_mps, v, 0.5});
  const double gaining = (top * top - v * v) / (2.0 * kStart_mps2);
  if (distance_m >= gaining) return (top - v) / kStart_mps2 + (distance_m - gaining) / top;
  return (std::sqrt(v * v + 2.0 * kStart_mps2 * distance_m) - v) / kStart_mps2;
}

}  // namespace

double TrafficModel::AllowedAt(std::uint32_t id, double odometer_m) const {
  for (const Stretch& stretch : stretches_[id]) {
    if (stretch.end_m < odometer_m && &stretch != &stretches_[id].back()) continue;
    return map_->plans[stretch.track].plan.At(odometer_m - stretch.zero_m).speed_mps * traits_[id].speed_factor;
  }
  return 0.0;
}

void TrafficModel::FindPassage(std::uint32_t id) {
  const Agent& agent = agents_[id];
  const double half = 0.5 * traits_[id].length_m, front = agent.o_m + half, rear = agent.o_m - half;
  Passage& passage = passages_[id];
  auto crossings = std::move(passage.crossings);
  crossings.clear();
  passage = Passage();
  const double stand = traits_[id].length_m + kStand_m;
  const auto take = [&](const Crossing& crossing) {
    if (!passage.any) passage.line_m = crossing.zone < 0 ? crossing.in_m : std::max(front, crossing.in_m - kLine_m);
    passage.any = true;
    passage.end_m = std::max(passage.end_m, crossing.out_m);
    crossings.push_back(crossing);
  };
  for (const Stretch& stretch : stretches_[id]) {
    if (stretch.end_m < rear || stretch.end_m < agent.granted_m) continue;
    if (passage.any && stretch.begin_m > passage.end_m + stand) break;
    const auto& sides = zones().Of(stretch.track);
    const auto& stops = map_->plans[stretch.track].stops_m;
    std::size_t stop = 0;
    const auto take_stops = [&](double before_m) {
      for (; stop < stops.size() && stretch.zero_m + stops[stop] <= before_m; ++stop) {
        const double at = stretch.zero_m + stops[stop];
        if (at < front - kStopped_m || at < agent.granted_m || at < stretch.begin_m) continue;
        if (passage.any) continue;  // the line of an earlier one holds
        take({-1, 0, at, at});
        passage.must_stop = agent.stopped_m != at;
      }
    };
    for (const lanes::ZoneSide& part : sides) {
      const lanes::Zone& zone = zones()[part.zone];
      const auto mine = static_cast<std::size_t>(part.side);
      const double in = stretch.zero_m + zone.in_m[mine], out = stretch.zero_m + zone.out_m[mine];
      if (zone.kind == lanes::ZoneKind::kDiverge || out <= rear || out <= agent.granted_m || in < front - 0.5 * kLine_m) continue;
      take_stops(in + kLine_m);
      if (passage.any && in > passage.end_m + stand) break;
      take({part.zone, part.side, in, out});
    }
    if (!passage.any || passage.end_m + stand > stretch.end_m) take_stops(stretch.end_m + kLine_m);
  }
  passage.crossings = std::move(crossings);
  if (!passage.any) return;
  const double to_line = passage.line_m - front;
  const double v = agent.speed_mps;
  passage.due = to_line < v * v / (2.0 * traits_[id].idm.braking_mps2) + kReaction_s * v + kEarly_m;
  const double most = AllowedAt(id, passage.crossings.front().in_m);
  const double way_in = passage.crossings.front().in_m - front, way_out = passage.end_m - rear;
  passage.arrives_s = TravelTime(way_in, v, most);
  passage.clears_s = TravelTime(way_out, v, std::max(most, AllowedAt(id, passage.end_m)));
}

// Its own are the zones that are granted to it and those that it stands in.
void TrafficModel::HoldZones(std::uint32_t id) {
  const Agent& agent = agents_[id];
  const double half = 0.5 * traits_[id].length_m, front = agent.o_m + half, rear = agent.o_m - half;
  const double to = std::max(front, agent.granted_m);
  for (const Stretch& stretch : stretches_[id]) {
    if (stretch.begin_m > to) break;
    if (stretch.end_m < rear) continue;
    for (const lanes::ZoneSide& part : zones().Of(stretch.track)) {
      const lanes::Zone& zone = zones()[part.zone];
      const auto mine = static_cast<std::size_t>(part.side);
      if (zone.kind == lanes::ZoneKind::kDiverge) continue;
      if (stretch.zero_m + zone.in_m[mine] < to && stretch.zero_m + zone.out_m[mine] > rear) holders_[part.zone][mine].push_back(id);
    }
  }
}

// Whether it could stand behind the zones, with all that are before it on its way and not yet beyond them, if who is ahead
// stopped now. Who waits before it on the same way makes it no head.
void TrafficModel::FindRoom(std::uint32_t id) {
  Passage& passage = passages_[id];
  const double front = agents_[id].o_m + 0.5 * traits_[id].length_m;
  passage.head = passage.able = true;
  std::uint32_t at = id;
  double needed = traits_[id].length_m + settings_.idm.standing_gap_m;
  double reach = front;  // front of the one looked at, in the odometer of `id`
  for (int count = 0; count < 12; ++count) {
    const Ahead& ahead = ahead_[at];
    if (!ahead.any) return;
    const double rear = reach + ahead.gap_m;
    const double stops = rear + std::max(0.0, ahead.speed_mps) * ahead.speed_mps / (2.0 * kHardest_mps2);
    if (rear >= passage.end_m || ahead.id < 0) {
      passage.able = stops >= passage.end_m + needed;
      if (!passage.able) passage.waits_for = ahead.id;
      return;
    }
    const auto next = static_cast<std::uint32_t>(ahead.id);
    const double its_line = rear + 0.5 * traits_[next].length_m + passages_[next].line_m - agents_[next].o_m;
    if (passages_[next].any && its_line < passage.line_m + 2.0 * kLine_m) passage.head = false;
    needed += traits_[next].length_m + settings_.idm.standing_gap_m;
    reach = rear + traits_[next].length_m;
    at = next;
  }
}

// Who comes to which zone: the heads of those that wait to be granted it, and vehicles that are no agents.
void TrafficModel::ComeToZones() {
  for (std::uint32_t id = 0; id < agents_.size(); ++id) {
    const Passage& passage = passages_[id];
    if (!agents_[id].on_road || !passage.any || !passage.head || !passage.able || passage.arrives_s > kLaterThan_s) continue;
    if (agents_[id].brake_mps2 > 0.0) continue;
    const double front = agents_[id].o_m + 0.5 * traits_[id].length_m, rear = front - traits_[id].length_m;
    for (const Crossing& crossing : passage.crossings) {
      if (crossing.zone < 0) continue;
      const double most = AllowedAt(id, crossing.in_m);
      comers_[static_cast<std::size_t>(crossing.zone)][static_cast<std::size_t>(crossing.side)].push_back(
          {id, TravelTime(crossing.in_m - front, agents_[id].speed_mps, most),
           TravelTime(crossing.out_m - rear, agents_[id].speed_mps, most)});
    }
  }
  const auto nobody = static_cast<std::uint32_t>(agents_.size());
  for (std::uint32_t track = 0; track < blocks_.size(); ++track) {
    for (const Block& block : blocks_[track]) {
      for (const lanes::ZoneSide& part : zones().Of(track)) {
        const lanes::Zone& zone = zones()[part.zone];
        const auto mine = static_cast<std::size_t>(part.side);
        if (zone.kind == lanes::ZoneKind::kDiverge || std::min(std::fabs(block.span.left_m), std::fabs(block.span.right_m)) > 1.2) continue;
        if (block.span.front_m > zone.in_m[mine] && block.span.rear_m < zone.out_m[mine]) holders_[part.zone][mine].push_back(nobody);
      }
      if (block.span.speed_mps < 0.5 || block.span.left_m < -1.0 || block.span.right_m > 1.0) continue;
      // Where it goes is not known: it comes to all zones within six seconds, on every way.
      struct At { std::uint32_t track; double ahead_m; };
      std::vector<At> open{{track, -block.span.front_m}};
      for (std::size_t i = 0; i < open.size() && i < 64; ++i) {
        const At at = open[i];
        for (const lanes::ZoneSide& part : zones().Of(at.track)) {
          const lanes::Zone& zone = zones()[part.zone];
          const auto mine = static_cast<std::size_t>(part.side);
          const double way = at.ahead_m + zone.in_m[mine], length = block.span.front_m - block.span.rear_m;
          if (zone.kind == lanes::ZoneKind::kDiverge || way < 0.0 || way > 6.0 * block.span.speed_mps) continue;
          comers_[part.zone][mine].push_back(
              {nobody, way / block.span.speed_mps, (at.ahead_m + zone.out_m[mine] + length) / block.span.speed_mps});
        }
        const double end = at.ahead_m + graph()[at.track].length_m();
        if (end > 6.0 * block.span.speed_mps) continue;
        for (const lanes::Link& link : graph()[at.track].next) open.push_back({link.to, end - link.from_d_m});
      }
    }
  }
}

}  // namespace rodeira::traffic
