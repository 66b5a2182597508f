// SPDX-License-Identifier: Apache-2.0
// How an agent accelerates.
#include <algorithm>
#include <cmath>

#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kMinDivisorSpeed_mps = 0.01;
constexpr double kSlow_mps = 0.3;
constexpr double kAbove = 1.0 + 1e-9;  // than any rounding of a square
constexpr double kLeastGap_m = 0.02;
constexpr double kEased_mps2 = 4.0;  // harder braking than this is let go of later
constexpr double kComes_mps = -0.1,
                 kEvades_mps2 =
                     1.0;  // who comes on the own lane; braking from which on it is braked for as hard as can be
constexpr double kSeekingShare = 0.75,
                 kSeeking_mps2 =
                     1.0;  // of the planned speed, while a gap in the lane beside is looked for; its braking

// The deceleration by which it stops within a way, a: v²/(2 a), and a³/(24 j²) more since it ends without a jerk.
double Needed_mps2(double v, double way_m, double jerk_mps3) {
  const double first = std::min(kEased_mps2, v * v / (2.0 * std::max(way_m, kLeastGap_m)));
  return v * v / (2.0 * std::max(way_m - first * first * first / (24.0 * jerk_mps3 * jerk_mps3), kLeastGap_m));
}

}  // namespace

// The plan of the track at a place of its way, and what the beginnings of those beyond leave, braked for as the plans
// are.
driver::SpeedPlan::Allowed TrafficModel::Allowed(std::uint32_t id, double odometer_m) const {
  driver::SpeedPlan::Allowed allowed{1e3, 0.0};
  for (const Stretch& stretch : stretches_[id]) {
    if (stretch.end_m < odometer_m) continue;
    if (stretch.begin_m <= odometer_m) {
      const Below& below = below_[id];
      const double d = odometer_m - stretch.zero_m;
      const bool here = below.track == stretch.track && d >= below.plan.from_m && d < below.plan.to_m;
      allowed = here ? below.plan.nodes.At(d) : map_->plans[stretch.track].plan.At(d);
      continue;
    }
    const double there = stretch.planned_mps;
    const double b = settings_.speed.braking_mps2;
    const double squared = there * there + 2.0 * b * (stretch.begin_m - odometer_m);
    if (squared > kAbove * allowed.speed_mps * allowed.speed_mps) continue;  // its root is no less
    const double now = std::sqrt(squared);
    if (now < allowed.speed_mps) allowed = {now, -b / std::max(now, kMinDivisorSpeed_mps)};
  }
  return allowed;
}

// The acceleration that keeps to the plan, and comes back to it. Where the plan soon asks for less than the driver does
// now, he begins with that half of the time earlier that coming to it smoothly takes: as much below the plan before
// that place as behind it, he is never faster than it.
double TrafficModel::WantedByPlan(std::uint32_t id, const driver::SpeedPlan::Allowed& here) const {
  const Agent& agent = agents_[id];
  const double v = agent.speed_mps, share = traits_[id].speed_factor, twice_jerk = 2.0 * settings_.smooth.planned_mps3;
  const double wanted = here.slope_1ps * share * v + (here.speed_mps * share - v) / settings_.tracking_s;
  double way = 0.0, there = 0.0, slows = -settings_.speed.braking_mps2;
  for (int turn = 0; turn < 2; ++turn) {  // as far as the hardest braking of a plan asks, then as far as this one
    if (agent.wish_mps2 <= slows) return wanted;
    way = v * (agent.wish_mps2 - slows) / twice_jerk;
    const driver::SpeedPlan::Allowed soon = Allowed(id, agent.o_m + way);
    there = soon.speed_mps * share;
    slows = soon.slope_1ps * share * std::min(v, there);
  }
  if (agent.wish_mps2 <= slows) return wanted;
  const double line = std::sqrt(std::max(0.0, there * there - 2.0 * slows * way));  // that of then, as it would be here
  return std::min(wanted, slows + (line - v) / settings_.tracking_s);
}

