// SPDX-License-Identifier: Apache-2.0
// Vehicles that are no agents, standing or slow on the way.
#include <algorithm>
#include <optional>

#include "common/traffic/lane_change/lane_change.hpp"
#include "common/traffic/lane_change/lane_ways.hpp"
#include "common/traffic/perception/passing_by.hpp"
#include "common/traffic/perception/seen_on.hpp"
#include "common/traffic/state/vehicle_way.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kShutIn_m = 6.5;           // with less room no slow change leads round
constexpr double kMeetsAt_mps = 3.0;        // it drives no slower when it meets what comes
constexpr double kGoesRoundFrom_m = 150.0;  // a vehicle so near behind a standing one goes round it

}  // namespace

// Bodies on its lane that are slower, or come towards it: from its front to where each one is when the vehicle gets
// there, or where it could stop.
template <typename Visit>
void LaneWays::EachBody(std::uint32_t id, const RouteSegments& way, double to_m, double below_mps,
                        const Visit& visit) const {
  if (!in_.any_block) return;
  const double front = FrontOf(in_.agents[id], in_.traits[id]), half = 0.5 * in_.traits[id].width_m + kPassingBy_m;
  for (const RouteSegment& stretch : way) {
    if (stretch.begin_m > front + to_m) break;
    if (stretch.changes || stretch.end_m < front) continue;
    for (const Block& block : in_.blocks[stretch.track]) {
      const driver::LaneSpan& span = block.span;
      const double gap = stretch.zero_m + span.rear_m - front;
      if (span.speed_mps > below_mps || stretch.zero_m + block.middle_m < in_.agents[id].o_m || gap > to_m ||
          span.right_m > half || span.left_m < -half)
        continue;
      const double stops = span.speed_mps > kStandingLeader_mps ? StopsAfter_m(span.speed_mps) : 0.0;
      Leader stands =
          LeaderOf(block, MeetsAfter_m(gap, std::max(kMeetsAt_mps, in_.agents[id].speed_mps), span.speed_mps) + stops);
      stands.speed_mps = 0.0;
      visit(stands);
    }
  }
}

std::optional<double> LaneWays::GoesRound_m(std::uint32_t id) const {
  if (!in_.any_block || !in_.settings.changes_lanes) return std::nullopt;
  const Piece& last = in_.agents[id].path.back();
  const lanes::Track& track = in_.map.graph[last.track];
  const double front = FrontOf(in_.agents[id], in_.traits[id]), from = front - last.zero_m,
               to = from + kMinTightChangeLength_m;
  const auto crosses = [&](bool beside, lanes::Side side) {
    return beside && in_.map.marks.MayCross(last.track, side, from, to);
  };
  if (track.junction >= 0 || from < 0.0 || to > track.length_m() ||
      !(crosses(track.left.has_value(), lanes::Side::kLeft) || crosses(track.right.has_value(), lanes::Side::kRight)))
    return std::nullopt;
  const double blocked = Blocked_m(id);
  if (blocked >= kNoBarrier_m) return std::nullopt;
  double nearest = front + blocked;
  const Leader& ahead = in_.ahead[id];
  if (ahead.any && ahead.id >= 0 && ahead.speed_mps < kStandingLeader_mps)
    nearest = std::min(nearest, front + ahead.gap_m);
  return nearest;
}

bool LaneWays::IsShutIn(std::uint32_t id) const {
  const auto stands = GoesRound_m(id);
  return stands && *stands - FrontOf(in_.agents[id], in_.traits[id]) < kShutIn_m;
}

double LaneWays::Blocked_m(std::uint32_t id) const {
  const auto body = BlockedBy(id);
  return body ? body->gap_m : kNoBarrier_m;
}

std::optional<Leader> LaneWays::BlockedBy(std::uint32_t id, double below_mps) const {
  std::optional<Leader> nearest;
  EachBody(id, in_.stretches[id], kGoesRoundFrom_m, below_mps, [&](const Leader& body) {
    if (!nearest || body.gap_m < nearest->gap_m) nearest = body;
  });
  return nearest;
}

bool LaneWays::IsKept(std::uint32_t id, const RouteSegments& left, double to_m) const {
  bool is_kept = false;
  EachBody(id, left, to_m, kStandingLeader_mps, [&](const Leader& body) {
    is_kept = is_kept || !PassesBeside(in_.map.graph, in_.agents[id], in_.traits[id], body);
  });
  return is_kept;
}

}  // namespace rodeira::traffic
