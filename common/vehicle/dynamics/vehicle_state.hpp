// SPDX-License-Identifier: Apache-2.0
#pragma once

/// @file
/// The state that a vehicle model publishes.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>

#include "common/core/base/state.hpp"
#include "common/core/ground/ground.hpp"

/// Vehicle models: their interface, controls and published state.
///
/// Frames: W world (x east, y north, z up); B body, ISO 8855 (x forward, y left, z up). B's origin is fixed to the
/// body: in the plane of symmetry, midway between the axles, at the height of the road when the car stands at rest on a
/// level plane. So a car at rest on z = 0 has p_WB_W.z = 0, and a visual body around B stays right with another model.
/// Quantities of motion belong to B's origin. `v_WB_W` is the velocity of B relative to W, expressed in W.
namespace rodeira::dynamics {

/// The order of wheels everywhere.
enum WheelIndex : std::size_t {
  kFrontLeft = 0,   ///< front axle, left
  kFrontRight = 1,  ///< front axle, right
  kRearLeft = 2,    ///< rear axle, left
  kRearRight = 3,   ///< rear axle, right
};
inline constexpr std::size_t kWheels = 4;  ///< number of wheels
/// Gives the axle of a wheel.
/// @param wheel index of the wheel (WheelIndex)
/// @return 0: the front axle; 1: the rear axle
inline std::size_t AxleOf(std::size_t wheel) { return wheel / 2; }

/// State of one wheel. The tyre's forces act on the car and are expressed in the contact frame: x along the wheel, y to
/// its left, z along the ground's normal.
struct WheelState {
  Eigen::Vector3d hub_B = Eigen::Vector3d::Zero();  ///< centre of the wheel in B, in m
  double steer_rad = 0.0;                           ///< steer angle about B's z, positive to the left
  double spin_rad = 0.0;         ///< angle turned about the axle in (-pi, pi], positive rolling forward
  double spin_radps = 0.0;       ///< angular speed about the axle, positive rolling forward
  double longitudinal_N = 0.0;   ///< tyre force along x of the contact frame
  double lateral_N = 0.0;        ///< tyre force along y of the contact frame
  double aligning_Nm = 0.0;      ///< tyre moment about z of the contact frame, positive to the left
  double load_N = 0.0;           ///< tyre force along z of the contact frame; 0: the wheel is in the air
  double slip = 0.0;             ///< kappa' of the transient tyre; 1: spinning, -1: locked
  double slip_angle_tan = 0.0;   ///< tan alpha' of the transient tyre = v_y / |v_x|; positive: force to the right
  double brake_torque_Nm = 0.0;  ///< torque of the brake at the wheel, at least 0
  double drive_torque_Nm = 0.0;  ///< torque of the drive shaft, positive forward
  double suspension_N = 0.0;     ///< spring, anti-roll bar and damper together, compression positive
  double damper_N = 0.0;         ///< the damper's part of suspension_N
  double travel_m = 0.0;         ///< suspension travel from its position at rest, compression positive
  Eigen::Vector3d contact_W = Eigen::Vector3d::Zero();          ///< point of the ground under the wheel in W, in m
  Eigen::Vector3d contact_normal_W = Eigen::Vector3d::UnitZ();  ///< normal of the ground, of unit length, upward
  double friction = 0.0;                                        ///< friction of that ground, 1: dry asphalt
  ground::Surface surface = ground::Surface::kOutside;          ///< material of that ground

  /// Writes all values.
  /// @param writer receives the fields
  void Save(base::StateWriter& writer) const;
  /// Reads the values of Save.
  /// @param reader the fields
  void Restore(base::StateReader& reader);
};

/// State of a vehicle, the same for every model.
struct VehicleState {
  Eigen::Vector3d p_WB_W = Eigen::Vector3d::Zero();          ///< position of B's origin in W, in m
  Eigen::Quaterniond q_WB = Eigen::Quaterniond::Identity();  ///< attitude: turns vectors from B to W; unit length
  Eigen::Vector3d v_WB_W = Eigen::Vector3d::Zero();          ///< velocity in W, in m/s
  Eigen::Vector3d w_WB_B = Eigen::Vector3d::Zero();          ///< roll, pitch and yaw rate in B, in rad/s
  Eigen::Vector3d a_WB_W = Eigen::Vector3d::Zero();          ///< d v_WB_W / dt, mean over the last step; 0 at rest
  Eigen::Vector3d alpha_WB_B = Eigen::Vector3d::Zero();      ///< d w_WB_B / dt, mean over the last step

  std::array<WheelState, kWheels> wheels;  ///< in the order of WheelIndex

  double engine_speed_radps = 0.0;  ///< speed of the crankshaft
  double engine_torque_Nm = 0.0;    ///< at the flywheel, negative in overrun
  bool engine_running = false;      ///< false: stalled
  double clutch = 1.0;              ///< 0 engaged … 1 disengaged, by the driver or by the car
  double clutch_torque_Nm = 0.0;    ///< from the engine to the gearbox, either sign
  double clutch_slip_radps = 0.0;   ///< engine minus gearbox input; 0: locked
  double clutch_heat_W = 0.0;       ///< power that the slipping clutch dissipates
  std::int32_t gear = 0;            ///< engaged gear: -1 reverse, 0 neutral, 1 … n

  double throttle = 0.0;            ///< as applied to the engine (idle control and gear changes included), 0 … 1
  double brake = 0.0;               ///< pedal as given, 0 … 1
  double steering_wheel_rad = 0.0;  ///< angle of the steering wheel within its stops, positive to the left
  double steering_torque_Nm = 0.0;  ///< torque of the road on the steering wheel, positive to the left

  double fuel_rate_kgps = 0.0;  ///< fuel consumption per second
  double fuel_kg = 0.0;         ///< fuel burnt since Initialise
  double odometer_m = 0.0;      ///< distance driven since Initialise, never falling
  double drag_N = 0.0;          ///< drag of the air, at least 0
  bool inside_world = false;    ///< true: all four wheels are over known ground

  /// Gives the heading.
  /// @return angle of B's x axis in the horizontal plane, from east, counter-clockwise, in (-pi, pi]
  double heading_rad() const;
  /// Gives the pitch angle (ISO 8855).
  /// @return angle, positive nose down
  double pitch_rad() const;
  /// Gives the roll angle (ISO 8855).
  /// @return angle, positive with the left side up
  double roll_rad() const;
  /// Gives the velocity in B.
  /// @return forward, left and up, in m/s
  Eigen::Vector3d v_WB_B() const;
  /// Gives the acceleration a_WB_W, expressed in B.
  /// @return forward, left and up, in m/s²
  Eigen::Vector3d a_WB_B() const;
  /// Gives the speed along the car.
  /// @return v_WB_B().x(), negative in reverse
  double speed_mps() const;
  /// Gives the fuel consumption at this moment, also at rest; petrol of 745 kg/m³.
  /// @return litres per hour
  double fuel_l_per_h() const;
  /// Gives the fuel consumption per distance at this moment.
  /// @return litres per 100 km; 0 below walking speed (1 m/s), where it has no meaning
  double consumption_l_per_100km() const;
  /// Gives the mean fuel consumption since Initialise.
  /// @return litres per 100 km; 0 before the car has moved a metre
  double mean_consumption_l_per_100km() const;

  /// Writes all values.
  /// @param writer receives the fields
  void Save(base::StateWriter& writer) const;
  /// Reads the values of Save.
  /// @param reader the fields
  void Restore(base::StateReader& reader);
};

}  // namespace rodeira::dynamics
