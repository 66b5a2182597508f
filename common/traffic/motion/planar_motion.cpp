// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/motion/planar_motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "common/traffic/motion/car_of.hpp"
#include "common/traffic/state/vehicle_way.hpp"

namespace rodeira::traffic {
namespace {

constexpr std::size_t kBendPrefetch = 6;  // agents ahead with bends that are prefetched
constexpr double kGentle_m = 3e-4;        // what a bend makes of the way of a step, and no more

}  // namespace

// The line of an agent that soon moves in a bend lies in far memory where there are thousands of agents: first the
// track, then what that names.
void PlanarMotion::FetchBend(std::size_t id) const {
  const auto bends = [&](std::size_t of) {
    return of < in_.below.size() && in_.below[of].track < in_.map.graph.tracks().size() && !in_.below[of].straight;
  };
  constexpr std::size_t kLine_bytes = 64;
  if (const std::size_t later = id + 2 * kBendPrefetch; bends(later)) {
    const auto* curve = reinterpret_cast<const char*>(&in_.map.graph[in_.below[later].track].curve);
    for (std::size_t at = 0; at < sizeof(lanes::Curve); at += kLine_bytes) __builtin_prefetch(curve + at);
  }
  if (const std::size_t soon = id + kBendPrefetch; bends(soon)) {
    const CurrentTrackCache& below = in_.below[soon];  // all that may be read of it: another thread may move it now
    in_.map.graph[below.track].curve.Fetch(
        0.5 * (std::max(0.0, below.plan.from_m) + std::min(below.length_m, below.plan.to_m)));
  }
}

// How far the point midway between the axles moves a metre of the odometer: the axles' middles keep to the path.
double PlanarMotion::Advance(std::uint32_t id, double odometer_m) const {
  const double half_base = HalfBase(in_.traits[id]);
  const PathFrame front = in_.tracks.FrameOf(id, odometer_m + half_base),
                  rear = in_.tracks.FrameOf(id, odometer_m - half_base);
  return std::max(0.2, 0.5 * (front.stretch * front.ahead_W + rear.stretch * rear.ahead_W).norm());
}

// The odometer when that point has gone so far; where bends are tight, and beside a lane's middle, found by secants.
double PlanarMotion::Moved(std::uint32_t id, double travel_m) const {
  const Agent& agent = out_.agents[id];
  if (in_.tracks.StraightBelow(id) != nullptr) return agent.o_m + travel_m;
  const double rate = Advance(id, agent.o_m + 0.5 * travel_m);
  double odometer = agent.o_m + travel_m / rate;
  if (std::fabs(rate - 1.0) * travel_m < kGentle_m && agent.change.side == 0 && !agent.overtaking.active())
    return odometer;
  const auto middle = [&](double o) -> Eigen::Vector2d {
    return 0.5 * (in_.tracks.FrameOf(id, o + HalfBase(in_.traits[id])).p_W +
                  in_.tracks.FrameOf(id, o - HalfBase(in_.traits[id])).p_W)
                     .head<2>();
  };
  const Eigen::Vector2d from = middle(agent.o_m);
  for (int turn = 0; turn < 4; ++turn) {
    const double gone = (middle(odometer) - from).norm();
    if (std::fabs(gone - travel_m) < 1e-5 || gone < 1e-9) break;
    odometer = agent.o_m + (odometer - agent.o_m) * std::clamp(travel_m / gone, 0.5, 2.0);
  }
  return odometer;
}

void PlanarMotion::MovePlanar(std::uint32_t id, double wanted_mps2, double dt_s) {
  Agent& agent = out_.agents[id];
  const double before = agent.speed_mps;
  const PlanarCar& car = PlanarCarOfBody(in_.traits[id].body);
  const double at_most = AtMostBeforeChange_mps2(car, agent.driving, before, agent.desired_mps2, agent.grade,
                                                 in_.settings.smooth.planned_mps3);
  const Driven driven = Drive(car, agent.driving, before, std::min(wanted_mps2, at_most), agent.grade, dt_s);
  agent.driving = driven.driving;
  const double acceleration = driven.acceleration_mps2;
  double travel = (before + 0.5 * acceleration * dt_s) * dt_s;
  double after = before + acceleration * dt_s;
  if (after < 0.0) {
    after = 0.0;
    travel = acceleration < 0.0 ? -0.5 * before * before / acceleration : 0.0;
  }
  agent.acceleration_mps2 = agent.desired_mps2 = (after - before) / dt_s;  // it goes on from what the car can
  agent.speed_mps = after;
  agent.driven_m += travel;
  agent.fuel_mgps = driven.fuel_mgps;
  agent.fuel_mg += agent.fuel_mgps * dt_s;
  if (travel > 0.0) agent.o_m = Moved(id, travel);
}

}  // namespace rodeira::traffic
