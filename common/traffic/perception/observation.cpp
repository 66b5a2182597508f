// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/perception/observation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "common/traffic/pedestrians/stopping.hpp"
#include "common/traffic/perception/each_driving.hpp"

namespace rodeira::traffic {

void Observation::SeeOthers(std::span<const driver::Footprint> others) {
  constexpr double kWidest_m = 3.0;
  if (out_.any_block) {
    for (auto& blocks : out_.blocks) blocks.clear();
  }
  out_.any_block = !others.empty();
  for (const driver::Footprint& other : others) {
    const double reach = 0.5 * std::hypot(other.length_m, other.width_m) + kWidest_m;
    for (const lanes::Graph::Beside& beside : in_.map.graph.TracksAt({other.x_m, other.y_m}, reach)) {
      const lanes::CurvePoint at = in_.map.graph[beside.track].curve.At(beside.foot.d_m);
      const Eigen::Vector2d away = Eigen::Vector2d(other.x_m, other.y_m) - at.p_W.head<2>();
      const double d = beside.foot.d_m + (away.dot(at.ahead_W));  // beyond an end too
      const double turn = other.heading_rad - std::atan2(at.ahead_W.y(), at.ahead_W.x());
      const double c = std::fabs(std::cos(turn)), s = std::fabs(std::sin(turn));
      const double along = 0.5 * (c * other.length_m + s * other.width_m),
                   across = 0.5 * (s * other.length_m + c * other.width_m);
      const double offset = beside.foot.offset_m;
      out_.blocks[beside.track].push_back(
          {{d - along, d + along, offset - across, offset + across, other.speed_mps * std::cos(turn)}, d, other.id});
    }
  }
}

// On the tracks below it, and on those beside that it takes up.
void Observation::BeSeen(std::uint32_t id) {
  const Agent& agent = in_.agents[id];
  const double half = 0.5 * in_.traits[id].length_m, front = agent.o_m + half, rear = agent.o_m - half;
  std::int32_t from = -1;
  for (const RouteSegment& stretch : in_.stretches[id]) {
    if (stretch.begin_m >= front) break;
    if (stretch.end_m > rear)
      out_.occupants.Add(stretch.track, {id, from, rear - stretch.zero_m, front - stretch.zero_m});
    from = static_cast<std::int32_t>(stretch.track);
  }
  if (agent.change.side != 0) ShowOnLaneLeft(id);
  if (!agent.overtaking.active()) return;
  out_.any_overtaking = true;
  ShowToOncoming(id);
}

// It is seen on the lane that it is leaving, too.
void Observation::ShowOnLaneLeft(std::uint32_t id) {
  const Agent& agent = in_.agents[id];
  const double half = 0.5 * in_.traits[id].length_m, rear = agent.o_m - half;
  for (const RouteSegment& stretch : in_.stretches[id]) {
    if (stretch.begin_m > agent.o_m) break;
    if (stretch.changes && stretch.end_m > rear) return;  // as long as its rear is on that path it is there anyway
    if (stretch.end_m < agent.o_m) continue;
    const auto old = in_.neighbours.LaneLeft(id, stretch, rear);
    if (!old) return;
    const double middle = in_.map.graph.Across(stretch.track, agent.o_m - stretch.zero_m, *old);
    out_.occupants.Add(*old, {id, -1, middle - half, middle + half});
    return;
  }
}

void Observation::ShowToOncoming(std::uint32_t id) {
  const Agent& agent = in_.agents[id];
  const Overtaking& way = agent.overtaking;
  const double half = 0.5 * in_.traits[id].length_m;
  if (way.passed >= 0 && !way.back && !way.gives_up) out_.is_overtaken[static_cast<std::size_t>(way.passed)] = 1;
  for (const RouteSegment& stretch : in_.stretches[id]) {
    if (stretch.end_m < agent.o_m) continue;
    const std::int64_t opposite = in_.map.opposites[stretch.track];
    if (opposite < 0) return;
    const auto track = static_cast<std::uint32_t>(opposite);
    const double middle = in_.map.graph.Across(stretch.track, agent.o_m - stretch.zero_m, track);
    out_.facing[track].push_back({id, middle - half, middle + half});
    out_.any_facing = true;
    return;
  }
}

// A vehicle is on this track: one on those that part from it must look. Of the others none need read what parts
// from them.
void Observation::Part(std::uint32_t track) {
  for (const lanes::DivergeZone& part : in_.map.zones.DivergeZonesOf(track)) out_.parts[part.other] = 1;
}

void Observation::See(std::span<const driver::Footprint> others) {
  SeeOthers(others);
  for (const std::uint32_t track : out_.occupants.taken()) {
    for (const lanes::DivergeZone& part : in_.map.zones.DivergeZonesOf(track)) out_.parts[part.other] = 0;
  }
  out_.occupants.Clear();
  if (out_.any_facing) {
    for (auto& facing : out_.facing) facing.clear();
  }
  out_.any_facing = out_.any_overtaking = false;
  std::fill(out_.is_overtaken.begin(), out_.is_overtaken.end(), 0);
  EachDriving(in_.pool, in_.agents, [&](std::uint32_t id) {  // and as far as zones are its own, however slowly it
                                                             // drives now, or it looks which overtake
    out_.tracks.LookBelow(id);
    const Agent& agent = in_.agents[id];
    const double own = agent.granted_m - agent.o_m - 0.5 * in_.traits[id].length_m;
    out_.ways.FindRouteSegments(
        id, std::max({out_.ways.SightOf(agent), own, agent.overtaking.active() ? in_.settings.overtaking.sight_m : 0.0,
                      in_.people ? StoppingWay(in_.agents[id], in_.traits[id]) : 0.0}));
    if (in_.pool == nullptr) BeSeen(id);
  });
  for (std::uint32_t id = 0; in_.pool != nullptr && id < in_.agents.size(); ++id) {
    if (in_.agents[id].on_road) BeSeen(id);
  }
  out_.occupants.Sort();
  for (const std::uint32_t track : out_.occupants.taken()) Part(track);
}

void Observation::FindLeaders() {
  EachDriving(in_.pool, in_.agents, [&](std::uint32_t id) { out_.ahead[id] = in_.neighbours.FindLeader(id); });
}

}  // namespace rodeira::traffic
