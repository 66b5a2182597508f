// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/results/details.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "common/traffic/motion/car_of.hpp"
#include "common/traffic/motion/hands.hpp"
#include "common/traffic/state/vehicle_way.hpp"

namespace rodeira::traffic {
namespace {

constexpr std::uint32_t kBrake = 1, kLeft = 2, kRight = 4;
constexpr double kIndicates_s = 3.0, kIndicates_m = 30.0;  // before the turn

}  // namespace

std::uint32_t DetailReport::LightsOf(const AgentPose& pose) const {
  const Agent& agent = in_.agents[pose.id];
  std::uint32_t lights = pose.braking ? kBrake : 0;
  if (!agent.on_road) return lights;
  int side = agent.change.side != 0 && agent.o_m < agent.change.to_m ? agent.change.side : 0;
  if (agent.overtaking.active()) side = agent.overtaking.back ? -agent.overtaking.side : agent.overtaking.side;
  const double to =
      agent.o_m + 0.5 * in_.traits[pose.id].length_m + std::max(kIndicates_m, kIndicates_s * agent.speed_mps);
  std::uint32_t track = agent.path.front().track;
  Choice choice{agent.links, agent.leg};
  double end = 0.0;
  bool on_ring = false;
  for (std::size_t i = 0; side == 0; ++i) {
    const bool may_leave = on_ring && in_.map.graph[track].next.size() > 1;
    double begin = end;
    if (i < agent.path.size()) {
      track = agent.path[i].track;
      begin = agent.path[i].begin_m;
      if (begin > to) break;
      end = i + 1 < agent.path.size() ? agent.path[i + 1].begin_m
                                      : agent.path[i].zero_m + in_.map.graph[track].length_m();
    } else {
      if (in_.map.graph[track].next.empty() || end > to) break;
      const lanes::Link& on = NextLink(in_.map, in_.settings.seed, pose.id, in_.agents[pose.id], track, choice);
      track = on.to;
      end += in_.map.graph[track].length_m() - on.from_d_m;
    }
    const int turn = in_.map.plans[track].turn;
    const bool ring = turn == kRing;
    if (ring && begin > agent.o_m && (!on_ring || may_leave))
      break;  // it enters the roundabout, or passes an exit, before it leaves it
    on_ring = ring;
    if (end > agent.o_m && !ring) side = turn;
  }
  if (side > 0) lights |= kLeft;
  if (side < 0) lights |= kRight;
  return lights;
}

std::vector<AgentDetail> DetailReport::Details() {
  std::vector<AgentDetail> details;
  details.reserve(in_.poses.size());
  for (const AgentPose& pose : in_.poses) {
    const std::uint32_t id = pose.id;
    const Agent& agent = in_.agents[id];
    AgentDetail detail;
    detail.id = id;
    if (agent.on_road) {
      const double sight_m = out_.ways.SightOf(agent), rear_m = agent.o_m - HalfBase(in_.traits[id]);
      out_.ways.FindRouteSegments(id, sight_m);
      const RouteSegment& last = in_.stretches[id].back();
      const double sees_m = std::min(agent.o_m + 0.5 * in_.traits[id].length_m + sight_m, last.end_m);
      detail.look_ahead_W = in_.map.graph[last.track].curve.At(sees_m - last.zero_m).p_W.head<2>();
      Path path = agent.path;
      const double at = rear_m + SteeredWay_m(2.0 * HalfBase(in_.traits[id]), agent.speed_mps);
      Choice choice{agent.links, agent.leg};
      while (true) {
        const lanes::Track& track = in_.map.graph[path.back().track];
        if (at <= path.back().zero_m + track.length_m() || track.next.empty()) break;
        path.push_back(Onward(in_.map.graph, path,
                              NextLink(in_.map, in_.settings.seed, id, in_.agents[id], path.back().track, choice),
                              agent.speed_mps));
      }
      detail.target_W = FrameAt(in_.map.graph, path, at).p_W.head<2>();
      const Eigen::Vector2d along = FrameAt(in_.map.graph, agent.path, rear_m).ahead_W;
      detail.path_heading_rad = std::atan2(along.y(), along.x());
      detail.target_mps = std::min(in_.limits.Allowed(id, in_.agents[id].o_m).speed_mps * in_.traits[id].speed_factor,
                                   Cap_mps(in_.agents[id], in_.traits[id]));
      if (const MotorsDriver* own = (in_.motors.empty() ? nullptr : &in_.motors[id]);
          own != nullptr && own->lanes > 0 && own->trip == agent.trip) {
        const Eigen::Vector2d current = in_.motors_driving.MotorsPoint(*own, own->checkpoint);
        detail.target_W = in_.motors_driving.MotorsPoint(*own, own->checkpoint + 1);
        detail.path_heading_rad = std::atan2(detail.target_W.y() - current.y(), detail.target_W.x() - current.x());
        detail.look_ahead_W = in_.motors_driving.MotorsLooksAt(id);
        detail.target_mps = own->stops || agent.brake_mps2 > 0.0
                                ? 0.0
                                : TurningSpeed_mps(in_.motors_driving.MotorsTurn_rad(id, detail.look_ahead_W),
                                                   std::min(kMotorsLimit_mps, Cap_mps(in_.agents[id], in_.traits[id])));
      }
      const PlanarCar& car = PlanarCarOfBody(in_.traits[id].body);
      // In the plane what goes with the motion as it is now, which the next step goes on from.
      detail.driving = in_.full
                           ? in_.full->DrivingOf(id)
                           : DriveOn(car, agent.driving, agent.speed_mps, agent.acceleration_mps2, agent.grade, 0.0);
      detail.fuel_mgps = in_.full ? agent.fuel_mgps : FuelFlow_mgps(car, detail.driving);
      detail.fuel_used_mg = agent.fuel_mg;
    } else {  // crashed: its engine stands, its wheels are locked
      detail.target_W = detail.look_ahead_W = pose.p_WB_W.head<2>();
      const Eigen::Vector3d ahead_W = pose.q_WB * Eigen::Vector3d::UnitX();
      detail.path_heading_rad = std::atan2(ahead_W.y(), ahead_W.x());
      detail.driving = {0.0, 1.0, 1.0, 0.0, 0};
    }
    details.push_back(detail);
  }
  return details;
}

}  // namespace rodeira::traffic
