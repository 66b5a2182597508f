// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "common/vehicle/dynamics/multibody_body_load.hpp"
#include "common/vehicle/dynamics/multibody_loads.hpp"
#include "common/vehicle/dynamics/multibody_settings.hpp"
#include "common/vehicle/dynamics/wheel_drive.hpp"
#include "common/vehicle/dynamics/wheel_ground.hpp"
#include "common/vehicle/multibody/joints.hpp"
#include "common/vehicle/multibody/output.hpp"
#include "common/vehicle/multibody/system.hpp"

namespace rodeira::dynamics {

// A car with body, suspensions and steering as a multibody mechanism in natural coordinates, stepped by the index-3
// augmented Lagrangian (common/vehicle/multibody), on tyres by the Magic Formula with camber. Wheels spin as rotors
// about their axles, coupled to the mechanism by brake reaction, drive reaction and gyroscopic torque; engine, clutch,
// gearbox, differential and brakes are those of the other models. Longer steps than the file's longest substep are
// divided; the ground under a wheel is then its tangent plane.
class MultibodyModel final : public VehicleModel {
 public:
  // Nothing but Build may be called before Build has succeeded.
  explicit MultibodyModel(const MultibodySettings& settings) : settings_(settings), tyres_(OnWheels(settings.tyre)) {}
  // Refused where the mechanism cannot be assembled or cannot stand on level ground.
  base::Status Build();
  // After it: the file's `mechanism: outputs`, as of a mechanism file but none where it names none. Problems stay in
  // the file's collection.
  void ReadOutputs(const config::Map& root);

  base::Status Initialise(const InitialCondition& initial, ground::Ground& ground) override;
  void Step(const Controls& controls, ground::Ground& ground, double dt_s) override;
  void SetPush(const Wrench& push) override { push_ = push; }
  bool can_be_pushed() const override { return true; }
  void SetTyrePressures(const std::array<double, kWheels>& shares) override;
  bool has_tyre_pressures() const override { return true; }
  const VehicleState& state() const override { return state_; }
  const VehicleDimensions& dimensions() const override { return settings_.dimensions; }
  std::vector<std::string> output_names() const override;
  std::vector<double> Outputs() const override;
  bool has_joint_forces() const override { return true; }
  JointForces FindJointForces() override;
  void Save(base::StateWriter& writer) const override;
  void Restore(base::StateReader& reader) override;

  const MultibodySettings& settings() const { return settings_; }
  const multibody::System& system() const { return *system_; }
  multibody::System& system() { return *system_; }
  // Of the last substep: iterations, solutions of the projections, factorisations.
  const multibody::StepReport& report() const { return report_; }
  // Pose of the published body frame B now.
  Eigen::Isometry3d X_WB() const;

 private:
  struct Wheel : WheelGround {
    Tyre tyre;
    double spin_rad = 0.0;
    double spin_radps = 0.0;
    std::shared_ptr<WheelLoad> load;

    void Save(base::StateWriter& writer) const;
    void Restore(base::StateReader& reader);
  };
  using Contacts = std::array<WheelLoad::Contact, kWheels>;

  Eigen::Vector3d Hub_W(std::size_t wheel) const;
  Eigen::Vector3d Forward_W() const;
  Eigen::Vector3d Turning_W(const multibody::Frame& frame, const multibody::Motion& motion) const;  // angular velocity
  void QueryGround(ground::Ground& ground);
  void FillAssistCar();
  void GiveGround(std::size_t wheel);
  // One substep.
  void Substep(const Controls& controls, double dt_s);
  Contacts FindContacts(const multibody::Motion& motion) const;
  TyreMotion MotionOf(std::size_t wheel, const multibody::Motion& motion, const WheelLoad::Contact& contact) const;
  using Rolling = std::array<TyreMotion, kWheels>;
  Rolling FindRolling(const multibody::Motion& motion, const Contacts& contacts) const;
  // Loads and tyres' forces in the middle of the step.
  WheelTorques TurnWheels(const Controls& controls, const std::array<double, kWheels>& loads_N,
                          const std::array<TyreForces, kWheels>& forces, double dt_s);
  void Advance(double dt_s, int depth);
  multibody::Balance FindBalance() const;
  // INI.
  struct Cruise;  // of a car that keeps its speed
  base::Status Settle(const InitialCondition& initial, ground::Ground& ground, Cruise& cruise);
  base::Status Balance(const InitialCondition& initial, ground::Ground& ground, Cruise* cruise);
  Eigen::Isometry3d MoveTo(const InitialCondition& initial, double& by);
  double UpdateCruise(const InitialCondition& initial, Cruise& cruise);
  void FillTranslation(const Eigen::Vector3d& v_W, std::span<double> rates) const;
  void Place(const Eigen::Isometry3d& X_WC);
  void SetInMotion(const InitialCondition& initial, const Cruise& cruise);
  void Turn(const Eigen::Vector3d& about_W, const Eigen::Vector3d& w_W);
  // Published state.
  void Publish(const Controls& controls, double dt_s);

  MultibodySettings settings_;
  std::array<TyreSettings, kWheels> tyres_;
  assists::AssistCar assist_car_;
  std::unique_ptr<multibody::System> system_;
  std::shared_ptr<ChassisLoad> chassis_load_;
  std::shared_ptr<BodyLoad> body_load_;
  std::shared_ptr<ColumnLoad> column_load_;
  multibody::Form origin_;  // chassis point drawn at the file's origin
  Eigen::Isometry3d X_CB_ =
      Eigen::Isometry3d::Identity();  // body frame in the chassis as drawn: what rests level on z = 0
  std::array<Eigen::Vector3d, kWheels> hub_rest_B_;
  std::vector<multibody::Output> outputs_;
  std::vector<multibody::Joint> joints_;  // found when they are first asked for

  std::array<Wheel, kWheels> wheels_;
  Powertrain powertrain_;
  assists::Assists assists_;
  double forward_mps2_ = 0.0;
  double lateral_mps2_ = 0.0;
  double hands_rad_ = 0.0;  // steering wheel at the end of the last substep
  double lowered_m_ = 0.0;  // of the plane under the body (LoweredBy)
  std::array<TyreForces, kWheels> forces_;
  WheelTorques torques_;
  multibody::StepReport report_;
  std::vector<double> ahead_q_, ahead_qd_;  // scratch of a substep
  Wrench push_;                             // of the next step
  VehicleState state_;
};

}  // namespace rodeira::dynamics
