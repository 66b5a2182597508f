// SPDX-License-Identifier: Apache-2.0
// Whether there is room behind conflict zones, told from how far everybody comes whatever others decide.
#include <algorithm>
#include <cmath>

#include "common/traffic/right_of_way/queueing.hpp"
#include "common/traffic/right_of_way/travel_time.hpp"
#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kStoppingBraking_mps2 = 3.0;  // assumed of a vehicle that may stop
constexpr double kSameLine_m = 1.2;            // lines nearer to one another than this are one
constexpr double kNever_m = 1e18;
constexpr double kMinGapAhead_m = 5.0;  // ahead of a vehicle that stands anywhere else than at a line
constexpr int kDeepest = 256;           // longer columns count as ending there
constexpr double kStands_mps = 0.5, kFollows_s = 1.2,
                 kClose_m =
                     3.0;  // slower, who has no more than so far to close up starts so much later than who is ahead
constexpr double kWaits_s = 3.0;  // within its zones for who leaves it room, at most, as told beforehand

double StopsWithin(double speed_mps) { return std::max(0.0, speed_mps) * speed_mps / (2.0 * kStoppingBraking_mps2); }

}  // namespace

// Whoever stands or drives before it on its way as far as `to_m`, and how far its rear surely comes: `tell(id,
// rear_m)`, in its own odometer, -1 for a vehicle that is no agent. Who parts from its way and surely comes clear of it
// is nobody to it.
template <class Tell>
void TrafficModel::EachAhead(std::uint32_t id, double to_m, int depth, const Tell& tell) {
  const Agent& agent = agents_[id];
  const double half_width = 0.5 * traits_[id].width_m + settings_.side_margin_m;
  const auto told = [&](const Occupant& other, double zero_m, double clear_m) {
    const double rear = zero_m + other.rear_m;
    if (other.id == id || rear > to_m || zero_m + other.middle_m() <= agent.o_m) return;
    const double comes = other.rear_m + ReachOf(other.id, depth + 1);
    if (comes < clear_m) tell(static_cast<std::int64_t>(other.id), rear, zero_m + comes);
  };
  const auto by_id = [](const Occupant& a, const Occupant& b) { return a.id < b.id; };
  for (const Stretch& stretch : stretches_[id]) {
    if (stretch.begin_m > to_m) break;
    if (stretch.end_m < agent.o_m) continue;
    auto near = occupants_.Beyond(stretch.track, agent.o_m - stretch.zero_m);
    std::size_t count = 0;
    while (count < near.size() && stretch.zero_m + near[count].middle_m() - longest_half_m_ <= to_m) ++count;
    near = near.first(count);
    if (count <= 2 && std::is_sorted(near.begin(), near.end(), by_id)) {
      for (const Occupant& other : near) told(other, stretch.zero_m, kNever_m);
    } else {
      std::vector<Occupant> sorted(near.begin(), near.end());
      std::sort(sorted.begin(), sorted.end(), by_id);
      for (const Occupant& other : sorted) told(other, stretch.zero_m, kNever_m);
    }
    for (const lanes::Parting& part : PartingsOf(stretch.track)) {
      if (stretch.zero_m + part.out_m < agent.o_m) continue;
      for (const Occupant& other : occupants_.On(part.other)) {
        if (other.rear_m < part.other_out_m && other.front_m > part.other_in_m)
          told(other, stretch.zero_m, part.other_out_m);
      }
    }
    for (const Block& block : BlocksOn(stretch.track)) {
      const double rear = stretch.zero_m + block.span.rear_m;
      if (rear > to_m || stretch.zero_m + block.middle_m <= agent.o_m || block.span.right_m > half_width ||
          block.span.left_m < -half_width)
        continue;
      tell(std::int64_t{-1}, rear, rear + StopsWithin(block.span.speed_mps));
    }
  }
}

// How far its front comes whatever others decide: as far as it sees, to the line before zones that are not its own (but
// for the hand's breadth before it at which it may come to rest), behind whoever is before it as far as those come, and
// as far as those let it who hold its own zones before it. Who is told to brake, and whoever is no agent, may stop at
// once. In a ring of followers the one that closes it counts as standing.
double TrafficModel::ReachOf(std::uint32_t id, int depth) {
  if (reaches_[id] >= 0.0) return reaches_[id];
  const Agent& agent = agents_[id];
  const Passage& passage = passages_[id];
  if (agent.brake_mps2 > 0.0) return reaches_[id] = StopsWithin(agent.speed_mps);
  reaches_[id] = 0.0;
  if (depth > kDeepest) return 0.0;
  const double front = agent.o_m + 0.5 * traits_[id].length_m;
  double to = front + SightOf(agent);
  if (passage.any) to = std::min(to, passage.line_m - kShort_m);
  to = std::min(to, std::max(front, bars_[id] - kShort_m));
  const double apart = traits_[id].idm.standing_gap_m + kLoose_m;
  EachAhead(id, to + apart, depth, [&](std::int64_t, double, double comes_m) { to = std::min(to, comes_m - apart); });
  to = ReachBehindThose(id, to, depth);
  return reaches_[id] = std::max(0.0, to - front);
}

// Whether somebody has gone so far before this one has long been waiting at the end of its zones. Who stands starts so
// long after all who stand in a row before him; who drives up to such a row comes as far as its end before.
bool TrafficModel::LeavesInTime(std::uint32_t id, std::uint32_t other, double way_m) const {
  double comes = 0.0, starts = 0.0;
  std::uint32_t at = other;
  for (int depth = 0; depth < kDeepest; ++depth) {
    const Agent& agent = agents_[at];
    const Ahead& ahead = ahead_[at];
    const bool stands = agent.speed_mps < kStands_mps;
    const std::int64_t next = agent.eased_for >= 0 ? agent.eased_for : ahead.id;
    const double gap = next == ahead.id ? ahead.gap_m : 0.0,
                 closes = std::max(0.0, gap - traits_[at].idm.standing_gap_m);
    if (next < 0 || next == other || (stands ? closes > kClose_m : starts > 0.0)) break;
    if (stands)
      starts += kFollows_s;
    else
      comes += closes;
    if (starts == 0.0 && comes >= way_m) return true;
    at = static_cast<std::uint32_t>(next);
  }
  if (starts == 0.0) return true;
  const double leaves = starts + TravelTime(way_m - comes, 0.0, Desired_mps(other), traits_[other].start_mps2);
  const double arrives = TravelTime(passages_[id].end_m - FrontOf(id), agents_[id].speed_mps,
                                    AllowedAt(id, passages_[id].end_m), traits_[id].start_mps2);
  return leaves < arrives + kWaits_s;
}

// Whether it can stand behind the zones once all before it have come as far as they surely do. Who waits before it at
// the same line makes it no head.
void TrafficModel::FindRoom(std::uint32_t id) {
  Passage& passage = passages_[id];
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
    const double its_line = rear_m + 0.5 * traits_[next].length_m + passages_[next].line_m - agents_[next].o_m;
    if (passages_[next].any && its_line < passage.line_m + kSameLine_m) passage.head = false;
  });
}

bool TrafficModel::RoomAhead(std::uint32_t id) const {
  const Passage& passage = passages_[id];
  const double front = agents_[id].o_m + 0.5 * traits_[id].length_m;
  const bool at_line = passage.any && passage.line_m < front + kMinGapAhead_m;
  return at_line ? !passage.taken && ahead_[id].gap_m > passage.room_m - front : ahead_[id].gap_m > kMinGapAhead_m;
}

}  // namespace rodeira::traffic
