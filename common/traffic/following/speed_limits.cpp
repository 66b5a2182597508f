// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/following/speed_limits.hpp"

#include <algorithm>
#include <cmath>

#include "common/traffic/following/speed_limits.hpp"
#include "common/traffic/state/vehicle_way.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kAbove = 1.0 + 1e-9;  // than any rounding of a square

}  // namespace

driver::SpeedPlan::Allowed SpeedLimits::Allowed(std::uint32_t id, double odometer_m) const {
  driver::SpeedPlan::Allowed allowed{1e3, 0.0};
  for (const RouteSegment& stretch : in_.stretches[id]) {
    if (stretch.end_m < odometer_m) continue;
    if (stretch.begin_m <= odometer_m) {
      const CurrentTrackCache& below = in_.below[id];
      const double d = odometer_m - stretch.zero_m;
      const bool here = below.track == stretch.track && d >= below.plan.from_m && d < below.plan.to_m;
      allowed = here ? below.plan.nodes.At(d) : in_.map.plans[stretch.track].plan.At(d);
      continue;
    }
    const double there = stretch.planned_mps;
    const double b = in_.settings.speed.braking_mps2;
    const double squared = there * there + 2.0 * b * (stretch.begin_m - odometer_m);
    if (squared > kAbove * allowed.speed_mps * allowed.speed_mps) continue;  // its root is no less
    const double now = std::sqrt(squared);
    if (now < allowed.speed_mps) allowed = {now, -b / std::max(now, kMinDivisorSpeed_mps)};
  }
  return allowed;
}

double SpeedLimits::LimitOn(std::uint32_t track, double d_m) const {
  const TrackPlan& plan = in_.map.plans[track];
  return plan.one_limit ? plan.limit_mps : in_.map.graph.SpeedLimit_mps(track, d_m);
}

double SpeedLimits::Limit_mps(std::uint32_t id, std::uint32_t track, double d_m) const {
  return std::min(LimitOn(track, d_m) * in_.traits[id].speed_factor, Cap_mps(in_.agents[id], in_.traits[id]));
}

double SpeedLimits::Desired_mps(std::uint32_t id) const {
  const Agent& agent = in_.agents[id];
  for (const RouteSegment& stretch : in_.stretches[id]) {
    if (stretch.end_m < agent.o_m) continue;
    const double limit =
        stretch.limit_mps >= 0.0 ? stretch.limit_mps : LimitOn(stretch.track, agent.o_m - stretch.zero_m);
    return std::min(limit * in_.traits[id].speed_factor, Cap_mps(in_.agents[id], in_.traits[id]));
  }
  return Cap_mps(in_.agents[id], in_.traits[id]);
}

double SpeedLimits::AllowedAt(std::uint32_t id, double odometer_m) const {
  for (const RouteSegment& stretch : in_.stretches[id]) {
    if (stretch.end_m < odometer_m && &stretch != &in_.stretches[id].back()) continue;
    const double d = odometer_m - stretch.zero_m;
    for (const PlannedAt& known : in_.known[id]) {
      if (known.track == stretch.track && known.d_m == d) return known.planned_mps * in_.traits[id].speed_factor;
    }
    return in_.map.plans[stretch.track].plan.At(d).speed_mps * in_.traits[id].speed_factor;
  }
  return 0.0;
}

}  // namespace rodeira::traffic
