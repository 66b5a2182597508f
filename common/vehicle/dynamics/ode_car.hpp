// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <memory>

#include "common/vehicle/dynamics/ode_settings.hpp"
#include "common/vehicle/dynamics/rigid_body.hpp"
#include "common/vehicle/dynamics/vehicle_state.hpp"

namespace rodeira::dynamics {

// The car in the Open Dynamics Engine: a chassis with a box around it, and four wheels on hinge-2 joints; their springs
// and dampers are the suspension's. The joints turn the steered wheels to their angles and every wheel at the speed
// that the driveline found. Between two calls of Give everything follows from what was given and what was pushed:
// nothing is remembered that a snapshot of the five bodies would miss (solver: dWorldStep, exact, without random
// numbers and without a warm start).
class OdeCar {
 public:
  static constexpr std::size_t kChassis = kWheels;  // after the wheels
  using Bodies = std::array<RigidBody, kWheels + 1>;

  explicit OdeCar(const OdeSettings& settings);
  ~OdeCar();
  OdeCar(OdeCar&&) noexcept;

  // Bodies at their centres of gravity; a wheel's y axis is its axle. Numbers of too large a size are cut.
  void Give(const Bodies& bodies);
  const Bodies& bodies() const { return bodies_; }

  // For the next step: a force at a point, or a torque, on one body.
  void Push(std::size_t body, const Eigen::Vector3d& force_W, const Eigen::Vector3d& at_W);
  // The torque is in W; several add up.
  void Twist(std::size_t body, const Eigen::Vector3d& torque_W);
  // A force along the strut: on the chassis upward, on the wheel downward, at the wheel's centre. The joint's spring
  // bears nothing where the car rests, so this is its preload, and what else there is of bars and stops.
  void Strut(std::size_t wheel, double force_N);
  // Steer angle (positive left) and speed about the axle (positive rolling forward) that the joint keeps in the next
  // step.
  void TurnWheel(std::size_t wheel, double steer_rad, double spin_radps);
  // The ground that the body's box must stay above in the next step.
  void SetGround(const Eigen::Vector3d& point_W, const Eigen::Vector3d& normal_W);

  // Weight, joints, what was pushed. `dt_s` over 0.
  void Step(double dt_s);

 private:
  struct World;

  void Read();

  std::unique_ptr<World> world_;
  Bodies bodies_;
};

// What the spring bears where the car rests on level ground: the wheel's load without its own weight, N.
double PreloadOf(const OdeSettings& settings, std::size_t wheel);

}  // namespace rodeira::dynamics
