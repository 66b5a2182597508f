// SPDX-License-Identifier: Apache-2.0
#pragma once

/// @file
/// The interface of a vehicle model.

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
#include "common/vehicle/dynamics/joint_forces.hpp"
#include "common/vehicle/dynamics/vehicle_state.hpp"

namespace rodeira::dynamics {

/// The start of a car. Initialise finds z, pitch, roll, suspension and loads on the ground.
struct InitialCondition {
  double x_m = 0.0;                                            ///< position of B's origin in W, east
  double y_m = 0.0;                                            ///< position of B's origin in W, north
  double z_hint_m = std::numeric_limits<double>::quiet_NaN();  ///< height hint of the surface; NaN: the top surface
  double heading_rad = 0.0;                                    ///< from east, counter-clockwise
  double speed_mps = 0.0;                                      ///< along the car, negative backward
  double lateral_speed_mps = 0.0;                              ///< to the left
  double yaw_rate_radps = 0.0;                                 ///< counter-clockwise seen from above
};

/// Tests the numbers of an initial condition.
/// @param initial the initial condition
/// @return true if all are finite; the height hint may be NaN
bool IsFinite(const InitialCondition& initial);
/// Makes the initial condition that continues the motion of a car of another model or of a recording.
/// @param state state of that car
/// @return the initial condition
InitialCondition FromState(const VehicleState& state);

/// Fixed lengths and mass of a car, for pictures, drivers and collisions.
struct VehicleDimensions {
  double wheelbase_m = 0.0;               ///< between the axles
  double track_front_m = 0.0;             ///< between the middles of the front wheels
  double track_rear_m = 0.0;              ///< between the middles of the rear wheels
  double wheel_radius_m = 0.0;            ///< unloaded
  double wheel_width_m = 0.0;             ///< width of a tyre
  double front_m = 0.0;                   ///< from B's origin to the front bumper
  double rear_m = 0.0;                    ///< from B's origin to the rear bumper
  double width_m = 0.0;                   ///< without mirrors
  double height_m = 0.0;                  ///< from the road to the roof
  double mass_kg = 0.0;                   ///< mass of the car
  double steering_ratio = 1.0;            ///< angle of the steering wheel divided by that of the front wheels
  double steering_wheel_limit_rad = 0.0;  ///< stop of the steering wheel, to each side
  int forward_gears = 0;                  ///< number of forward gears
};

/// A force from outside on the body (a collision), and its moment about B's origin. Both are expressed in W.
struct Wrench {
  Eigen::Vector3d force_W = Eigen::Vector3d::Zero();      ///< force, in N
  Eigen::Vector3d moment_WB_W = Eigen::Vector3d::Zero();  ///< moment about B's origin, in N m

  /// Says whether force or moment differ from zero.
  /// @return true if one does
  bool any() const { return !force_W.isZero(0.0) || !moment_WB_W.isZero(0.0); }
};

/// The longest step of a model (VehicleModel::Step).
inline constexpr double kMaxStep_s = 0.1;

/// One vehicle: a value that is advanced step by step (law L3). Save and Restore hold everything that later steps
/// depend on, and the same calls give the same bits. One thread at a time calls an object; a process holds several.
class VehicleModel {
 public:
  virtual ~VehicleModel() = default;

  /// Places the car in equilibrium on the ground (INI). The engine idles, or turns with the wheels in a gear that suits
  /// the speed; counters are zero. It may query the ground several times.
  /// @param initial position and motion
  /// @param ground the ground
  /// @return wrong input if a wheel would stand outside of the world or a number is not finite; the model is then
  ///   unchanged
  virtual base::Status Initialise(const InitialCondition& initial, ground::Ground& ground) = 0;

  /// Advances the model (CALCULO) with constant controls. It queries the ground exactly once, with one batch for four
  /// wheels (law L4). A wheel outside of the world keeps its last plane.
  /// @param controls the controls; any values, see Clamp
  /// @param ground the ground
  /// @param dt_s length of the step, over 0, at most kMaxStep_s
  virtual void Step(const Controls& controls, ground::Ground& ground, double dt_s) = 0;

