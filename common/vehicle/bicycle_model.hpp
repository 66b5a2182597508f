#pragma once

#include <array>

#include "common/vehicle/bicycle_settings.hpp"
#include "common/vehicle/powertrain.hpp"
#include "common/vehicle/rigid_body.hpp"
#include "common/vehicle/suspension.hpp"
#include "common/vehicle/tyre.hpp"
#include "common/vehicle/vehicle_model.hpp"
#include "common/vehicle/wheel_ground.hpp"

namespace rodeira::vehicle {

// The single-track car on four wheels. In plan both wheels of an axle share the motion of the axle's middle, so one slip
// angle an axle, and their horizontal forces act there; each wheel has its own load, friction and spin. The body is a rigid
// body on four massless wheel carriers (spring, damper, anti-roll bar, vertical tyre stiffness), so that loads, height,
// pitch and roll follow from the ground under the four wheels, and weight acts along slopes. Longer steps than 1 ms are
// divided; the ground under a wheel is then its tangent plane. The car cannot fall over: its lean against the ground under
// it is bounded. Not modelled: bump steer, camber, aligning moments on the body, lift, wind, gyroscopes of the wheels.
class BicycleModel final : public VehicleModel {
 public:
  explicit BicycleModel(const BicycleSettings& settings);

  base::Status Initialise(const InitialCondition& initial, terrain::Ground& ground) override;
  void Step(const Controls& controls, terrain::Ground& ground, double dt_s) override;
  void SetPush(const Wrench& push) override { push_ = push; }
  bool can_be_pushed() const override { return true; }
  const VehicleState& state() const override { return state_; }
  const VehicleDimensions& dimensions() const override { return settings_.dimensions; }
  void Save(base::StateWriter& writer) const override;
  void Restore(base::StateReader& reader) override;

  const BicycleSettings& settings() const { return settings_; }

 private:
  friend class BicycleEquilibrium;

  struct Wheel : WheelGround {
    Corner corner;
    Tyre tyre;
    double spin_rad = 0.0;
    double spin_radps = 0.0;

    void Save(base::StateWriter& writer) const;
    void Restore(base::StateReader& reader);
  };
  // Where a wheel meets the ground, for one substep.
  struct Contact {
    Eigen::Vector3d point_W = Eigen::Vector3d::Zero();
    Eigen::Vector3d along_W = Eigen::Vector3d::UnitX();
    Eigen::Vector3d across_W = Eigen::Vector3d::UnitY();
    TyreForces forces;
  };
  using Contacts = std::array<Contact, kWheels>;
  struct WheelTorques {
    std::array<double, kWheels> brake_Nm{};
    std::array<double, kWheels> drive_Nm{};
  };

  double SteerAngle(std::size_t wheel, double steering_wheel_rad) const;
  Eigen::Vector3d HubAtRest_B(std::size_t wheel) const;
  Eigen::Vector3d HubAtRest_W(std::size_t wheel) const;
  // Ground.
  void AskGround(terrain::Ground& ground);
  CornerInput CornerInputOf(std::size_t wheel) const;
  Contact ContactOf(std::size_t wheel, double steering_wheel_rad) const;
  Eigen::Vector3d RoadNormal(const Contacts& contacts) const;
  // One substep.
  void Substep(const Controls& controls, double dt_s);
  TyreMotion MotionOf(const Contacts& contacts, std::size_t wheel) const;
  WheelTorques TurnWheels(const Controls& controls, const Contacts& contacts, double dt_s);
  void PushBody(const Contacts& contacts, double dt_s);
  void KeepUpright(const Contacts& contacts);
  // Published state.
  Eigen::Vector3d p_WB_W() const;
  Eigen::Vector3d v_WB_W() const;
  void Publish(const Controls& controls, double dt_s);
  double SteeringTorque() const;

  BicycleSettings settings_;
  std::array<TyreSettings, kWheels> tyres_;
  Eigen::Vector3d p_BG_B_;  // centre of gravity in the body frame
  std::array<double, kWheels> static_load_N_{};

  RigidBody body_;
  std::array<Wheel, kWheels> wheels_;
  Powertrain powertrain_;
  double forward_mps2_ = 0.0;  // acceleration of the last substep along the car
  Contacts contacts_;          // of the last substep
  WheelTorques torques_;
  double drag_N_ = 0.0;
  Wrench push_;  // of the next step
  VehicleState state_;
};

}  // namespace rodeira::vehicle
