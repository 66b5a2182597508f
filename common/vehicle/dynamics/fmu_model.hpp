// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "common/vehicle/dynamics/fmu_variables.hpp"
#include "common/vehicle/dynamics/vehicle_model.hpp"
#include "common/vehicle/dynamics/wheel.hpp"
#include "common/vehicle/dynamics/wheel_ground.hpp"
#include "common/vehicle/fmi/unit.hpp"

namespace rodeira::dynamics {

// The settings of a vehicle file of model `fmu`.
struct FmuSettings {
  std::filesystem::path fmu;
  FmuNames names;
  std::map<std::string, double> parameters;  // of the FMU, by its names and in its units: set before the first step
  std::map<std::string, std::string> parameter_places;  // "FILE:LINE"
  Enveloping enveloping = Enveloping::kNone;            // of the ground that the FMU gets
  VehicleDimensions dimensions;
};
// Problems stay in the file's collection; the FMU itself is not opened.
FmuSettings ReadFmu(const config::Map& root);

// A vehicle from an FMU for co-simulation (FMI 2.0). Its inputs are the driver's controls and the ground's plane under
// each wheel, its outputs the car's motion. The FMU computes its own initial equilibrium. After an error of the FMU the
// vehicle stays where it is, and problem() says why.
class FmuModel final : public VehicleModel {
 public:
  // Nothing but Build may be called before Build has succeeded.
  explicit FmuModel(const FmuSettings& settings) : settings_(settings) {}
  // Wrong input if the file is not an FMU with the variables of a vehicle.
  base::Status Build();

  base::Status Initialise(const InitialCondition& initial, ground::Ground& ground) override;
  void Step(const Controls& controls, ground::Ground& ground, double dt_s) override;
  base::Status problem() const override { return problem_; }
  void SetPush(const Wrench& push) override { push_ = push; }
  // It has all inputs push_….
  bool can_be_pushed() const override { return variables_.takes_pushes(); }
  const VehicleState& state() const override { return state_; }
  const VehicleDimensions& dimensions() const override { return settings_.dimensions; }
  void Save(base::StateWriter& writer) const override;
  void Restore(base::StateReader& reader) override;
  bool can_save() const override { return unit_->can_save_state(); }
  // Notes about converted units and missing variables, one sentence each, for the log at the start.
  const std::vector<std::string>& notes() const { return variables_.notes; }

 private:
  Eigen::Vector3d HubAtRest_B(std::size_t wheel) const;
  void QueryGround(ground::Ground& ground);
  base::Status Set(const FmuVariables::Variable& variable, double value);
  base::Status SetGround();
  base::Status SetPushInputs();
  base::Status SetControls(const Controls& controls);
  base::Status SetStart(const InitialCondition& initial);
  base::Status Begin(const InitialCondition& initial, ground::Ground& ground);
  base::Result<double> Get(const FmuVariables::Variable& variable, double default_value = 0.0);
  base::Status TakeFreshInstance();
  base::Status Publish(const Controls& controls, double dt_s);
  base::Status Advance(const Controls& controls, double dt_s);

  FmuSettings settings_;
  std::unique_ptr<fmi::Unit> unit_;
  FmuVariables variables_;
  std::unique_ptr<fmi::Instance> instance_;  // destroyed before the unit
  double time_s_ = 0.0;
  std::array<WheelGround, kWheels> wheels_;
  Wrench push_;  // of the next step
  VehicleState state_;
  std::vector<std::uint8_t> restored_;  // until the next step: the bytes that Restore took
  base::Status problem_;
};

}  // namespace rodeira::dynamics
