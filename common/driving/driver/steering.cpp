// SPDX-License-Identifier: Apache-2.0
#include "common/driving/driver/steering.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::driver {

double PreviewDistance(const SteeringSettings& settings, double speed_mps) {
  return std::clamp(settings.preview_s * std::fabs(speed_mps), settings.preview_least_m, settings.preview_most_m);
}

double PursuitAngle(const SteeringSettings& settings, const Eigen::Vector2d& rear_axle_W, double heading_rad,
                    const Eigen::Vector2d& target_W, double wheelbase_m, double speed_mps) {
  constexpr double kNear_m = 0.5;
  const Eigen::Vector2d to = target_W - rear_axle_W;
  const double distance = std::max(kNear_m, to.norm());
  const double aside = std::cos(heading_rad) * to.y() - std::sin(heading_rad) * to.x();
  const double curvature = 2.0 * aside / (distance * distance);
  return std::atan(wheelbase_m * curvature) + settings.understeer_radps2pm * curvature * speed_mps * speed_mps;
}

}  // namespace rodeira::driver
