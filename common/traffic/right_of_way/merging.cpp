// SPDX-License-Identifier: Apache-2.0
// Who waits within his own zones for who holds them before him, and who follows him instead where their ways come
// together.
#include <algorithm>
#include <cmath>
#include <utility>

#include "common/driving/driver/acc.hpp"
#include "common/driving/driver/pedals.hpp"
#include "common/traffic/right_of_way/queueing.hpp"
#include "common/traffic/right_of_way/travel_time.hpp"
#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kFollowing_mps2 = 1.5;  // who is let in behind somebody brakes no harder for it
constexpr double kYielded_mps2 = 1.0;  // by which others may have to brake, on the average, for who merges before them
constexpr double kLag_s = 1.0;         // … and so much later than that one they come
constexpr double kLeast_mps2 = 1e-3;   // who is left less than this at rest does not drive on; with pedals who is left
                                       // less than his foot lets go by

}  // namespace

// From its front to the rear of who goes before it through a zone in which their ways come together, both by their way
// to its end.
double TrafficModel::MergingGap(std::uint32_t id, double out_m, const Holder& before) const {
  const double to_end = out_m - agents_[id].o_m - 0.5 * traits_[id].length_m;
  return to_end - (before.out_m - agents_[before.id].o_m + 0.5 * traits_[before.id].length_m);
}

// The acceleration with which it follows another agent that has come in, or comes in, before it: by what that one's
// driver wants, since what his car does while he changes gear is over at once.
double TrafficModel::FollowComing(std::uint32_t id, std::uint32_t leader, double gap_m) const {
  const Agent& other = agents_[leader];
  return driver::AccAcceleration(traits_[id].idm, agents_[id].speed_mps, Desired_mps(id), gap_m, other.speed_mps,
                                 other.wish_mps2);
}

// Where two ways merge it may come behind who is nearer to the end of the zone, as behind a leader, if it need not
// brake much for that.
bool TrafficModel::MayFollow(std::uint32_t id, const Crossing& crossing, const Holder& holder) const {
  if (zones()[static_cast<std::uint32_t>(crossing.zone)].kind != lanes::ZoneKind::kMerge) return false;
  const double gap = MergingGap(id, crossing.out_m, holder);
  return gap > 0.0 && FollowComing(id, holder.id, gap) > -kFollowing_mps2;
}

// Where two ways merge, whether who comes, surely behind it, need not brake much for it to stay there until it is out
// of the zone.
bool TrafficModel::IsFarEnough(std::uint32_t id, const Crossing& crossing, const Comer& comer, double comes_s,
                               double clears_s) const {
  if (zones()[static_cast<std::uint32_t>(crossing.zone)].kind != lanes::ZoneKind::kMerge || comer.id >= agents_.size())
    return false;
  const Agent& agent = agents_[id];
  const double to_zone = crossing.in_m - agent.o_m - 0.5 * traits_[id].length_m;
  const double arrives = TravelTime(to_zone, agent.speed_mps, AllowedAt(id, crossing.in_m), traits_[id].start_mps2,
                                    {agent.wish_mps2, settings_.smooth.planned_mps3});
  if (!(comes_s > arrives + kLag_s)) return false;
  const double way = comer.out_m - FrontOf(comer.id), ends = ComesWithin(comer, way);
  const double comes = way * clears_s / std::max(0.1, ends), may_come = way - settings_.idm.standing_gap_m;
  return 2.0 * (comes - may_come) < kYielded_mps2 * clears_s * clears_s;
}

// Those who hold its zones before it, and which: tell(holder, in_m, out_m, whether ways merge there), in its own
// odometer.
template <class Tell>
void TrafficModel::EachBefore(std::uint32_t id, const Tell& tell) const {
  const Agent& agent = agents_[id];
  const double front = FrontOf(id);
  for (const Stretch& stretch : stretches_[id]) {
    if (agent.grants.empty() || stretch.begin_m > agent.granted_m)
      break;  // without any nobody goes before it by his number
    if (!stretch.crosses) continue;
    for (const lanes::ZoneSide& part : zones().ConflictsOf(stretch.track)) {
      const double in = stretch.zero_m + part.in_m, out = stretch.zero_m + part.out_m;
      const bool merges = part.kind == lanes::ZoneKind::kMerge;
      if (in >= agent.granted_m || (merges ? out : in) < front) continue;
      const std::uint64_t number = agent.GrantOf(out).number;
      for (const Holder& holder : book_.HoldersOf(part.zone, static_cast<std::size_t>(1 - part.side))) {
        if (holder.id < agents_.size() && holder.id != id && holder.number < number) tell(holder, in, out, merges);
      }
    }
  }
}

