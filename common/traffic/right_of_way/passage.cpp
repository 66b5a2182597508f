// SPDX-License-Identifier: Apache-2.0
// The next conflict zones on an agent's way.
#include <algorithm>
#include <cmath>
#include <span>

#include "common/traffic/right_of_way/queueing.hpp"
#include "common/traffic/right_of_way/travel_time.hpp"
#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kStandingMargin_m = 2.5;  // beyond its length, for a vehicle to stand between two zones
constexpr double kReaction_s = 1.0;
constexpr double kEarly_m = 4.0;
constexpr double kStopped_m = 2.0;         // at most so far before a STOP line
constexpr double kPastSignalLine_m = 0.3;  // a front this far beyond a signal line has passed it
constexpr double kFarther_m =
    20.0;  // than where it would stand behind the zones that it knows it looks for the next ones

}  // namespace

double TrafficModel::AllowedAt(std::uint32_t id, double odometer_m) const {
  for (const Stretch& stretch : stretches_[id]) {
    if (stretch.end_m < odometer_m && &stretch != &stretches_[id].back()) continue;
    const double d = odometer_m - stretch.zero_m;
    for (const PlannedAt& known : known_[id]) {
      if (known.track == stretch.track && known.d_m == d) return known.planned_mps * traits_[id].speed_factor;
    }
    return map_->plans[stretch.track].plan.At(d).speed_mps * traits_[id].speed_factor;
  }
  return 0.0;
}

// The same of the place that an agent asks of again and again, and then knows.
double TrafficModel::KnowAllowedAt(std::uint32_t id, double odometer_m, std::size_t place) {
  for (const Stretch& stretch : stretches_[id]) {
    if (stretch.end_m < odometer_m && &stretch != &stretches_[id].back()) continue;
    const double d = odometer_m - stretch.zero_m;
    PlannedAt& known = known_[id][place];
    if (known.track != stretch.track || known.d_m != d)
      known = {stretch.track, d, map_->plans[stretch.track].plan.At(d).speed_mps};
    return known.planned_mps * traits_[id].speed_factor;
  }
  return 0.0;
}

// What else a passage has is found anew.
bool TrafficModel::KeepPassage(std::uint32_t id) {
  Passage& passage = passages_[id];
  if (passage.key.way != ways_[id] || passage.key.granted_m != agents_[id].granted_m ||
      FrontOf(id) > passage.key.until_m)
    return false;
  passage.due = passage.head = passage.able = passage.taken = passage.must_stop = passage.lit = passage.red =
      passage.barred = false;
  passage.lacks_m = passage.arrives_s = passage.delay_s = passage.later_s = 0.0;
  passage.waits_for = -1;
  return true;
}

// Who must know now looks on to where it would stand, however slowly it drives: where zones are longer than it sees,
// the next ones may begin where those end, and who has taken the first ones alone would stand in them.
void TrafficModel::FindPassage(std::uint32_t id) {
  if (!KeepPassage(id)) FindCrossings(id);
  const Passage& passage = passages_[id];
  if (!passage.any) return;
  const double to_line = passage.line_m - FrontOf(id), v = agents_[id].speed_mps;
  const bool due = to_line < v * v / (2.0 * traits_[id].idm.braking_mps2) + kReaction_s * v + kEarly_m;
  while (due && !SeesTo(id, passage.room_m)) {
    FindStretches(id, passage.room_m - FrontOf(id) + kFarther_m);
    FindCrossings(id);
  }
  passages_[id].due = due;
}

void TrafficModel::FindCrossings(std::uint32_t id) {
  const Agent& agent = agents_[id];
  const double half = 0.5 * traits_[id].length_m, front = agent.o_m + half, rear = agent.o_m - half;
  Passage& passage = passages_[id];
  auto crossings = std::move(passage.crossings);
  crossings.clear();
  passage = Passage();
  const double stand = traits_[id].length_m + kStandingMargin_m;
  passage.key = {ways_[id], agent.granted_m, kNoBarrier_m};
  const auto take = [&](const Crossing& crossing) {
    if (!passage.any)
      passage.line_m =
          crossing.zone < 0 && !passage.lit ? crossing.in_m : std::max(front, crossing.in_m - kStopDistance_m);
    passage.any = true;
    passage.end_m = std::max(passage.end_m, crossing.out_m);
    crossings.push_back(crossing);
    passage.key.until_m = std::min(passage.key.until_m, crossing.in_m - kStopDistance_m);
  };
  for (const Stretch& stretch : stretches_[id]) {
    if (stretch.end_m < rear || stretch.end_m < agent.granted_m || stretch.changes) continue;
    if (passage.any && stretch.begin_m > passage.end_m + stand) break;
    if (!stretch.crosses && !stretch.has_lines) continue;
    if (stretch.has_lines) passage.key.way = 0;  // what its lines say changes
    const auto sides = zones().ConflictsOf(stretch.track);
    const std::span<const StopLine> lines =
        stretch.has_lines ? std::span<const StopLine>(map_->plans[stretch.track].lines) : std::span<const StopLine>();
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
          passage.red = passage.red || !IsGreen(lines[next].light);
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
      take_lines(in + kStopDistance_m);
      if (passage.any && in > passage.end_m + stand) break;
      take({static_cast<std::int32_t>(part.zone), part.side, in, out});
    }
    if (!passage.any || passage.end_m + stand > stretch.end_m) take_lines(stretch.end_m + kStopDistance_m);
  }
  passage.crossings = std::move(crossings);
  if (!passage.any) return;
  passage.room_m = passage.end_m + traits_[id].length_m + settings_.idm.standing_gap_m + kLoose_m;
}

// What others, and it, must know of who may come to its zones soon: when, and whether there is room behind them.
void TrafficModel::TellComing(std::uint32_t id) {
  Passage& passage = passages_[id];
  const double in = passage.crossings.front().in_m, most = KnowAllowedAt(id, in, 0);
  (void)KnowAllowedAt(id, passage.end_m, 1);
  passage.arrives_s = TravelTime(in - FrontOf(id), agents_[id].speed_mps, most, traits_[id].start_mps2,
                                 {agents_[id].wish_mps2, settings_.smooth.planned_mps3});
  FindRoom(id);
}

}  // namespace rodeira::traffic
