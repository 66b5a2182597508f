// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/core/base/state.hpp"
#include "common/core/config/config.hpp"
#include "common/core/ground/ground.hpp"
#include "common/vehicle/dynamics/controls.hpp"
#include "common/vehicle/dynamics/vehicle_state.hpp"

namespace rodeira::dynamics {

// Where and how the car begins. z, pitch, roll, suspension and loads are found by Initialise, on the ground.
struct InitialCondition {
  double x_m = 0.0;  // of B's origin in W
  double y_m = 0.0;
  double z_hint_m = std::numeric_limits<double>::quiet_NaN();  // which of several layers; NaN: the top one
  double heading_rad = 0.0;                                    // from east, counter-clockwise
  double speed_mps = 0.0;                                      // along the car, negative backward
  double lateral_speed_mps = 0.0;                              // to the left
  double yaw_rate_radps = 0.0;                                 // counter-clockwise seen from above
};

// Of the height NaN says something; all else is a number.
bool IsFinite(const InitialCondition& initial);
// What a moving car of another model, or of a recording, hands over.
InitialCondition FromState(const VehicleState& state);

// Fixed measures of the car, for those who draw it, drive it or keep away from it.
struct VehicleDimensions {
  double wheelbase_m = 0.0;
  double track_front_m = 0.0;
  double track_rear_m = 0.0;
  double wheel_radius_m = 0.0;  // unloaded
  double wheel_width_m = 0.0;
  double front_m = 0.0;  // from B's origin to the front bumper
  double rear_m = 0.0;   // from B's origin to the rear bumper
  double width_m = 0.0;  // without mirrors
  double height_m = 0.0;
  double mass_kg = 0.0;
  double steering_ratio = 1.0;            // angle of the steering wheel for one of the front wheels
  double steering_wheel_limit_rad = 0.0;  // stop, each side
  int forward_gears = 0;
};

// A force and its moment about B's origin, both in W: what the body takes from outside (a collision).
struct Wrench {
  Eigen::Vector3d force_W = Eigen::Vector3d::Zero();      // N
  Eigen::Vector3d moment_WB_W = Eigen::Vector3d::Zero();  // N m

  bool any() const { return !force_W.isZero(0.0) || !moment_WB_W.isZero(0.0); }
};

// The longest step of a model (VehicleModel::Step).
inline constexpr double kMaxStep_s = 0.1;

// One vehicle. A value that is stepped (law L3): everything that later steps depend on is in Save and Restore, and the
// same calls give the same bits.
class VehicleModel {
 public:
  virtual ~VehicleModel() = default;

  // INI: places the car in equilibrium on the ground. The engine idles or turns with the wheels in a gear that suits
  // the speed; counters are zero. May ask the ground several times. Refused where a wheel would stand outside the world
  // or a number is not finite; the model is then as before.
  virtual base::Status Initialise(const InitialCondition& initial, ground::Ground& ground) = 0;

  // CALCULO: advances by dt_s (over 0, at most kMaxStep_s) with the controls held. Asks the ground exactly once, one
  // batch for four wheels (law L4). Outside of the world a wheel goes on upon the last plane that it knew.
  virtual void Step(const Controls& controls, ground::Ground& ground, double dt_s) = 0;

  // What the next Step holds against the body from outside; a second call replaces the first, and after the step it is
  // gone: no part of the state. A model that cannot be pushed takes no notice.
  virtual void SetPush(const Wrench& /*push*/) {}
  virtual bool can_be_pushed() const { return false; }

  virtual const VehicleState& state() const = 0;
  virtual const VehicleDimensions& dimensions() const = 0;

  // The whole state; Restore is meant for a model of the same file. Problems are the reader's (StateReader::Finish).
  virtual void Save(base::StateWriter& writer) const = 0;
  virtual void Restore(base::StateReader& reader) = 0;
  // False: the state cannot be read out. Save then writes what is known of it, Restore is never called, and a run with
  // this car is computed again from its first step only.
  virtual bool can_save() const { return true; }
  // What the car's file asks for beside the state (`outputs`: forces within a mechanism): names with their units, and
  // the values now.
  virtual std::vector<std::string> output_names() const { return {}; }
  virtual std::vector<double> Outputs() const { return {}; }
  // Why the last Step was not made (a laboratory's own model has failed): the car stays where it is. Ok otherwise.
  virtual base::Status problem() const { return {}; }
};

// A kind of model that a vehicle file may name, and what makes one of it from the file's mapping. Problems of the file
// are left in its collection (config::File); `make` may then return anything, even null. `complete`, where there is
// one, is called when the file has no problems: what takes sound numbers to build, and what can be read only then.
struct ModelKind {
  std::string name;
  std::function<std::unique_ptr<VehicleModel>(const config::Map& root)> make;
  std::function<base::Status(VehicleModel& model, const config::Map& root)> complete = nullptr;
};

// Reads a vehicle file (`rodeira: vehicle/1`, `model: bicycle`). `wanted`: another model than the file's own; the file
// names the one in which that is, `models: {ode: FILE}`. Wrong input, with file:line, where it cannot be read, a key is
// unknown or out of range, or the model's name is unknown (the nearest is given). `more`: kinds beyond this library's
// own.
base::Result<std::unique_ptr<VehicleModel>> LoadVehicle(const std::filesystem::path& path, std::string_view wanted = {},
                                                        std::span<const ModelKind> more = {});

}  // namespace rodeira::dynamics