  /// Sets the force from outside on the body during the next Step. A second call replaces the first. The step consumes
  /// it, so it is no part of the state. A model that cannot be pushed ignores it.
  /// @param push force and moment
  virtual void SetPush([[maybe_unused]] const Wrench& push) {}
  /// Says whether the model uses SetPush.
  /// @return true if it does
  virtual bool can_be_pushed() const { return false; }

  /// Sets the pressures of the tyres from the next step on. They are no part of the state: after Restore the caller
  /// sets them again. A model without tyres ignores them.
  /// @param shares of each tyre: of the pressure that the vehicle file is for, 0 (flat) to 1.5
  virtual void SetTyrePressures([[maybe_unused]] const std::array<double, kWheels>& shares) {}
  /// Says whether the model uses SetTyrePressures.
  /// @return true if it does
  virtual bool has_tyre_pressures() const { return false; }

  /// Gives the state after the last Step or Initialise.
  /// @return the state; the reference stays valid as long as the model
  virtual const VehicleState& state() const = 0;
  /// Gives the dimensions, which never change.
  /// @return the dimensions; the reference stays valid as long as the model
  virtual const VehicleDimensions& dimensions() const = 0;

  /// Writes the whole state.
  /// @param writer receives the fields, always in the same order
  virtual void Save(base::StateWriter& writer) const = 0;
  /// Reads the state of Save into a model of the same vehicle file. Errors stay in the reader
  /// (base::StateReader::Finish), which the caller tests.
  /// @param reader the fields of Save, in the same order
  virtual void Restore(base::StateReader& reader) = 0;
  /// Says whether the state can be read out. If not, Save writes the known part, Restore is never called, and a run
  /// with this car is computed again from its first step only.
  /// @return true if Save writes the whole state
  virtual bool can_save() const { return true; }
  /// Names the additional outputs that the vehicle file requests (`outputs`: forces within a mechanism).
  /// @return names with their units
  virtual std::vector<std::string> output_names() const { return {}; }
  /// Gives the additional outputs.
  /// @return the values after the last step, in the order of output_names
  virtual std::vector<double> Outputs() const { return {}; }
  /// Says whether the model has joints (FindJointForces).
  /// @return true if it does
  virtual bool has_joint_forces() const { return false; }
  /// Finds the forces inside the car after the last step. It changes no state.
  /// @return the forces; empty without joints
  virtual JointForces FindJointForces() { return {}; }
  /// Explains a failed step: the car stays at its position. The run ends with this error.
  /// @return an error if the model failed in the last Step
  virtual base::Status problem() const { return {}; }
};

/// A kind of model that a vehicle file may name, and the functions that make one from the mapping of the file.
struct ModelKind {
  std::string name;  ///< value of the key `model`
  /// Makes a model. Problems of the file stay in its collection (config::File); with problems it may return anything,
  /// also null.
  std::function<std::unique_ptr<VehicleModel>(const config::Map& root)> make;
  /// Finishes a model of a file without problems: work that needs correct numbers, and keys that depend on it. May be
  /// null.
  std::function<base::Status(VehicleModel& model, const config::Map& root)> complete = nullptr;
};

/// Reads a vehicle file (`rodeira: vehicle/1`, `model: bicycle`).
/// @param path path of the file
/// @param wanted model to make if it is not the file's own; the file names the file of that model, `models: {ode:
/// FILE}`
/// @param more kinds of models beyond those of Rodeira
/// @return the model; wrong input with file:line if the file cannot be read, or a key is unknown or out of range. For
/// an
///   unknown name of a model the message gives the nearest one.
base::Result<std::unique_ptr<VehicleModel>> LoadVehicle(const std::filesystem::path& path, std::string_view wanted = {},
                                                        std::span<const ModelKind> more = {});

}  // namespace rodeira::dynamics
