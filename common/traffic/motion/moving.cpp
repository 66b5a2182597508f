// SPDX-License-Identifier: Apache-2.0
// How agents move: as planar cars along their paths, or with the physics of the driver's car.
#include <algorithm>
#include <cmath>

#include "common/traffic/motion/car_of.hpp"
#include "common/traffic/motion/hands.hpp"
#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {
namespace {

// From one direction to another, positive to the left.
double HeadingChange_rad(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  return std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
}

}  // namespace

// Who cannot stand where it was to begin waits to enter.
void TrafficModel::StartFull(std::shared_ptr<ground::Ground> ground) {
  full_.emplace(std::move(ground), agents_.size());
  for (std::uint32_t id = 0; id < agents_.size(); ++id) {
    if (!agents_[id].on_road || PlaceFull(id)) continue;
    const std::uint32_t entry = agents_[id].entry;
    agents_[id] = Agent();
    agents_[id].entry = entry;
    waiting_.push_back(id);
  }
}

// With its axles' middles over the path, rolling along it.
base::Status TrafficModel::PlaceFull(std::uint32_t id) {
  Agent& agent = agents_[id];
  const Eigen::Vector3d front = FrameOf(id, agent.o_m + HalfBase(id)).p_W,
                        rear = FrameOf(id, agent.o_m - HalfBase(id)).p_W;
  const Eigen::Vector3d middle = 0.5 * (front + rear), along = front - rear;
  dynamics::InitialCondition initial;
  initial.x_m = middle.x(), initial.y_m = middle.y(), initial.z_hint_m = middle.z();
  initial.heading_rad = std::atan2(along.y(), along.x());
  initial.speed_mps =
      agent.speed_mps * along.norm() / along.head<2>().norm();  // along the car; an agent's is over the plan
  return full_->Place(id, traits_[id].body, initial);
}

// The pedals for the acceleration, and what they give, held over the step; a car that comes to rest stays at rest.
void TrafficModel::MovePlanar(std::uint32_t id, double wanted_mps2, double dt_s) {
  Agent& agent = agents_[id];
  const double before = agent.speed_mps;
  const PlanarCar& car = PlanarCarOfBody(traits_[id].body);
  const double at_most =
      AtMostBeforeChange_mps2(car, agent.driving, before, agent.wish_mps2, agent.grade, settings_.smooth.planned_mps3);
  const Driven driven = Drive(car, agent.driving, before, std::min(wanted_mps2, at_most), agent.grade, dt_s);
  agent.driving = driven.driving;
  const double acceleration = driven.acceleration_mps2;
  double travel = (before + 0.5 * acceleration * dt_s) * dt_s;
  double after = before + acceleration * dt_s;
  if (after < 0.0) {
    after = 0.0;
    travel = acceleration < 0.0 ? -0.5 * before * before / acceleration : 0.0;
  }
  agent.acceleration_mps2 = agent.wish_mps2 = (after - before) / dt_s;  // he goes on from what the car can
  agent.speed_mps = after;
  agent.driven_m += travel;
  agent.fuel_mgps = driven.fuel_mgps;
  agent.fuel_mg += agent.fuel_mgps * dt_s;
  if (travel > 0.0) agent.o_m = Moved(id, travel);
}

void TrafficModel::DriveFull(std::uint32_t id, double wanted_mps2, double dt_s) {
  Agent& agent = agents_[id];
  const double half = 0.5 * traits_[id].length_m;
  double rear_m = agent.o_m - HalfBase(id);
  PathFrame rear = FrameOf(id, rear_m);
  rear_m += rear.ahead_W.dot(full_->RearAxle_W(id) - rear.p_W.head<2>()) / rear.stretch;
  rear = FrameOf(id, rear_m);
  const double soon_m = std::min(AnsweredWay_m(agent.speed_mps), agent.o_m + half - rear_m);
  const PathFrame soon = FrameOf(id, rear_m + soon_m);
  const double aside =
      RearLine_m(traits_[id].wheelbase_m, traits_[id].length_m,
                 HeadingChange_rad(FrameOf(id, agent.o_m - half).ahead_W, FrameOf(id, agent.o_m + half).ahead_W));
  const Eigen::Vector2d left(-rear.ahead_W.y(), rear.ahead_W.x());
  full_->Drive(
      id, wanted_mps2,
      {rear.p_W.head<2>() + aside * left, rear.ahead_W, HeadingChange_rad(rear.ahead_W, soon.ahead_W) / soon_m}, dt_s);
  const bool stands = agent.speed_mps <= 0.0 || full_->foot(id).holds();  // whatever is wanted below 0
  agent.wish_mps2 = stands ? std::max(0.0, wanted_mps2) : wanted_mps2;
}

// Where its path has brought it, after the physics' step.
void TrafficModel::FollowFull(std::uint32_t id, double dt_s) {
  Agent& agent = agents_[id];
  const double before = agent.speed_mps;
  agent.speed_mps = std::max(0.0, full_->PlanSpeed_mps(id));
  agent.acceleration_mps2 = (agent.speed_mps - before) / dt_s;
  agent.driven_m += 0.5 * (before + agent.speed_mps) * dt_s;
  agent.driving = full_->DrivingOf(id);
  const double used = full_->FuelUsed_mg(id);
  agent.fuel_mgps = (used - agent.fuel_mg) / dt_s;
  agent.fuel_mg = used;
  const Eigen::Vector2d at = full_->cars().p_WB_W(id).head<2>();
  agent.o_m += 0.5 * (before + agent.speed_mps) * dt_s;
  for (int turn = 0; turn < 2; ++turn) {
    const PathFrame frame = FrameOf(id, agent.o_m);
    agent.o_m += frame.ahead_W.dot(at - frame.p_W.head<2>()) / frame.stretch;
  }
}

}  // namespace rodeira::traffic