// The acceleration with which its front comes to rest there without a jerk, braking by a share of what is comfortable
// from where it must.
double TrafficModel::StopAt(std::uint32_t id, double odometer_m, double share) const {
  const double v = agents_[id].speed_mps, b = share * traits_[id].idm.braking_mps2;
  const double gap = odometer_m - agents_[id].o_m - 0.5 * traits_[id].length_m;
  if (gap < 2.0 * kLeastGap_m && v < kSlow_mps) return -1.0;
  const driver::StopProfile there = driver::StopIn(gap, b, settings_.smooth.planned_mps3);
  const double stop = -there.deceleration_mps2 * v / std::max(there.speed_mps, kMinDivisorSpeed_mps);
  return v > there.speed_mps ? std::min(stop, -Needed_mps2(v, gap, settings_.smooth.planned_mps3))
                             : stop + (there.speed_mps - v) / settings_.tracking_s;
}

double TrafficModel::LimitOn(std::uint32_t track, double d_m) const {
  const TrackPlan& plan = map_->plans[track];
  return plan.one_limit ? plan.limit_mps : graph().SpeedLimit_mps(track, d_m);
}

// By the limit where it is: the speed without anybody and any bend.
double TrafficModel::Desired_mps(std::uint32_t id) const {
  const Agent& agent = agents_[id];
  for (const Stretch& stretch : stretches_[id]) {
    if (stretch.end_m < agent.o_m) continue;
    const double limit =
        stretch.limit_mps >= 0.0 ? stretch.limit_mps : LimitOn(stretch.track, agent.o_m - stretch.zero_m);
    return std::min(limit * traits_[id].speed_factor, Cap_mps(id));
  }
  return Cap_mps(id);
}

// The least of the plan, who is ahead, and the line before zones that are not its own.
double TrafficModel::Wanted(std::uint32_t id) const {
  const Agent& agent = agents_[id];
  const AgentTraits& traits = traits_[id];
  const double v = agent.speed_mps;
  const driver::SpeedPlan::Allowed allowed = Allowed(id, agent.o_m);
  const double planned = allowed.speed_mps * traits.speed_factor;
  const double limit = Desired_mps(id);
  const driver::IdmSettings idm = IdmOf(id);
  const double free = idm.acceleration_mps2 > traits.idm.acceleration_mps2
                          ? std::min(idm.acceleration_mps2, (limit - v) / settings_.tracking_s)
                          : driver::IdmFreeAcceleration(idm, v, limit);
  double wanted = std::min(free, WantedByPlan(id, allowed));
  if (planned > Cap_mps(id)) wanted = std::min(wanted, (Cap_mps(id) - v) / settings_.tracking_s);
  if (agent.seeks)
    wanted = std::min(wanted, std::max(-kSeeking_mps2, (kSeekingShare * planned - v) / settings_.tracking_s));
  const Ahead& ahead = ahead_[id];
  if (ahead.any && ahead.gap_m < settings_.sight_m) {
    const bool eased = ahead.id >= 0 && ahead.id == agent.eased_for;
    const double behind = eased ? FollowComing(id, static_cast<std::uint32_t>(ahead.id), ahead.gap_m)
                                : driver::IdmAcceleration(idm, v, limit, ahead.gap_m, ahead.speed_mps);
    const bool against =
        ahead.id < 0 && ahead.speed_mps < kComes_mps && behind < -kEvades_mps2;  // that one may not stop
    wanted = std::min(wanted, against ? -idm.hardest_mps2 : behind);
  }
  if (passages_[id].any && passages_[id].due) wanted = std::min(wanted, StopAt(id, passages_[id].line_m));
  if (bars_[id] < kNoBarrier_m) wanted = std::min(wanted, StopAt(id, bars_[id], kYieldingShare));
  wanted = std::min(wanted, leaves_[id]);
  wanted = std::min({wanted, WantedFacing(id, limit), WantedCourteous(id, limit)});
  wanted = std::clamp(WantedBeside(id, wanted), -idm.hardest_mps2, idm.acceleration_mps2);
  return agent.brake_mps2 > 0.0 ? std::min(wanted, -agent.brake_mps2) : wanted;
}

}  // namespace rodeira::traffic
