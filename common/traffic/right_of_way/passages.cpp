// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/right_of_way/passages.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "common/traffic/right_of_way/queueing.hpp"
#include "common/traffic/state/vehicle_way.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kStandingMargin_m = 2.5;  // beyond its length, for a vehicle to stand between two zones
constexpr double kReaction_s = 1.0;
constexpr double kEarly_m = 4.0;
constexpr double kStopped_m = 2.0;         // at most so far before a STOP line
constexpr double kPastSignalLine_m = 0.3;  // a front this far beyond a signal line has passed it
constexpr double kFarther_m =
    20.0;  // than where it would stand behind the zones that it knows it looks for the next ones
constexpr double kAtLine_m = 1.5;  // a full stop counts within this before the line

}  // namespace

// As above, for the place of one agent; the result is kept, since it is queried in each step.
double Passages::KnowAllowedAt(std::uint32_t id, double odometer_m, std::size_t place) {
  for (const RouteSegment& stretch : in_.stretches[id]) {
    if (stretch.end_m < odometer_m && &stretch != &in_.stretches[id].back()) continue;
    const double d = odometer_m - stretch.zero_m;
    PlannedAt& known = out_.known[id][place];
    if (known.track != stretch.track || known.d_m != d)
      known = {stretch.track, d, in_.map.plans[stretch.track].plan.At(d).speed_mps};
    return known.planned_mps * in_.traits[id].speed_factor;
  }
  return 0.0;
}

// What else a passage has is found anew.
bool Passages::KeepPassage(std::uint32_t id) {
  ConflictPassage& passage = out_.passages[id];
  if (passage.key.way != in_.way_numbers[id] || passage.key.granted_m != out_.agents[id].granted_m ||
      FrontOf(out_.agents[id], in_.traits[id]) > passage.key.until_m)
    return false;
  passage.due = passage.head = passage.able = passage.taken = passage.must_stop = passage.lit = passage.red =
      passage.barred = false;
  passage.lacks_m = passage.arrives_s = passage.delay_s = passage.later_s = 0.0;
  passage.waits_for = -1;
  return true;
}

void Passages::FindPassage(std::uint32_t id) {
  if (!KeepPassage(id)) FindCrossings(id);
  const ConflictPassage& passage = out_.passages[id];
  if (!passage.any) return;
  const double to_line = passage.line_m - FrontOf(out_.agents[id], in_.traits[id]), v = out_.agents[id].speed_mps;
  const bool due = out_.agents[id].waits_inside() ||
                   to_line < v * v / (2.0 * in_.traits[id].idm.braking_mps2) + kReaction_s * v + kEarly_m;
  while (due && !out_.ways.SeesTo(id, passage.room_m)) {
    out_.ways.FindRouteSegments(id, passage.room_m - FrontOf(out_.agents[id], in_.traits[id]) + kFarther_m);
    FindCrossings(id);
  }
  out_.passages[id].due = due;
}

void Passages::FindCrossings(std::uint32_t id) {
  const Agent& agent = out_.agents[id];
  const double half = 0.5 * in_.traits[id].length_m, front = agent.o_m + half, rear = agent.o_m - half;
  ConflictPassage& passage = out_.passages[id];
  auto crossings = std::move(passage.crossings);
  crossings.clear();
  passage = ConflictPassage();
  const double stand = in_.traits[id].length_m + kStandingMargin_m;
  passage.key = {in_.way_numbers[id], agent.granted_m, kNoBarrier_m};
  const auto take = [&](const Crossing& crossing) {
    const double before = agent.waits_inside() ? kInsideDistance_m : kStopDistance_m;
    if (!passage.any)
      passage.line_m = crossing.zone < 0 && !passage.lit ? crossing.in_m : std::max(front, crossing.in_m - before);
    passage.any = true;
    passage.end_m = std::max(passage.end_m, crossing.out_m);
    crossings.push_back(crossing);
    passage.key.until_m = std::min(passage.key.until_m, crossing.in_m - kStopDistance_m);
  };
  for (const RouteSegment& stretch : in_.stretches[id]) {
    if (stretch.end_m < rear || stretch.end_m < agent.granted_m || stretch.changes) continue;
    if (passage.any && stretch.begin_m > passage.end_m + stand) break;
    if (!stretch.crosses && !stretch.has_lines) continue;
    if (stretch.has_lines) passage.key.way = 0;  // what its lines say changes
    const auto sides = in_.map.zones.ConflictsOf(stretch.track);
    const std::span<const StopLine> lines =
        stretch.has_lines ? std::span<const StopLine>(in_.map.plans[stretch.track].lines) : std::span<const StopLine>();
    std::size_t next = 0;
    const auto take_lines = [&](double before_m) {
      for (; next < lines.size() && stretch.zero_m + lines[next].d_m <= before_m; ++next) {
        const double at = stretch.zero_m + lines[next].d_m;
        const bool light = lines[next].light >= 0;
        if (at < front - (light ? kPastSignalLine_m : kStopped_m) || at <= agent.granted_m || at < stretch.begin_m)
          continue;  // a STOP line alone is granted once
        if (light) {
          if (passage.any && at > passage.end_m + stand) break;
          passage.lit = true;
          if (!passage.any) passage.place.light_m = at, passage.place.light = lines[next].light;
          passage.red = passage.red || !out_.signals.IsGreen(lines[next].light);
          passage.end_m = std::max(passage.end_m, at);
        }
        if (passage.any) continue;  // the line of an earlier one holds
        take({-1, 0, at, at});
        passage.must_stop = !light && agent.stopped_m != at;
      }
    };
    for (const lanes::ZoneSide& part : sides) {
      const double in = stretch.zero_m + part.in_m, out = stretch.zero_m + part.out_m;
      if (out <= rear || out <= agent.granted_m || in < front - 0.5 * kStopDistance_m) continue;
      if (in < agent.granted_m && agent.GrantOf(in).number > 0) {
        passage.end_m = std::max(passage.end_m, out);
        continue;
      }
      take_lines(in + kStopDistance_m);
      if (passage.any && in > passage.end_m + stand) break;
      WaitingPlace& place = passage.place;
      if (place.light >= 0 && place.in_m < 0.0 && in_.map.waits_side[part.zone] == part.side &&
          in > place.light_m + kPastSignalLine_m + kInsideDistance_m)
        place.in_m = in, place.crossings = crossings.size();
      take({static_cast<std::int32_t>(part.zone), part.side, in, out});
    }
    if (!passage.any || passage.end_m + stand > stretch.end_m) take_lines(stretch.end_m + kStopDistance_m);
  }
  passage.crossings = std::move(crossings);
  if (!passage.any) return;
  passage.room_m = passage.end_m + in_.traits[id].length_m + in_.settings.idm.min_gap_m + kLoose_m;
}

void Passages::ComeToLine(std::uint32_t id, double dt_s) {
  Agent& agent = out_.agents[id];
  const double half = 0.5 * in_.traits[id].length_m;
  if (!agent.grants.empty())
    agent.grants.erase(
        std::remove_if(agent.grants.begin(), agent.grants.end(),
                       [&](const ZoneGrant& grant) { return std::max(grant.to_m, grant.clear_m) <= agent.o_m - half; }),
        agent.grants.end());
  out_.signals.ApplyLights(id);
  FindPassage(id);
  ConflictPassage& passage = out_.passages[id];
  passage.barred = in_.bars[id] < passage.line_m;
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

}  // namespace rodeira::traffic
