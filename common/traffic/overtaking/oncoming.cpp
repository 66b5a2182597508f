// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/overtaking/oncoming.hpp"

#include <algorithm>
#include <cmath>

#include "common/driving/driver/idm.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kPassedDistance_m = 2.0;   // a vehicle with its rear this far behind the own rear has passed
constexpr double kOvertakers_m = 100.0;     // so far behind no vehicle may drive on the other lane
constexpr double kWrongWaySpeed_mps = 0.5;  // a vehicle that drives faster against the lane's direction overtakes
constexpr double kEvery_m = 50.0;           // limits are looked at so often
constexpr double kTrust_s =
    0.5;  // oncoming traffic brakes for a vehicle that is back less than this before it is there
constexpr double kStops_mps2 = 3.0;

}  // namespace

Oncoming OncomingLane::FindOncoming(std::uint32_t id) const {
  const double half = 0.5 * in_.traits[id].length_m, front = in_.agents[id].o_m + half,
               rear = in_.agents[id].o_m - half;
  const double fastest = std::max(1.0, in_.settings.speed_factor_high);
  Oncoming found{front + in_.settings.overtaking.sight_m, 1.0, false};
  const auto comes = [&](double from_m, double to_m, double speed_mps) {
    if (to_m < rear - kPassedDistance_m) return;
    found.from_m = std::min(found.from_m, from_m);
    found.speed_mps = std::max(found.speed_mps, speed_mps);
  };
  std::int64_t before = -1;  // the track that comes from there
  for (const RouteSegment& stretch : in_.stretches[id]) {
    if (stretch.end_m < rear) continue;
    if (stretch.begin_m > found.from_m) break;
    const std::int64_t opposite = in_.map.opposites[stretch.track];
    const bool goes_on =
        opposite >= 0 && (before < 0 || (in_.map.graph[static_cast<std::uint32_t>(before)].before.size() == 1 &&
                                         in_.map.graph[static_cast<std::uint32_t>(before)].before[0] == opposite));
    if (!goes_on) {
      found.from_m = std::min(found.from_m, stretch.begin_m - 2.0 * in_.longest_half_m);
      break;
    }
    const auto track = static_cast<std::uint32_t>(opposite);
    const auto here = [&](double d_m) { return stretch.zero_m + in_.map.graph.Across(track, d_m, stretch.track); };
    for (double d = 0.0; d <= in_.map.graph[track].length_m(); d += kEvery_m)
      found.speed_mps = std::max(found.speed_mps, fastest * in_.map.graph.SpeedLimit_mps(track, d));
    for (const Occupant& other : in_.occupants.On(track))
      comes(here(other.front_m), here(other.rear_m), in_.agents[other.id].speed_mps);
    for (const OncomingOvertaker& other : in_.facing[track]) {
      if (other.id != id && here(other.rear_m) > rear - kOvertakers_m) found.own_way = true;
    }
    for (const Block& block : in_.blocks[track]) {
      if (block.span.right_m > kOnLaneOffset_m || block.span.left_m < -kOnLaneOffset_m) continue;
      comes(here(block.span.front_m), here(block.span.rear_m), std::fabs(block.span.speed_mps));
      if (block.span.speed_mps < -kWrongWaySpeed_mps && here(block.span.rear_m) > rear - kOvertakers_m)
        found.own_way = true;
    }
    before = opposite;
    if (in_.map.enters[track] || in_.map.graph[track].before.empty()) {
      found.from_m = std::min(found.from_m, stretch.end_m - 2.0 * in_.longest_half_m);
      break;
    }
    if (&stretch == &in_.stretches[id].back())
      found.from_m = std::min(found.from_m, std::max(stretch.end_m, front) - 2.0 * in_.longest_half_m);
  }
  return found;
}

double OncomingLane::WantedForOvertaker(std::uint32_t id, double limit_mps) const {
  const Agent& agent = in_.agents[id];
  const double front = agent.o_m + 0.5 * in_.traits[id].length_m, v = agent.speed_mps;
  double wanted = in_.traits[id].idm.max_deceleration_mps2;
  if (!in_.any_facing) return wanted;
  for (const RouteSegment& stretch : in_.stretches[id]) {
    for (const OncomingOvertaker& other : in_.facing[stretch.track]) {
      const Agent& overtakes = in_.agents[other.id];
      if (other.id == id || stretch.zero_m + other.rear_m < agent.o_m) continue;
      const double gap = stretch.zero_m + other.front_m - front;
      const double to_there = gap - (overtakes.overtaking.to_m - overtakes.o_m - 0.5 * in_.traits[other.id].length_m);
      if (to_there > v * (overtakes.overtaking.back_s + kTrust_s)) continue;
      double room = gap - overtakes.speed_mps * overtakes.speed_mps / (2.0 * kStops_mps2);
      // One that passes a vehicle that is no agent cannot go back if that stands: it is left the way to there.
      if (overtakes.overtaking.passed_body >= 0) room = std::min(room, std::max(to_there, v * v / (2.0 * kStops_mps2)));
      wanted = std::min(wanted, driver::IdmAcceleration(in_.traits[id].idm, v, limit_mps, room, 0.0));
    }
  }
  return wanted;
}

}  // namespace rodeira::traffic
