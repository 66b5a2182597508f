// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/motion/full_motion.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "common/traffic/motion/hands.hpp"
#include "common/traffic/state/vehicle_way.hpp"

namespace rodeira::traffic {
namespace {

// From one direction to another, positive to the left.
double HeadingChange_rad(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  return std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
}

}  // namespace

void FullMotion::StartFull(std::shared_ptr<ground::Ground> ground) {
  out_.full.emplace(std::move(ground), out_.agents.size());
  for (std::uint32_t id = 0; id < out_.agents.size(); ++id) {
    if (!out_.agents[id].on_road || PlaceFull(id)) continue;
    const std::uint32_t entry = out_.agents[id].entry;
    out_.agents[id] = Agent();
    out_.agents[id].entry = entry;
    out_.waiting.push_back(id);
  }
}

base::Status FullMotion::PlaceFull(std::uint32_t id) {
  Agent& agent = out_.agents[id];
  const Eigen::Vector3d front = in_.tracks.FrameOf(id, agent.o_m + HalfBase(in_.traits[id])).p_W,
                        rear = in_.tracks.FrameOf(id, agent.o_m - HalfBase(in_.traits[id])).p_W;
  const Eigen::Vector3d middle = 0.5 * (front + rear), along = front - rear;
  dynamics::InitialCondition initial;
  initial.x_m = middle.x(), initial.y_m = middle.y(), initial.z_hint_m = middle.z();
  initial.heading_rad = std::atan2(along.y(), along.x());
  initial.speed_mps =
      agent.speed_mps * along.norm() / along.head<2>().norm();  // along the car; an agent's is over the plan
  return out_.full->Place(id, in_.traits[id].body, initial);
}

void FullMotion::DriveFull(std::uint32_t id, double wanted_mps2, double dt_s) {
  Agent& agent = out_.agents[id];
  const double half = 0.5 * in_.traits[id].length_m;
  double rear_m = agent.o_m - HalfBase(in_.traits[id]);
  PathFrame rear = in_.tracks.FrameOf(id, rear_m);
  rear_m += rear.ahead_W.dot(out_.full->RearAxle_W(id) - rear.p_W.head<2>()) / rear.stretch;
  rear = in_.tracks.FrameOf(id, rear_m);
  const double soon_m = std::min(AnsweredWay_m(agent.speed_mps), agent.o_m + half - rear_m);
  const PathFrame soon = in_.tracks.FrameOf(id, rear_m + soon_m);
  const double aside = RearLine_m(in_.traits[id].wheelbase_m, in_.traits[id].length_m,
                                  HeadingChange_rad(in_.tracks.FrameOf(id, agent.o_m - half).ahead_W,
                                                    in_.tracks.FrameOf(id, agent.o_m + half).ahead_W));
  const Eigen::Vector2d left(-rear.ahead_W.y(), rear.ahead_W.x());
  out_.full->Drive(
      id, wanted_mps2,
      {rear.p_W.head<2>() + aside * left, rear.ahead_W, HeadingChange_rad(rear.ahead_W, soon.ahead_W) / soon_m}, dt_s);
  const bool stands = agent.speed_mps <= 0.0 || out_.full->foot(id).holds();  // whatever is wanted below 0
  agent.desired_mps2 = stands ? std::max(0.0, wanted_mps2) : wanted_mps2;
}

void FullMotion::FollowFull(std::uint32_t id, double dt_s) {
  Agent& agent = out_.agents[id];
  const double before = agent.speed_mps;
  agent.speed_mps = std::max(0.0, out_.full->PlanSpeed_mps(id));
  agent.acceleration_mps2 = (agent.speed_mps - before) / dt_s;
  agent.driven_m += 0.5 * (before + agent.speed_mps) * dt_s;
  agent.driving = out_.full->DrivingOf(id);
  const double used = out_.full->FuelUsed_mg(id);
  agent.fuel_mgps = (used - agent.fuel_mg) / dt_s;
  agent.fuel_mg = used;
  const Eigen::Vector2d at = out_.full->cars().p_WB_W(id).head<2>();
  agent.o_m += 0.5 * (before + agent.speed_mps) * dt_s;
  for (int turn = 0; turn < 2; ++turn) {
    const PathFrame frame = in_.tracks.FrameOf(id, agent.o_m);
    agent.o_m += frame.ahead_W.dot(at - frame.p_W.head<2>()) / frame.stretch;
  }
}

}  // namespace rodeira::traffic
