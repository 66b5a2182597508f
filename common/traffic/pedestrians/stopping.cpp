// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/pedestrians/stopping.hpp"

#include <algorithm>

namespace rodeira::traffic {

double StoppingWay(const Agent& agent, const AgentTraits& traits) {
  const double v = agent.speed_mps;
  return v * v / (2.0 * kYieldingShare * traits.idm.braking_mps2) + 2.0 * kBrakeReaction_s * v +
         2.0 * kCrosswalkStopDistance_m;
}

bool NearCrossing(const std::optional<Pedestrians>& people, std::uint32_t track, double low_m, double high_m) {
  if (!people) return false;
  const auto& here = people->OfTrack(track);
  return std::any_of(here.begin(), here.end(), [&](const Pedestrians::OnTrack& on) {
    const lanes::FootPass& pass = people->crossings()[on.crossing].passes[on.pass];
    return pass.in_m - kCrosswalkStopDistance_m < high_m && pass.out_m > low_m;
  });
}

}  // namespace rodeira::traffic
