// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "common/core/base/state.hpp"
#include "common/vehicle/dynamics/controls.hpp"

// The driver of MOTORS (Patras 2021, chapter 4 and appendix A.35 to A.90): its laws as its code has them, its constants
// of a frame taken at 50 Hz.
namespace rodeira::traffic {

inline constexpr double kCheckpoint_m = 0.3;  // between the points of a trajectory
inline constexpr double kReached_m = 0.1;     // a checkpoint is reached within this
inline constexpr double kMotorsLimit_mps = 17.0;

// s: how much the direction to the target counts beside that of the path, from the distance to the current checkpoint:
// (2/pi) atan(2 (d/2)²).
double TargetWeight(double distance_m);
// (to_path + s to_target)/(1 + s), within ±most; angles positive to the left.
double SteeringAngle(double to_path_rad, double to_target_rad, double weight, double most_rad);
// What may be driven where the look-ahead point lies at this angle: the limit up to 10 degrees, 12 m/s at 20, 5 m/s
// from 40 on, linear between.
double TurningSpeed_mps(double angle_rad, double limit_mps);
// Below the wanted speed: 0.5 · 2^(-0.0006 angle²), the angle to the path in degrees.
double MotorsThrottle(double to_path_rad);
// Above it: (2/pi) atan(excess in m/s), a tenth more to stop; at most 1.
double MotorsBrake(double excess_mps, bool stops);
// Whether two segments cross: the ends of each lie on both sides of the other.
bool SegmentsCross(const Eigen::Vector2d& a0, const Eigen::Vector2d& a1, const Eigen::Vector2d& b0,
                   const Eigen::Vector2d& b1);

// What a driver sees in one frame.
struct MotorsView {
  double speed_mps = 0.0;
  double to_path_rad = 0.0;    // from where the car points to where the path does
  double to_target_rad = 0.0;  // … and to the target
  double distance_m = 0.0;     // to the current checkpoint
  double turn_rad = 0.0;       // to the look-ahead point
  double limit_mps = kMotorsLimit_mps;
  bool stops = false;
  double engine_radps = 0.0;
  bool engine_runs = true;
};
// Of the driver's car.
struct MotorsCar {
  double most_steer_rad = 0.6, steering_ratio = 16.0;
  double stall_radps = 80.0;                       // below it the throttle is opened a little
  double bite_radps = 90.0, closed_radps = 150.0;  // by the clutch the engine is kept from stalling between these
  int gears = 5;
};

// One driver of MOTORS: steering, pedals and gears.
class MotorsDriver {
 public:
  // Drawn at random by the caller: responsiveness 0.5 to 1, aggression 3 to 4 degrees a frame.
  MotorsDriver(double responsiveness, double aggression_deg);
  MotorsDriver() : MotorsDriver(1.0, 3.5) {}

  // The car drives in this gear.
  void Begin(int gear);
  // Once a frame; positive steering is to the left.
  dynamics::Controls Step(const MotorsView& view, const MotorsCar& car, double dt_s);

  double steer_rad() const { return steer_rad_; }
  int gear() const { return gear_; }
  bool changes_gear() const { return changes_; }

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);

  // Where it is on its trajectory; for its driver.
  std::uint32_t track = 0;
  double zero_m = 0.0;      // of the track, in the odometer
  std::uint32_t lanes = 0;  // that it has come to on this trip
  std::uint32_t trip = 0;
  std::uint32_t checkpoint = 0;
  double weight = 0.5;                               // of the lane's left border against its right one
  Eigen::Vector2d join_W = Eigen::Vector2d::Zero();  // by which the trajectory's first control point is moved
  bool stops = false;

 private:
  void Shift(double engine_radps, int gears, double dt_s);

  double responsiveness_, aggression_radps_;
  double steer_rad_ = 0.0;
  std::int32_t gear_ = 1;
  bool changes_ = false;
  double change_ = 0.0;   // 0 … 1
  double pause_s_ = 0.0;  // until the next change
  double clutch_ = 0.0;
  bool throttle_let_ = true;
};

}  // namespace rodeira::traffic
