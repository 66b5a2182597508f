// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/vehicle/dynamics/bicycle_car.hpp"
#include "common/vehicle/dynamics/tyre_pressure.hpp"
#include "common/vehicle/dynamics/vehicle_model.hpp"

namespace rodeira::dynamics {

// The single-track car on four wheels. In plan both wheels of an axle share the motion of the axle's middle, so one
// slip angle an axle, and their horizontal forces act there; each wheel has its own load, friction and spin. The body
// is a rigid body on four massless wheel carriers (spring, damper, anti-roll bar, vertical tyre stiffness), so that
// loads, height, pitch and roll follow from the ground under the four wheels, and weight acts along slopes. Longer
// steps than 1 ms are divided; the ground under a wheel is then its tangent plane. The car cannot fall over: its lean
// against the ground under it is bounded. Not modelled: bump steer, camber, aligning moments on the body, lift, wind,
// gyroscopes of the wheels.
class BicycleModel final : public VehicleModel {
 public:
  explicit BicycleModel(const BicycleSettings& settings) : chassis_(settings) {}

  base::Status Initialise(const InitialCondition& initial, ground::Ground& ground) override;
  void Step(const Controls& controls, ground::Ground& ground, double dt_s) override;
  void SetPush(const Wrench& push) override { push_ = push; }
  bool can_be_pushed() const override { return true; }
  void SetTyrePressures(const std::array<double, kWheels>& shares) override {
    for (std::size_t i = 0; i < kWheels; ++i) SetPressure(chassis_.tyres[i], shares[i]);
  }
  bool has_tyre_pressures() const override { return true; }
  const VehicleState& state() const override { return state_; }
  const VehicleDimensions& dimensions() const override { return chassis_.settings.dimensions; }
  void Save(base::StateWriter& writer) const override;
  void Restore(base::StateReader& reader) override;

  const BicycleSettings& settings() const { return chassis_.settings; }
  // All of it that moves.
  const BicycleCar& car() const { return car_; }

 private:
  friend class BicycleEquilibrium;

  Eigen::Vector3d p_WB_W() const { return car_.p_WB_W(chassis_); }
  Eigen::Vector3d v_WB_W() const { return car_.body.VelocityAt(p_WB_W()); }
  void QueryGround(ground::Ground& ground, double steering_wheel_rad);
  void Publish(const Controls& controls, double dt_s);
  double SteeringTorque() const;

  BicycleChassis chassis_;
  BicycleCar car_;
  BicycleFindings findings_;  // of the last substep
  Wrench push_;               // of the next step
  VehicleState state_;
};

}  // namespace rodeira::dynamics
