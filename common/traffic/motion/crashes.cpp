// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/motion/crashes.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/assert.hpp"
#include "common/core/base/constants.hpp"
#include "common/traffic/state/agent.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kSlidingFriction = 0.7;  // of locked wheels on dry asphalt
constexpr double kNoticed_mps = 1e-3;     // some kilonewtons for a millisecond
constexpr double kReach_m = 12.0;         // lanes so near give it its height

// What static friction holds: less than its wheels can take in a step, of momentum and of its moment about the middle.
bool Holds(const Crashed& crashed, const AgentTraits& traits, double dt_s) {
  const double takes_mps = kSlidingFriction * base::kGravity_mps2 * dt_s,
               arm = 0.5 * std::hypot(traits.wheelbase_m, traits.width_m);
  const double gyration2 = (traits.length_m * traits.length_m + traits.width_m * traits.width_m) / 12.0;
  return crashed.v_W.norm() + std::fabs(crashed.yaw_rate_radps) * gyration2 / arm <= takes_mps;
}

}  // namespace

void Crashes::Strike(std::uint32_t id, const Eigen::Vector2d& impulse_Ns, const Eigen::Vector2d& point_W) {
  RODEIRA_ASSERT(id < out_.agents.size());
  Agent& agent = out_.agents[id];
  if (!agent.is_crashed) {
    if (!agent.on_road || impulse_Ns.norm() < kNoticed_mps * in_.traits[id].mass_kg) return;
    const AgentPose pose = in_.body_poses.PoseOf(id);
    const driver::Footprint body = FootprintOf(pose, in_.traits[id]);
    const std::uint32_t trip = agent.trip;
    const double driven = agent.driven_m;
    const std::int32_t flow = agent.flow;
    const std::uint32_t arrival = agent.arrival;
    agent = Agent();
    if (out_.full) out_.full->Clear(id);
    agent.trip = trip;
    agent.flow = flow, agent.arrival = arrival;
    agent.driven_m = driven;
    agent.is_crashed = true;
    agent.crashed_z_m = pose.p_WB_W.z();
    agent.crashed.p_W = {body.x_m, body.y_m};
    agent.crashed.heading_rad = body.heading_rad;
    agent.crashed.v_W = body.speed_mps * Eigen::Vector2d(std::cos(body.heading_rad), std::sin(body.heading_rad));
  }
  agent.crashed.Push(in_.traits[id], impulse_Ns, point_W);
  agent.speed_mps =
      agent.crashed.v_W.dot(Eigen::Vector2d(std::cos(agent.crashed.heading_rad), std::sin(agent.crashed.heading_rad)));
  *std::find_if(out_.poses.begin(), out_.poses.end(), [&](const AgentPose& pose) { return pose.id == id; }) =
      in_.body_poses.PoseOfCrashed(id);
}

void Crashes::StepCrashed(double dt_s) {
  for (std::uint32_t id = 0; id < out_.agents.size(); ++id) {
    Agent& agent = out_.agents[id];
    if (!agent.is_crashed) continue;
    const Eigen::Vector2d before = agent.crashed.v_W;
    if (agent.waited_s > 0.0 && Holds(agent.crashed, in_.traits[id], dt_s))
      agent.crashed.v_W.setZero(), agent.crashed.yaw_rate_radps = 0.0;
    agent.crashed.Slide(in_.traits[id], kSlidingFriction, dt_s);
    agent.waited_s = agent.crashed.at_rest() ? agent.waited_s + dt_s : 0.0;  // at rest
    const Eigen::Vector2d ahead(std::cos(agent.crashed.heading_rad), std::sin(agent.crashed.heading_rad));
    agent.speed_mps = agent.crashed.v_W.dot(ahead);
    agent.acceleration_mps2 = (agent.crashed.v_W - before).dot(ahead) / dt_s;
    agent.crashed_z_m = HeightAt(agent.crashed, agent.crashed_z_m);
  }
}

// Of the nearest lane's surface on its level, which goes on level beside it; beside all lanes as before.
double Crashes::HeightAt(const Crashed& crashed, double near_z_m) const {
  double height = near_z_m, nearest = kReach_m;
  for (const lanes::Graph::Beside& beside : in_.map.graph.TracksAt(crashed.p_W, kReach_m)) {
    const lanes::CurvePoint at = in_.map.graph[beside.track].curve.At(beside.foot.d_m);
    if (std::fabs(at.p_W.z() - near_z_m) > network::Network::kLevel_m || std::fabs(beside.foot.offset_m) >= nearest)
      continue;
    nearest = std::fabs(beside.foot.offset_m);
    height = at.p_W.z() + at.bank * beside.foot.offset_m;
  }
  return height;
}

}  // namespace rodeira::traffic
