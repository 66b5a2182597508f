// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>

#include "common/view/scene/mesh/mesh.hpp"
#include "common/view/scene/raster/dial.hpp"

// What lies before the driver: dashboard, instruments, steering wheel. Frame E: origin in the driver's eye, axes of
// the car's body (x forward, y left, z up).
namespace rodeira::scene {

// A flat thing that faces the driver. Its own frame: x to the driver's right, y up, z towards the driver.
struct CabinPose {
  Eigen::Vector3d middle_E = Eigen::Vector3d::Zero();
  double leaning_rad = 0.0;  // its upper edge away from the driver
  // A place of the thing, in E.
  Eigen::Vector3d ToE(const Eigen::Vector3d& p) const;
};

// An instrument on the dashboard.
struct CabinDial {
  Dial dial;
  CabinPose place;
  double radius_m = 0.0;
};
// The tank is full when a car begins; what is left of it is shown.
inline constexpr double kTank_l = 50.0;

// Speed, engine, fuel.
const std::array<CabinDial, 3>& CabinDials();
// The end of a dial's needle, in E.
Eigen::Vector3d NeedleEnd_E(const CabinDial& dial, double value);
// Of the gear's sign, and how high it is.
CabinPose GearPlace();
inline constexpr double kGearHeight_m = 0.032;

// Of the steering wheel's middle.
CabinPose WheelPlace();
inline constexpr double kWheelRadius_m = 0.185;
// The rim with its white mark, in the wheel's frame with the mark up; turning left is counter-clockwise.
Mesh BuildSteeringWheel();
// Where its mark is at an angle of the wheel (positive to the left), in E.
Eigen::Vector3d WheelMark_E(double steering_wheel_rad);

// The dashboard with the instruments' housing, in E, for a car of that width with the eye so far left of its middle.
Mesh BuildDashboard(double car_width_m, double eye_left_m);

}  // namespace rodeira::scene
