// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "common/vehicle/dynamics/bicycle_settings.hpp"
#include "common/vehicle/dynamics/powertrain.hpp"
#include "common/vehicle/dynamics/rigid_body.hpp"
#include "common/vehicle/dynamics/suspension.hpp"
#include "common/vehicle/dynamics/tyre.hpp"
#include "common/vehicle/dynamics/vehicle_model.hpp"
#include "common/vehicle/dynamics/wheel_drive.hpp"
#include "common/vehicle/dynamics/wheel_ground.hpp"

namespace rodeira::dynamics {

// Longer steps are divided.
inline constexpr double kLongestSubstep_s = 0.001;

// What all cars of one file share: settings, and what follows from them.
struct BicycleChassis {
  explicit BicycleChassis(const BicycleSettings& of);

  BicycleSettings settings;
  std::array<TyreSettings, kWheels> tyres;
  Eigen::Vector3d p_BG_B;  // centre of gravity in the body frame
  std::array<double, kWheels> static_load_N{};
  std::array<Eigen::Vector3d, kWheels> p_GH_B;  // from there to the hubs at rest

  assists::AssistCar assist_car;

  WheelDriveSettings drive() const {
    return {settings.wheel, settings.brakes, settings.powertrain, settings.assists, assist_car};
  }
  // Of a wheel about the body's z axis, positive to the left: steering wheel angle, held to the limit, by the ratio; 0
  // at the rear.
  double SteerAngle(std::size_t wheel, double steering_wheel_rad) const;
  // From B's origin, with the tyre pressed in by its static load.
  Eigen::Vector3d HubAtRest_B(std::size_t wheel) const;
};

// The car where its body is now: found once for all that a substep asks of it.
struct BicyclePose {
  Eigen::Vector3d up_W = Eigen::Vector3d::UnitZ();
  std::array<Eigen::Vector3d, 2> heading_W;    // of each axle's wheels
  std::array<Eigen::Vector3d, kWheels> hub_W;  // at rest: without travel
};

// Where a wheel meets the ground, for one substep.
struct BicycleContact {
  Eigen::Vector3d point_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d along_W = Eigen::Vector3d::UnitX();
  Eigen::Vector3d across_W = Eigen::Vector3d::UnitY();
  TyreForces forces;
};
using BicycleContacts = std::array<BicycleContact, kWheels>;

// What was found in a substep, for publishers: nothing that later steps depend on.
struct BicycleFindings {
  BicycleContacts contacts;
  WheelTorques torques;
  double drag_N = 0.0;
};

// All of one car that changes: a value of some 1600 bytes, without a reference to anything, so that many of them are an
// array (common/vehicle/dynamics/car_array). Its equations are those of model `bicycle` (docs/explanation/vehicle.md).
struct BicycleCar {
  // The wheel's spin is positive where it rolls forward; the angle wraps at ±pi.
  struct Wheel : WheelGround {
    Corner corner;
    Tyre tyre;
    double spin_rad = 0.0;
    double spin_radps = 0.0;

    void Save(base::StateWriter& writer) const;
    void Restore(base::StateReader& reader);
  };

  RigidBody body;
  std::array<Wheel, kWheels> wheels;
  Powertrain powertrain;
  assists::Assists assists;
  double forward_mps2 = 0.0;  // acceleration of the last substep along the car
  double lateral_mps2 = 0.0;  // and across
  double steer_rad = 0.0;     // of the front wheels at the end of the last substep

  // B's origin, in W.
  Eigen::Vector3d p_WB_W(const BicycleChassis& chassis) const { return body.p_WG_W - body.q_WG * chassis.p_BG_B; }
  // A hub without suspension travel, in W.
  Eigen::Vector3d HubAtRest_W(const BicycleChassis& chassis, std::size_t wheel) const {
    return body.p_WG_W + body.q_WG * chassis.p_GH_B[wheel];
  }

  // After a query of the ground in a run: what was under the wheels before it.
  void RollOn(const BicycleChassis& chassis, const std::array<WheelGround, kWheels>& before);

  // A step of any length with the controls held and the ground's planes as they are, in substeps of at most 1 ms.
  // `controls` are cut to their bounds (Cut), the push holds all the while.
  void Step(const BicycleChassis& chassis, const Controls& controls, const Wrench& push, double dt_s,
            BicycleFindings& findings);

  // The steering wheel is positive to the left.
  BicyclePose PoseOf(const BicycleChassis& chassis, double steering_wheel_rad) const;
  // What the wheel's suspension meets on the plane under it.
  CornerInput CornerInputOf(const BicycleChassis& chassis, const BicyclePose& pose, std::size_t wheel) const;
  // The hub's foot on the plane under the wheel, with axes along and across (to the left) in it; forces are still 0.
  BicycleContact ContactOf(const BicyclePose& pose, std::size_t wheel) const;
  // Along, each wheel moves as its own contact does; across, both wheels of an axle as its middle. The front wheels are
  // steered at this rate.
  std::array<TyreMotion, kWheels> MotionOf(const BicycleChassis& chassis, const BicycleContacts& contacts,
                                           double steer_radps = 0.0) const;

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);

 private:
  void Substep(const BicycleChassis& chassis, const Controls& controls, const Wrench& push, double dt_s,
               BicycleFindings& findings);
  void TurnWheels(const BicycleChassis& chassis, const Controls& controls, double dt_s, BicycleFindings& findings);
  void PushBody(const BicycleChassis& chassis, const Wrench& push, double dt_s, BicycleFindings& findings);
  void KeepUpright(const BicycleChassis& chassis, const BicycleContacts& contacts, double dt_s);
};

// The plane under the car: parallel to both diagonals of the contact points, which for four points of a plane is
// theirs.
Eigen::Vector3d RoadNormal(const BicycleContacts& contacts);

}  // namespace rodeira::dynamics
