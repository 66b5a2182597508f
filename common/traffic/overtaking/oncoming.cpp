// SPDX-License-Identifier: Apache-2.0
// The lane of oncoming traffic: who comes there, and what who comes does about somebody who overtakes.
#include <algorithm>
#include <cmath>

#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kPassedDistance_m = 2.0;   // a vehicle whose rear is this far behind the own rear has passed
constexpr double kOvertakers_m = 100.0;     // so far behind nobody may drive on the other lane
constexpr double kWrongWaySpeed_mps = 0.5;  // a vehicle that drives faster against the lane's direction overtakes
constexpr double kEvery_m = 50.0;           // limits are looked at so often
constexpr double kTrust_s = 0.5;  // who comes brakes for somebody who is back less than this before it is there
constexpr double kStops_mps2 = 3.0;

}  // namespace

// It is seen on the lane of those who come, and who is passed keeps his speed.
void TrafficModel::FaceOncoming(std::uint32_t id) {
  const Agent& agent = agents_[id];
  const Overtaking& way = agent.overtaking;
  const double half = 0.5 * traits_[id].length_m;
  if (way.passed >= 0 && !way.back && !way.gives_up) is_overtaken_[static_cast<std::size_t>(way.passed)] = 1;
  for (const Stretch& stretch : stretches_[id]) {
    if (stretch.end_m < agent.o_m) continue;
    const std::int64_t opposite = map_->opposites[stretch.track];
    if (opposite < 0) return;
    const auto track = static_cast<std::uint32_t>(opposite);
    const double middle = graph().Across(stretch.track, agent.o_m - stretch.zero_m, track);
    facing_[track].push_back({id, middle - half, middle + half});
    any_facing_ = true;
    return;
  }
}

// Along its way, as far as it sees: who comes, or could come from where it sees no further, or where vehicles begin
// their way.
Oncoming TrafficModel::FindOncoming(std::uint32_t id) const {
  const double half = 0.5 * traits_[id].length_m, front = agents_[id].o_m + half, rear = agents_[id].o_m - half;
  const double fastest = std::max(1.0, settings_.speed_factor_high);
  Oncoming found{front + settings_.overtaking.sight_m, 1.0, false};
  const auto comes = [&](double from_m, double to_m, double speed_mps) {
    if (to_m < rear - kPassedDistance_m) return;
    found.from_m = std::min(found.from_m, from_m);
    found.speed_mps = std::max(found.speed_mps, speed_mps);
  };
  std::int64_t before = -1;  // the track that comes from there
  for (const Stretch& stretch : stretches_[id]) {
    if (stretch.end_m < rear) continue;
    if (stretch.begin_m > found.from_m) break;
    const std::int64_t opposite = map_->opposites[stretch.track];
    const bool goes_on =
        opposite >= 0 && (before < 0 || (graph()[static_cast<std::uint32_t>(before)].before.size() == 1 &&
                                         graph()[static_cast<std::uint32_t>(before)].before[0] == opposite));
    if (!goes_on) {
      found.from_m = std::min(found.from_m, stretch.begin_m - 2.0 * longest_half_m_);
      break;
    }
    const auto track = static_cast<std::uint32_t>(opposite);
    const auto here = [&](double d_m) { return stretch.zero_m + graph().Across(track, d_m, stretch.track); };
    for (double d = 0.0; d <= graph()[track].length_m(); d += kEvery_m)
      found.speed_mps = std::max(found.speed_mps, fastest * graph().SpeedLimit_mps(track, d));
    for (const Occupant& other : occupants_.On(track))
      comes(here(other.front_m), here(other.rear_m), agents_[other.id].speed_mps);
    for (const Facing& other : facing_[track]) {
      if (other.id != id && here(other.rear_m) > rear - kOvertakers_m) found.own_way = true;
    }
    for (const Block& block : blocks_[track]) {
      if (block.span.right_m > kOnLaneOffset_m || block.span.left_m < -kOnLaneOffset_m) continue;
      comes(here(block.span.front_m), here(block.span.rear_m), std::fabs(block.span.speed_mps));
      if (block.span.speed_mps < -kWrongWaySpeed_mps && here(block.span.rear_m) > rear - kOvertakers_m)
        found.own_way = true;
    }
    before = opposite;
    if (map_->enters[track] || graph()[track].before.empty()) {
      found.from_m = std::min(found.from_m, stretch.end_m - 2.0 * longest_half_m_);
      break;
    }
    if (&stretch == &stretches_[id].back())
      found.from_m = std::min(found.from_m, std::max(stretch.end_m, front) - 2.0 * longest_half_m_);
  }
  return found;
}

// Who comes towards somebody who overtakes goes on as long as that one will be back in time by what it does; else it
// stops where both can stop.
double TrafficModel::WantedFacing(std::uint32_t id, double limit_mps) const {
  const Agent& agent = agents_[id];
  const double front = agent.o_m + 0.5 * traits_[id].length_m, v = agent.speed_mps;
  double wanted = traits_[id].idm.hardest_mps2;
  if (!any_facing_) return wanted;
  for (const Stretch& stretch : stretches_[id]) {
    for (const Facing& other : facing_[stretch.track]) {
      const Agent& overtakes = agents_[other.id];
      if (other.id == id || stretch.zero_m + other.rear_m < agent.o_m) continue;
      const double gap = stretch.zero_m + other.front_m - front;
      const double to_there = gap - (overtakes.overtaking.to_m - overtakes.o_m - 0.5 * traits_[other.id].length_m);
      if (to_there > v * (overtakes.overtaking.back_s + kTrust_s)) continue;
      const double stops = overtakes.speed_mps * overtakes.speed_mps / (2.0 * kStops_mps2);
      wanted = std::min(wanted, driver::IdmAcceleration(traits_[id].idm, v, limit_mps, gap - stops, 0.0));
    }
  }
  return wanted;
}

}  // namespace rodeira::traffic
