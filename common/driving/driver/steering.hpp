// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace rodeira::driver {

// How far ahead the driver aims, and how the wheel is turned.
struct SteeringSettings {
  double preview_s = 0.9;               // the target lies this far ahead in time …
  double preview_least_m = 4.5;         // … at least this far …
  double preview_most_m = 30.0;         // … and at most
  double understeer_radps2pm = 0.0022;  // more front wheel angle a lateral acceleration: the car's understeer gradient
  double rate_radps = 9.0;              // how fast hands turn the steering wheel
  double smoothing_s = 0.06;
};

// Along the way, m.
double PreviewDistance(const SteeringSettings& settings, double speed_mps);

// Pure pursuit (Coulter, CMU-RI-TR-92-01): the front wheel angle with a circle that leads the middle of the rear axle,
// tangent to the car, through the target: delta = atan(2 L sin(alpha) / distance), and what understeer takes on top.
// Positive left.
double PursuitAngle(const SteeringSettings& settings, const Eigen::Vector2d& rear_axle_W, double heading_rad,
                    const Eigen::Vector2d& target_W, double wheelbase_m, double speed_mps);

}  // namespace rodeira::driver
