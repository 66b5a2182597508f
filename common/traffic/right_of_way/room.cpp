// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/right_of_way/room.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "common/traffic/perception/seen_on.hpp"
#include "common/traffic/right_of_way/queueing.hpp"
#include "common/traffic/right_of_way/travel_time.hpp"
#include "common/traffic/state/vehicle_way.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kStoppingBraking_mps2 = 3.0;  // assumed of a vehicle that may stop
constexpr double kSameLine_m = 1.2;            // lines nearer to one another than this are one
constexpr double kNever_m = 1e18;
constexpr double kMinGapAhead_m = 5.0;  // ahead of a vehicle that stands anywhere else than at a line
constexpr int kDeepest = 256;           // longer columns count as ending there
constexpr double kStands_mps = 0.5, kFollows_s = 1.2,
                 kClose_m =
                     3.0;  // slower, one with no more than so far to close up starts so much later than its leader
constexpr double kPastLight_m = 0.1;   // a front so far beyond a light's line stands past it
constexpr double kRowInside_m = 25.0;  // of vehicles that wait past a light for oncoming traffic, at most
constexpr double kWaits_s = 3.0;       // within its zones for one that leaves it room, at most, as told beforehand

double StopsWithin(double speed_mps) { return std::max(0.0, speed_mps) * speed_mps / (2.0 * kStoppingBraking_mps2); }

}  // namespace

// The vehicles that stand or drive before it on its way as far as `to_m`, and how far its rear surely comes: `tell(id,
// rear_m)`, in its own odometer, -1 for a vehicle that is no agent. One that parts from its way and surely comes clear
// of it does not count.
template <class Tell>
void Room::EachAhead(std::uint32_t id, double to_m, int depth, const Tell& tell) {
  const Agent& agent = in_.agents[id];
  const double half_width = 0.5 * in_.traits[id].width_m + in_.settings.side_margin_m;
  const auto told = [&](const Occupant& other, double zero_m, double clear_m) {
    const double rear = zero_m + other.rear_m;
    if (other.id == id || rear > to_m || zero_m + other.middle_m() <= agent.o_m) return;
    const double comes = other.rear_m + ReachOf(other.id, depth + 1);
    if (comes < clear_m) tell(static_cast<std::int64_t>(other.id), rear, zero_m + comes);
  };
  const auto by_id = [](const Occupant& a, const Occupant& b) { return a.id < b.id; };
  for (const RouteSegment& stretch : in_.stretches[id]) {
    if (stretch.begin_m > to_m) break;
    if (stretch.end_m < agent.o_m) continue;
    auto near = in_.occupants.Beyond(stretch.track, agent.o_m - stretch.zero_m);
    std::size_t count = 0;
    while (count < near.size() && stretch.zero_m + near[count].middle_m() - in_.longest_half_m <= to_m) ++count;
    near = near.first(count);
    if (count <= 2 && std::is_sorted(near.begin(), near.end(), by_id)) {
      for (const Occupant& other : near) told(other, stretch.zero_m, kNever_m);
    } else {
      std::vector<Occupant> sorted(near.begin(), near.end());
      std::sort(sorted.begin(), sorted.end(), by_id);
      for (const Occupant& other : sorted) told(other, stretch.zero_m, kNever_m);
    }
    for (const lanes::DivergeZone& part : in_.neighbours.DivergeZonesOf(stretch.track)) {
      if (stretch.zero_m + part.out_m < agent.o_m) continue;
      for (const Occupant& other : in_.occupants.On(part.other)) {
        if (other.rear_m < part.other_out_m && other.front_m > part.other_in_m)
          told(other, stretch.zero_m, part.other_out_m);
      }
    }
    for (const Block& block : BlocksOn(in_.any_block, in_.blocks, stretch.track)) {
      const double rear = stretch.zero_m + block.span.rear_m;
      if (rear > to_m || stretch.zero_m + block.middle_m <= agent.o_m || block.span.right_m > half_width ||
          block.span.left_m < -half_width)
        continue;
      tell(std::int64_t{-1}, rear, rear + StopsWithin(block.span.speed_mps));
    }
  }
}

double Room::ReachOf(std::uint32_t id, int depth) {
  if (out_.reaches[id] >= 0.0) return out_.reaches[id];
  const Agent& agent = in_.agents[id];
  const ConflictPassage& passage = out_.passages[id];
  if (agent.brake_mps2 > 0.0) return out_.reaches[id] = StopsWithin(agent.speed_mps);
  out_.reaches[id] = 0.0;
  if (depth > kDeepest) return 0.0;
  const double front = agent.o_m + 0.5 * in_.traits[id].length_m;
  double to = front + in_.ways.SightOf(agent);
  if (passage.any) to = std::min(to, passage.line_m - kShort_m);
  to = std::min(to, std::max(front, in_.bars[id] - kShort_m));
  const double apart = in_.traits[id].idm.min_gap_m + kLoose_m;
  EachAhead(id, to + apart, depth, [&](std::int64_t, double, double comes_m) { to = std::min(to, comes_m - apart); });
  to = ReachBehindThose(id, to, depth);
  return out_.reaches[id] = std::max(0.0, to - front);
}

