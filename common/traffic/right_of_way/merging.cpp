// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/right_of_way/merging.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "common/driving/driver/acc.hpp"
#include "common/driving/driver/pedals.hpp"
#include "common/traffic/right_of_way/queueing.hpp"
#include "common/traffic/state/vehicle_way.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kUnhindered_mps2 = 1e3;  // more than any vehicle accelerates by
constexpr double kFollowing_mps2 = 1.5;   // a reservation behind another vehicle costs no harder braking
constexpr double kLeast_mps2 = 1e-3;      // one left less than this at rest does not drive on; with pedals one left

// How far before a zone it stops: nearer where it may wait past a light.
double StopsBefore_m(const Agent& agent) {
  const bool inside =
      std::any_of(agent.grants.begin(), agent.grants.end(), [](const ZoneGrant& grant) { return grant.light >= 0; });
  return inside ? kInsideDistance_m : kStopDistance_m;
}

}  // namespace

double Merging::MergingGap(std::uint32_t id, double out_m, const Reservation& before) const {
  const double to_end = out_m - out_.agents[id].o_m - 0.5 * in_.traits[id].length_m;
  return to_end - (before.out_m - out_.agents[before.id].o_m + 0.5 * in_.traits[before.id].length_m);
}

bool Merging::MayFollow(std::uint32_t id, const Crossing& crossing, const Reservation& holder) const {
  if (in_.map.zones[static_cast<std::uint32_t>(crossing.zone)].kind != lanes::ZoneKind::kMerge) return false;
  const double gap = MergingGap(id, crossing.out_m, holder);
  return gap > 0.0 && in_.following.FollowComing(id, holder.id, gap) > -kFollowing_mps2;
}

// What those leave it: tell(id, gap_m, leaves_mps2), the acceleration that each leaves it. It stops at the line before
// each zone or, where ways merge, follows the one nearer to the zone's end (so far before it; else no gap, below 0),
// whichever is the less.
template <class Tell>
void Merging::EachLeaves(std::uint32_t id, const Tell& tell) const {
  const double front = FrontOf(out_.agents[id], in_.traits[id]), before = StopsBefore_m(out_.agents[id]);
  EachBefore(id, [&](const Reservation& holder, double in, double out, bool merges) {
    const double gap = merges ? MergingGap(id, out, holder) : -1.0;
    double leaves = in >= front ? in_.following.StopAt(id, in - before) : kUnhindered_mps2;
    if (gap > 0.0) {
      const double following = in_.following.FollowComing(id, holder.id, gap);
      leaves = in >= front ? std::max(leaves, following) : following;
    }
    tell(holder.id, gap, leaves);
  });
}

void Merging::YieldInZones(std::uint32_t id) {
  Agent& agent = out_.agents[id];
  double& leaves = out_.leaves[id] = kUnhindered_mps2;
  double nearest = 1e9;
  const std::int64_t eased_for = std::exchange(agent.eased_for, -1);
  EachLeaves(id, [&](std::uint32_t other, double gap_m, double leaves_mps2) {
    if (gap_m > 0.0 && gap_m < nearest) nearest = gap_m, agent.eased_for = other;
    leaves = std::min(leaves, leaves_mps2);
  });
  const Leader& ahead = in_.ahead[id];
  if (agent.eased_for >= 0 || eased_for < 0 || ahead.id != eased_for) return;
  const Agent& other = out_.agents[static_cast<std::size_t>(eased_for)];
  if (!driver::AccIsIdm(in_.traits[id].idm, agent.speed_mps, in_.limits.Desired_mps(id), ahead.gap_m, ahead.speed_mps,
                        other.desired_mps2))
    agent.eased_for = eased_for;
}

std::int64_t Merging::KeptInZonesBy(std::uint32_t id) const {
  std::int64_t keeps = -1;
  double least = in_.full ? driver::Pedals::kGoes_mps2 : kLeast_mps2;
  EachLeaves(id, [&](std::uint32_t other, double, double leaves_mps2) {
    if (leaves_mps2 < least) least = leaves_mps2, keeps = other;
  });
  return keeps;
}

}  // namespace rodeira::traffic
