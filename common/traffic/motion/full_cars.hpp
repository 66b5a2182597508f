// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/core/base/state.hpp"
#include "common/core/base/thread_pool.hpp"
#include "common/driving/driver/pedals.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/vehicle/dynamics/car_array.hpp"

namespace rodeira::traffic {

// Where an agent's path leads, as its driver sees it.
struct PathAhead {
  Eigen::Vector2d rear_W = Eigen::Vector2d::Zero();  // the point beside the middle of the rear axle of the line that it
                                                     // is to keep (RearLine_m)
  Eigen::Vector2d ahead_W = Eigen::Vector2d::UnitX();  // the path's direction, unit
  double curvature_1pm = 0.0;  // where the car is when hands and tyres have answered; positive to the left
};

// Agents' cars with full physics: each a car of dynamics::CarArray (four wheels on SUELO's ground, engine, clutch,
// gears, differential, brakes, drag), driven by throttle, brake and steering wheel alone.
class FullCars {
 public:
  // So many places, one an agent.
  FullCars(std::shared_ptr<ground::Ground> ground, std::size_t agents);

  // INI of an agent's car; refused as by BicycleModel::Initialise.
  base::Status Place(std::uint32_t id, std::uint32_t body, const dynamics::InitialCondition& initial);
  // Its car is gone; the place is free.
  void Clear(std::uint32_t id) { cars_.Clear(id); }

  // How hands and feet are held until the next decision, for an acceleration in the plane and to stay on the path. Of
  // the agent's own alone.
  void Drive(std::uint32_t id, double wanted_mps2, const PathAhead& path, double dt_s);
  // The same by other hands and feet.
  void Hold(std::uint32_t id, const dynamics::Controls& controls) { controls_[id] = controls; }
  // Every car by its controls; the number of threads changes no bit.
  void Step(double dt_s, base::ThreadPool* pool);

  const dynamics::CarArray& cars() const { return cars_; }
  // Of the last step.
  const dynamics::Controls& controls(std::uint32_t id) const { return controls_[id]; }
  const driver::Pedals& foot(std::uint32_t id) const { return feet_[id]; }
  // Of its middle, in the plane, along the way on which its wheels roll, heading + atan(½ tan δ): less than its motion
  // where it slides, and below 0 where it rolls back. At less than a millimetre a second it stands.
  double PlanSpeed_mps(std::uint32_t id) const;
  // The middle of the rear axle, seen from above.
  Eigen::Vector2d RearAxle_W(std::uint32_t id) const;
  // What pedals, gear and engine do now.
  Driving DrivingOf(std::uint32_t id) const;
  // Now, and since Place.
  double FuelFlow_mgps(std::uint32_t id) const { return 1e6 * cars_.car(id).powertrain.engine().fuel_rate_kgps(); }
  double FuelUsed_mg(std::uint32_t id) const { return 1e6 * cars_.car(id).powertrain.engine().fuel_kg(); }
  // Pose, steer angle, spin of its wheels.
  void Tell(std::uint32_t id, AgentPose& pose) const;

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);

 private:
  double SteeringWheel(std::uint32_t id, const PathAhead& path, double dt_s) const;

  std::shared_ptr<ground::Ground> ground_;
  dynamics::CarArray cars_;
  std::vector<dynamics::Controls> controls_;  // by agent
  std::vector<driver::Pedals> feet_;          // by agent
};

}  // namespace rodeira::traffic