// How far its front surely comes, `to_m` at most, for those: to the line before a zone that a vehicle does not surely
// leave or, where ways merge, behind it as far as it comes, whichever is the farther. One that nothing keeps as far as
// it sees, and that has room behind its zones, leaves them.
double Room::ReachBehindThose(std::uint32_t id, double to_m, int depth) {
  const double front = FrontOf(in_.agents[id], in_.traits[id]), apart = in_.traits[id].idm.min_gap_m + kLoose_m;
  in_.merging.EachBefore(id, [&](const Reservation& holder, double in, double out, bool merges) {
    const double line = in >= front ? in - kStopDistance_m - kShort_m : front;
    if (line >= to_m) return;
    const double comes = ReachOf(holder.id, depth + 1);
    if (merges) {
      const double gap = in_.merging.MergingGap(id, out, holder);
      if (in >= front || gap > 0.0) to_m = std::min(to_m, std::max(line, front + gap + comes - apart));
    } else if (comes < holder.out_m - FrontOf(in_.agents[holder.id], in_.traits[holder.id]) +
                           in_.traits[holder.id].length_m &&
               !(holder.sure && comes > in_.ways.SightOf(in_.agents[holder.id]) - kShort_m)) {
      to_m = line;
    }
  });
  return to_m;
}

bool Room::LeavesInTime(std::uint32_t id, std::uint32_t other, double way_m) const {
  double comes = 0.0, starts = 0.0;
  std::uint32_t at = other;
  for (int depth = 0; depth < kDeepest; ++depth) {
    const Agent& agent = in_.agents[at];
    const Leader& ahead = in_.ahead[at];
    const bool stands = agent.speed_mps < kStands_mps;
    const std::int64_t next = agent.eased_for >= 0 ? agent.eased_for : ahead.id;
    const double gap = next == ahead.id ? ahead.gap_m : 0.0, closes = std::max(0.0, gap - in_.traits[at].idm.min_gap_m);
    if (next < 0 || next == other || (stands ? closes > kClose_m : starts > 0.0)) break;
    if (stands)
      starts += kFollows_s;
    else
      comes += closes;
    if (starts == 0.0 && comes >= way_m) return true;
    at = static_cast<std::uint32_t>(next);
  }
  if (starts == 0.0) return true;
  const double leaves =
      starts + TravelTime(way_m - comes, 0.0, in_.limits.Desired_mps(other), in_.traits[other].start_mps2);
  const double arrives =
      TravelTime(out_.passages[id].end_m - FrontOf(in_.agents[id], in_.traits[id]), in_.agents[id].speed_mps,
                 in_.limits.AllowedAt(id, out_.passages[id].end_m), in_.traits[id].start_mps2);
  return leaves < arrives + kWaits_s;
}

// Whether it can stand behind the zones once all before it have come as far as they surely do. One that waits before it
// at the same line makes it no head.
void Room::FindRoom(std::uint32_t id) {
  ConflictPassage& passage = out_.passages[id];
  passage.head = passage.able = true;
  const double to = passage.room_m;
  double nearest = kNever_m;
  EachAhead(id, to, 0, [&](std::int64_t other, double rear_m, double comes_m) {
    passage.taken = true;
    if (comes_m < to) {
      passage.able = false;
      passage.lacks_m = std::max(passage.lacks_m, to - comes_m);
      if (rear_m < nearest) passage.waits_for = other, nearest = rear_m;
    }
    if (other < 0) return;
    const auto next = static_cast<std::uint32_t>(other);
    if (passage.able && !LeavesInTime(id, next, to - rear_m)) passage.able = false, passage.waits_for = other;
    const double its_line =
        rear_m + 0.5 * in_.traits[next].length_m + out_.passages[next].line_m - in_.agents[next].o_m;
    if (out_.passages[next].any && its_line < passage.line_m + kSameLine_m) passage.head = false;
  });
}

bool Room::RoomToWait(std::uint32_t id) {
  const ConflictPassage& passage = out_.passages[id];
  const double apart = in_.traits[id].idm.min_gap_m + kShort_m;
  double stands = passage.place.in_m - kInsideDistance_m, needs = passage.room_m, leaves = kNever_m;
  EachAhead(id, needs + kRowInside_m, 0, [&](std::int64_t other, double rear_m, double comes_m) {
    stands = std::min(stands, comes_m - apart);
    if (rear_m >= passage.place.in_m)
      leaves = std::min(leaves, comes_m);
    else
      needs += apart + (other >= 0 ? in_.traits[static_cast<std::size_t>(other)].length_m : 2.0 * in_.longest_half_m);
  });
  return stands > passage.place.light_m + kPastLight_m && leaves >= needs;
}

bool Room::RoomAhead(std::uint32_t id) const {
  const ConflictPassage& passage = out_.passages[id];
  const double front = in_.agents[id].o_m + 0.5 * in_.traits[id].length_m;
  const bool at_line = passage.any && passage.line_m < front + kMinGapAhead_m;
  return at_line ? !passage.taken && in_.ahead[id].gap_m > passage.room_m - front
                 : in_.ahead[id].gap_m > kMinGapAhead_m;
}

void Room::TellComing(std::uint32_t id) {
  ConflictPassage& passage = out_.passages[id];
  const double in = passage.crossings.front().in_m, most = out_.passages_ahead.KnowAllowedAt(id, in, 0);
  (void)out_.passages_ahead.KnowAllowedAt(id, passage.end_m, 1);
  passage.arrives_s =
      TravelTime(in - FrontOf(in_.agents[id], in_.traits[id]), in_.agents[id].speed_mps, most,
                 in_.traits[id].start_mps2, {in_.agents[id].desired_mps2, in_.settings.smooth.planned_mps3});
  FindRoom(id);
}

}  // namespace rodeira::traffic
