// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/following/car_following.hpp"

#include <algorithm>

#include "common/driving/driver/acc.hpp"
#include "common/driving/driver/idm.hpp"
#include "common/driving/driver/smooth.hpp"
#include "common/traffic/following/speed_limits.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kSlow_mps = 0.3;
constexpr double kMinGap_m = 0.02;
constexpr double kEased_mps2 = 4.0;  // harder braking than this is let go of later

// The deceleration by which it stops within a way, a: v²/(2 a), and a³/(24 j²) more since it ends without a jerk.
double Needed_mps2(double v, double way_m, double jerk_mps3) {
  const double first = std::min(kEased_mps2, v * v / (2.0 * std::max(way_m, kMinGap_m)));
  return v * v / (2.0 * std::max(way_m - first * first * first / (24.0 * jerk_mps3 * jerk_mps3), kMinGap_m));
}

}  // namespace

double CarFollowing::StopAt(std::uint32_t id, double odometer_m, double share) const {
  const double v = in_.agents[id].speed_mps, b = share * in_.traits[id].idm.braking_mps2;
  const double gap = odometer_m - in_.agents[id].o_m - 0.5 * in_.traits[id].length_m;
  if (gap < 2.0 * kMinGap_m && v < kSlow_mps) return -1.0;
  const driver::StopProfile there = driver::StopIn(gap, b, in_.settings.smooth.planned_mps3);
  const double stop = -there.deceleration_mps2 * v / std::max(there.speed_mps, kMinDivisorSpeed_mps);
  return v > there.speed_mps ? std::min(stop, -Needed_mps2(v, gap, in_.settings.smooth.planned_mps3))
                             : stop + (there.speed_mps - v) / in_.settings.tracking_s;
}

double CarFollowing::Following(std::uint32_t id, double limit_mps, bool any, double gap_m, double leader_mps) const {
  const driver::IdmSettings& idm = in_.traits[id].idm;
  const double v = in_.agents[id].speed_mps;
  return any && gap_m < in_.settings.sight_m ? driver::IdmAcceleration(idm, v, limit_mps, gap_m, leader_mps)
                                             : driver::IdmFreeAcceleration(idm, v, limit_mps);
}

double CarFollowing::FollowerDoes(const Follower& behind, bool any, double gap_m, double leader_mps) const {
  if (!behind.any) return 0.0;
  const double d = std::max(0.0, behind.d_m);
  if (behind.id >= 0) {
    const auto id = static_cast<std::uint32_t>(behind.id);
    return Following(id, in_.limits.Limit_mps(id, behind.track, d), any, gap_m, leader_mps);
  }
  const double limit = std::max(behind.speed_mps, in_.limits.LimitOn(behind.track, d));
  return any ? driver::IdmAcceleration(in_.settings.idm, behind.speed_mps, limit, gap_m, leader_mps)
             : driver::IdmFreeAcceleration(in_.settings.idm, behind.speed_mps, limit);
}

double CarFollowing::FollowComing(std::uint32_t id, std::uint32_t leader, double gap_m) const {
  const Agent& other = in_.agents[leader];
  return driver::AccAcceleration(in_.traits[id].idm, in_.agents[id].speed_mps, in_.limits.Desired_mps(id), gap_m,
                                 other.speed_mps, other.desired_mps2);
}

}  // namespace rodeira::traffic