// What those leave it: tell(id, gap_m, leaves_mps2), the acceleration that each leaves it. It stops at the line before
// each zone or, where ways merge, follows who is nearer to the zone's end (so far before it; else no gap, below 0),
// whichever is the less.
template <class Tell>
void TrafficModel::EachLeaves(std::uint32_t id, const Tell& tell) const {
  const double front = FrontOf(id);
  EachBefore(id, [&](const Holder& holder, double in, double out, bool merges) {
    const double gap = merges ? MergingGap(id, out, holder) : -1.0;
    double leaves = in >= front ? StopAt(id, in - kStopDistance_m) : kFree_mps2;
    if (gap > 0.0) {
      const double following = FollowComing(id, holder.id, gap);
      leaves = in >= front ? std::max(leaves, following) : following;
    }
    tell(holder.id, gap, leaves);
  });
}

// How far its front surely comes, `to_m` at most, for those: to the line before a zone that somebody does not surely
// leave or, where ways merge, behind him as far as he comes, whichever is the farther. Whom nothing keeps as far as he
// sees, and who has room behind his zones, leaves them.
double TrafficModel::ReachBehindThose(std::uint32_t id, double to_m, int depth) {
  const double front = FrontOf(id), apart = traits_[id].idm.standing_gap_m + kLoose_m;
  EachBefore(id, [&](const Holder& holder, double in, double out, bool merges) {
    const double line = in >= front ? in - kStopDistance_m - kShort_m : front;
    if (line >= to_m) return;
    const double comes = ReachOf(holder.id, depth + 1);
    if (merges) {
      const double gap = MergingGap(id, out, holder);
      if (in >= front || gap > 0.0) to_m = std::min(to_m, std::max(line, front + gap + comes - apart));
    } else if (comes < holder.out_m - FrontOf(holder.id) + traits_[holder.id].length_m &&
               !(holder.sure && comes > SightOf(agents_[holder.id]) - kShort_m)) {
      to_m = line;
    }
  });
  return to_m;
}

// What those who hold its zones before it leave it.
void TrafficModel::YieldInZones(std::uint32_t id) {
  Agent& agent = agents_[id];
  double& leaves = leaves_[id] = kFree_mps2;
  double nearest = 1e9;
  const std::int64_t eased_for = std::exchange(agent.eased_for, -1);
  EachLeaves(id, [&](std::uint32_t other, double gap_m, double leaves_mps2) {
    if (gap_m > 0.0 && gap_m < nearest) nearest = gap_m, agent.eased_for = other;
    leaves = std::min(leaves, leaves_mps2);
  });
  const Ahead& ahead = ahead_[id];
  if (agent.eased_for >= 0 || eased_for < 0 || ahead.id != eased_for) return;
  const Agent& other = agents_[static_cast<std::size_t>(eased_for)];
  if (!driver::AccIsIdm(traits_[id].idm, agent.speed_mps, Desired_mps(id), ahead.gap_m, ahead.speed_mps,
                        other.wish_mps2))
    agent.eased_for = eased_for;
}

// Who holds its zones before it and keeps it where it stands; of several the one who lets it drive on least, below 0:
// nobody does.
std::int64_t TrafficModel::KeptInZonesBy(std::uint32_t id) const {
  std::int64_t keeps = -1;
  double least = full_ ? driver::Pedals::kGoes_mps2 : kLeast_mps2;
  EachLeaves(id, [&](std::uint32_t other, double, double leaves_mps2) {
    if (leaves_mps2 < least) least = leaves_mps2, keeps = other;
  });
  return keeps;
}

}  // namespace rodeira::traffic
