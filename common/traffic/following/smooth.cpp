// SPDX-License-Identifier: Apache-2.0
// How a vehicle comes from one acceleration to the next.
#include <algorithm>

#include "common/driving/driver/pedals.hpp"
#include "common/driving/driver/smooth.hpp"
#include "common/traffic/following/acceleration.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kHarder =
    2.0;  // than its comfortable braking: a driver brakes so in an emergency, and lets go as quickly
constexpr double kRounding_mps2 = 1e-6;
constexpr double kCreeps_mps = 1.0;

}  // namespace

double Acceleration::Smoothed(std::uint32_t id, double wanted_mps2, double dt_s) {
  const Agent& agent = in_.agents[id];
  const double before = agent.desired_mps2, v = agent.speed_mps, b = in_.traits[id].idm.braking_mps2;
  const driver::SmoothSettings& smooth = in_.settings.smooth;
  out_.hurries[id] = 0;
  if (agent.brake_mps2 > 0.0) return wanted_mps2;
  const double lets_go = driver::EasedStop_mps2(v, smooth.planned_mps3, dt_s);
  const double can_let_go =
      in_.full ? driver::EasedStop_mps2(v + driver::Pedals::kEnds_mps, smooth.planned_mps3, dt_s) : lets_go;
  const bool parts = in_.ahead[id].any && in_.ahead[id].id >= 0 &&
                     in_.ahead[id].speed_mps > v;  // one that has merged in before it, and drives away
  const bool longer = wanted_mps2 < -b && driver::NeedsHaste(wanted_mps2, v, before, smooth.planned_mps3);
  const bool at_line =
      in_.full && v < kCreeps_mps &&
      !(in_.ahead[id].any &&
        (in_.ahead[id].speed_mps < 0.0 || in_.ahead[id].gap_m < driver::SmoothStop_m(v, before, smooth.planned_mps3)));
  const bool hurries = -before > std::min(kHarder * b, can_let_go + smooth.planned_mps3 * dt_s + kRounding_mps2) ||
                       (wanted_mps2 <= -in_.traits[id].idm.max_deceleration_mps2 && !parts && !at_line) || longer;
  out_.hurries[id] = hurries ? 1 : 0;
  const double jerk = hurries ? smooth.emergency_mps3 : smooth.planned_mps3;
  const double hardest = hurries    ? driver::EasedStop_mps2(v, jerk, dt_s)
                         : in_.full ? std::max(lets_go, -before - jerk * dt_s)
                                    : lets_go;
  return std::max(std::clamp(wanted_mps2, before - jerk * dt_s, before + jerk * dt_s), -hardest);
}

}  // namespace rodeira::traffic
