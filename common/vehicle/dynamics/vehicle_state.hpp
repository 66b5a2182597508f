// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>

#include "common/core/base/state.hpp"
#include "common/core/ground/ground.hpp"

// What a vehicle model publishes, whatever the model is. Frames: W world (x east, y north, z up); B body, ISO 8855
// (x forward, y left, z up). B's origin is fixed to the body: in the plane of symmetry, midway between the axles, at
// the height of the road when the car stands at rest on a level plane. So a car at rest on z = 0 has p_WB_W.z = 0, and
// a visual body drawn around B stays right when the model is exchanged. Quantities of motion belong to B's origin.
namespace rodeira::dynamics {

// The order of wheels everywhere.
enum WheelIndex : std::size_t { kFrontLeft = 0, kFrontRight = 1, kRearLeft = 2, kRearRight = 3 };
inline constexpr std::size_t kWheels = 4;
// 0: the front axle; 1: the rear axle.
inline std::size_t AxleOf(std::size_t wheel) { return wheel / 2; }

struct WheelState {
  Eigen::Vector3d hub_B = Eigen::Vector3d::Zero();  // centre of the wheel in the body frame
  double steer_rad = 0.0;                           // about B's z, positive to the left
  double spin_rad = 0.0;    // angle turned about the axle in (-pi, pi], positive rolling forward
  double spin_radps = 0.0;  // positive rolling forward
  // The tyre's forces on the car in its contact frame: x along the wheel, y to its left, z along the ground's normal.
  double longitudinal_N = 0.0;
  double lateral_N = 0.0;
  double load_N = 0.0;           // 0: the wheel is in the air
  double slip = 0.0;             // kappa' of the transient tyre, 1: spinning or (negative) locked
  double slip_angle_tan = 0.0;   // tan alpha' of the transient tyre = v_y / |v_x|; positive gives a force to the right
  double brake_torque_Nm = 0.0;  // what the brake applies at the wheel, at least 0
  double drive_torque_Nm = 0.0;  // what the drive shaft applies, positive forward
  double suspension_N = 0.0;     // spring, anti-roll bar and damper together, compression positive
  double damper_N = 0.0;         // the damper's part of it
  double travel_m = 0.0;         // of the suspension from its place at rest, compression positive
  Eigen::Vector3d contact_W = Eigen::Vector3d::Zero();          // point of the ground under the wheel
  Eigen::Vector3d contact_normal_W = Eigen::Vector3d::UnitZ();  // unit, upward
  double friction = 0.0;                                        // of that ground, 1: dry asphalt
  ground::Surface surface = ground::Surface::kOutside;

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);
};

struct VehicleState {
  // Pose and motion of B in W, expressed in W, except w_WB_B, which is expressed in B (roll, pitch, yaw rate).
  Eigen::Vector3d p_WB_W = Eigen::Vector3d::Zero();
  Eigen::Quaterniond q_WB = Eigen::Quaterniond::Identity();
  Eigen::Vector3d v_WB_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d w_WB_B = Eigen::Vector3d::Zero();
  Eigen::Vector3d a_WB_W = Eigen::Vector3d::Zero();      // d v_WB_W / dt, mean over the last step; 0 at rest
  Eigen::Vector3d alpha_WB_B = Eigen::Vector3d::Zero();  // d w_WB_B / dt, mean over the last step

  std::array<WheelState, kWheels> wheels;

  double engine_speed_radps = 0.0;
  double engine_torque_Nm = 0.0;   // at the flywheel, negative in overrun
  bool engine_running = false;     // false: stalled
  double clutch = 1.0;             // 0 engaged … 1 disengaged, whoever works it
  double clutch_torque_Nm = 0.0;   // from the engine to the gearbox, either sign
  double clutch_slip_radps = 0.0;  // engine minus gearbox input; 0 locked
  double clutch_heat_W = 0.0;      // what the slipping clutch dissipates
  std::int32_t gear = 0;           // engaged: -1 reverse, 0 neutral, 1 … n

  double throttle = 0.0;            // as applied to the engine (idle control and gear changes included)
  double brake = 0.0;               // pedal as given
  double steering_wheel_rad = 0.0;  // after its stops, positive to the left
  double steering_torque_Nm = 0.0;  // what the road gives back to the steering wheel, positive to the left

  double fuel_rate_kgps = 0.0;
  double fuel_kg = 0.0;       // burnt since Initialise
  double odometer_m = 0.0;    // distance driven since Initialise, never falling
  double drag_N = 0.0;        // of the air, at least 0
  bool inside_world = false;  // all four wheels over known ground

  double heading_rad() const;      // of B's x axis in the horizontal plane, from east, counter-clockwise, (-pi, pi]
  double pitch_rad() const;        // ISO 8855: positive nose down
  double roll_rad() const;         // ISO 8855: positive leaning to the right (left side up)
  Eigen::Vector3d v_WB_B() const;  // forward, left, up
  Eigen::Vector3d a_WB_B() const;
  double speed_mps() const;     // forward, negative in reverse: v_WB_B().x()
  double fuel_l_per_h() const;  // now, also at rest; petrol of 745 kg/m³
  // Litres for 100 km at this moment; 0 below walking speed (1 m/s), where it means nothing.
  double consumption_l_per_100km() const;
  // Litres for 100 km since Initialise; 0 before the car has moved a metre.
  double mean_consumption_l_per_100km() const;

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);
};

}  // namespace rodeira::dynamics
