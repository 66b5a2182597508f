// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "common/core/base/state.hpp"
#include "common/vehicle/dynamics/automatic_gearbox.hpp"
#include "common/vehicle/dynamics/controls.hpp"
#include "common/vehicle/dynamics/driveline.hpp"
#include "common/vehicle/dynamics/engine.hpp"
#include "common/vehicle/dynamics/gearbox.hpp"

namespace rodeira::dynamics {

enum class DrivenWheels { kFront, kRear, kAll };

// Whether a wheel of this axle (0 front, 1 rear) is driven.
bool Drives(DrivenWheels driven, std::size_t axle);

// From the engine to the driven wheels.
struct PowertrainSettings {
  DrivenWheels driven = DrivenWheels::kFront;
  EngineSettings engine;
  ClutchSettings clutch;
  GearboxSettings gearbox;
  DifferentialSettings differential;  // of the only driven axle; with all wheels driven of the front one
  DifferentialSettings rear_differential;
  CentreDifferentialSettings centre;
  AutomaticSettings automatic;
};

// Share of the engine's torque that an axle gets while no centre differential locks: front, rear.
std::array<double, 2> AxleShares(const PowertrainSettings& settings);

// Speed at which the gears turn over their ratio: the mean of both wheels of the driven axle, of both axles by their
// shares of the torque.
double TurningOf(const PowertrainSettings& settings, const std::array<double, 4>& wheel_radps);

// Of a driven axle: left, right.
struct AxleInput {
  std::array<double, 2> wheel_radps{};
  std::array<double, 2> road_torque_Nm{};
  std::array<double, 2> friction_torque_Nm{};  // brake and rolling resistance
};

// What the car around it tells the powertrain at the beginning of a step: of the only driven axle or, with all wheels
// driven, of the front one.
struct PowertrainInput : AxleInput {
  double wheel_inertia_kgm2 = 1.0;
  double speed_mps = 0.0;          // of the car, forward
  double inertia_torque_Nm = 0.0;  // mass × radius × forward acceleration, of the last step
  AxleInput rear;
};

// Torque of a shaft of which its wheel gets `at_wheel_Nm` when it turns onward (1) or backward (-1): the gears' losses
// are dry friction by it.
double ShaftTorque(const GearboxSettings& gearbox, double at_wheel_Nm, double onward);

// Engine, clutch, gearbox worked by hand or by the car, final drive and differentials to two or four wheels.
class Powertrain {
 public:
  // The engine runs; where the wheels turn fast enough it turns with them in a gear that suits.
  void Start(const PowertrainSettings& settings, double wheel_radps);
  // The same at a speed that it keeps: each wheel of an axle (front, rear) that is driven gets this torque of its shaft
  // less the gears' losses, by an engine with its throttle open as far as that takes. Not more than Start where the
  // wheels turn too slowly for a closed clutch.
  void StartSteadily(const PowertrainSettings& settings, double wheel_radps, const std::array<double, 2>& at_wheel_Nm);
  // What became of engine, clutch and driven wheels in this step; valid until the next one.
  const DrivelineMotion& Step(const PowertrainSettings& settings, const Controls& controls,
                              const PowertrainInput& input, double dt_s);

  const Engine& engine() const { return engine_; }
  const DrivelineMotion& motion() const { return motion_; }
  int gear() const { return gear_; }
  double clutch() const { return clutch_; }

  // The last step's motion of an axle (0 front, 1 rear); null where it is not driven.
  const AxleMotion* AxleOf(const PowertrainSettings& settings, std::size_t axle) const;

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);

 private:
  Engine engine_;
  AutomaticGearbox automatic_;
  GearboxMode mode_ = GearboxMode::kAutomatic;
  std::int32_t gear_ = 0;
  double clutch_ = 1.0;
  DrivelineMotion motion_;  // of the last step; its clutch torque sets the next step's losses
};

}  // namespace rodeira::dynamics
