// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>

#include "common/vehicle/dynamics/disc_contact.hpp"
#include "common/vehicle/dynamics/ode_car.hpp"
#include "common/vehicle/dynamics/ode_settings.hpp"
#include "common/vehicle/dynamics/powertrain.hpp"
#include "common/vehicle/dynamics/tyre.hpp"
#include "common/vehicle/dynamics/tyre_pressure.hpp"
#include "common/vehicle/dynamics/vehicle_model.hpp"
#include "common/vehicle/dynamics/wheel_drive.hpp"
#include "common/vehicle/dynamics/wheel_ground.hpp"

namespace rodeira::dynamics {

// The car as five rigid bodies in the Open Dynamics Engine (ode_car.hpp): chassis and wheels with mass on hinge-2
// joints. Tyres are no contact joints of ODE's: their forces, by slip curve or Magic Formula with transient slip, are
// pushed onto the wheels where these meet SUELO's planes. Contact joints serve collisions only: those of the body's box
// with the ground, so that the car may fall over and lies on its roof. Engine, clutch, gearbox, differential and brakes
// are those of the other models.
class OdeModel final : public VehicleModel {
 public:
  // Nothing but Build may be called before Build.
  explicit OdeModel(const OdeSettings& settings) : settings_(settings), tyres_(OnWheels(settings.car.tyre)) {}
  // Makes ODE's bodies and joints, once.
  base::Status Build();

  base::Status Initialise(const InitialCondition& initial, ground::Ground& ground) override;
  void Step(const Controls& controls, ground::Ground& ground, double dt_s) override;
  void SetPush(const Wrench& push) override { push_ = push; }
  bool can_be_pushed() const override { return true; }
  void SetTyrePressures(const std::array<double, kWheels>& shares) override {
    for (std::size_t i = 0; i < kWheels; ++i) SetPressure(tyres_[i], shares[i]);
  }
  bool has_tyre_pressures() const override { return true; }
  const VehicleState& state() const override { return state_; }
  const VehicleDimensions& dimensions() const override { return settings_.car.dimensions; }
  void Save(base::StateWriter& writer) const override;
  void Restore(base::StateReader& reader) override;

  const OdeSettings& settings() const { return settings_; }

 private:
  friend class OdeEquilibrium;

  struct Wheel : WheelGround {
    Tyre tyre;
    double spin_rad = 0.0;
    double spin_radps = 0.0;  // about its axle against the chassis

    void Save(base::StateWriter& writer) const;
    void Restore(base::StateReader& reader);
  };
  struct Contact : DiscContact {
    double load_N = 0.0;
    TyreForces forces;
  };
  using Contacts = std::array<Contact, kWheels>;
  // All that changes from step to step.
  struct Motion {
    OdeCar::Bodies bodies;
    std::array<Wheel, kWheels> wheels;
    Powertrain powertrain;
    assists::Assists assists;
    double forward_mps2 = 0.0;  // acceleration of the last substep along the car
    double lateral_mps2 = 0.0;  // and across
    double lowered_m = 0.0;     // of the plane under the body (LoweredBy)
  };

  const RigidBody& chassis() const { return now_.bodies[OdeCar::kChassis]; }
  Eigen::Vector3d p_WB_W() const;
  double SteerAngle(std::size_t wheel, double steering_wheel_rad) const;
  double Travel(std::size_t wheel) const;      // compression from rest, m
  double TravelRate(std::size_t wheel) const;  // m/s
  double StrutExtra(std::size_t wheel) const;  // preload, anti-roll bar and stops, N; the spring is the joint's
  void QueryGround(ground::Ground& ground);
  Contact ContactOf(std::size_t wheel) const;
  TyreMotion MotionOf(std::size_t wheel, const Contact& contact) const;
  void Substep(const Controls& controls, double dt_s);
  WheelTorques TurnWheels(const Controls& controls, const Contacts& contacts, double dt_s);
  void Publish(const Controls& controls, double dt_s);
  double SteeringTorque() const;

  OdeSettings settings_;
  std::array<TyreSettings, kWheels> tyres_;
  OdeChassis measures_;
  assists::AssistCar assist_car_;
  std::unique_ptr<OdeCar> car_;
  Motion now_;
  Contacts contacts_;  // of the last substep
  WheelTorques torques_;
  double drag_N_ = 0.0;
  Wrench push_;  // of the next step
  VehicleState state_;
};

}  // namespace rodeira::dynamics
