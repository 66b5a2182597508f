// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/signals/signals.hpp"

#include <algorithm>
#include <cstddef>

#include "common/driving/driver/smooth.hpp"
#include "common/traffic/right_of_way/queueing.hpp"
#include "common/traffic/state/vehicle_way.hpp"

namespace rodeira::traffic {
namespace {

// A car that can stop at the line by braking so hard, and coming to that smoothly, stops at amber. At 50 km/h three
// seconds of amber are as long as v/(2 b) and half of the time in which the braking grows, so that none comes to the
// line at red (Gazis, Herman, Maradudin 1960).
constexpr double kForAmber_mps2 = 2.9;

constexpr double kOthers_mps2 = 2.8;  // of vehicles that are no agents
constexpr double kRests_mps = 0.3;    // a slower vehicle is about to stand
constexpr double kLineTolerance_m = 0.01;

// The way to rest from an acceleration, by a jerk to that braking and from it.
double StopsIn(double v, double acceleration_mps2, double jerk_mps3) {
  const double b = kForAmber_mps2, j = jerk_mps3, grows = std::max(0.0, acceleration_mps2 + b) / j;
  const double then = v + grows * (acceleration_mps2 - 0.5 * j * grows);
  if (then < b * b / (2.0 * j)) return driver::SmoothStop_m(v, acceleration_mps2, j);
  return grows * (v + grows * (0.5 * acceleration_mps2 - j * grows / 6.0)) + then * then / (2.0 * b) +
         b * b * b / (24.0 * j * j);
}

}  // namespace

void Signals::FindColours() {
  const auto controllers = in_.map.network->controllers();
  out_.colours.assign(controllers.size(), network::LightColour::kRed);
  for (std::size_t i = 0; i < controllers.size(); ++i) {
    if (controllers[i].times) out_.colours[i] = ColourAt(static_cast<std::int64_t>(i), in_.time_ns);
  }
}

double Signals::RedAhead(std::uint32_t track, double from_m, double speed_mps) const {
  for (const StopLine& line : in_.map.plans[track].lines) {
    if (line.light >= 0 && !IsGreen(line.light) && speed_mps * speed_mps <= 2.0 * kOthers_mps2 * (line.d_m - from_m))
      return line.d_m;
  }
  return kNoBarrier_m;
}

// Whether all lights on its way between two odometers show green.
bool Signals::AllGreen(std::uint32_t id, double from_m, double to_m) const {
  for (const RouteSegment& stretch : in_.stretches[id]) {
    if (stretch.begin_m > to_m) break;
    for (const StopLine& line : in_.map.plans[stretch.track].lines) {
      const double at = stretch.zero_m + line.d_m;
      if (line.light >= 0 && at >= from_m - kLineTolerance_m && at <= to_m + kLineTolerance_m &&
          at >= stretch.begin_m && !IsGreen(line.light))
        return false;
    }
  }
  return true;
}

void Signals::ApplyLights(std::uint32_t id) {
  Agent& agent = out_.agents[id];
  if (agent.grants.empty()) return;
  const double front = agent.o_m + 0.5 * in_.traits[id].length_m,
               stops = StopsIn(agent.speed_mps, agent.desired_mps2, in_.settings.smooth.planned_mps3);
  for (std::size_t i = 0; i < agent.grants.size(); ++i) {
    const ZoneGrant& grant = agent.grants[i];
    // One that was to wait past the line, and comes to rest before it, stays there.
    const bool rests = grant.light >= 0 && agent.speed_mps < kRests_mps;
    const double gap = grant.light_m - front + (rests ? kStopDistance_m : 0.0);
    if (grant.light_m < 0.0 || gap < 0.0 || stops > gap) continue;
    if (AllGreen(id, grant.light_m, grant.to_m)) continue;
    agent.granted_m = std::min(agent.granted_m, grant.light_m - kLineTolerance_m);
    agent.grants.resize(i);
  }
}

}  // namespace rodeira::traffic
