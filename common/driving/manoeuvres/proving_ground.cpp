// SPDX-License-Identifier: Apache-2.0
#include "common/driving/manoeuvres/proving_ground.hpp"

#include <cmath>

#include "common/core/geometry/angle.hpp"

namespace rodeira::manoeuvres {

void ProvingGround::Query(std::span<const ground::GroundQuery> queries, std::span<ground::GroundPoint> points) {
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const double x = queries[i].x_m;
    ground::GroundPoint& point = points[i];
    point = {};
    point.z_m = settings_.slope * x;
    double slope = settings_.slope;
    const double on = x - settings_.bump_at_m;
    if (on > 0.0 && on < settings_.bump_length_m) {
      const double number = 2.0 * geometry::kPi / settings_.bump_length_m;
      point.z_m += 0.5 * settings_.bump_height_m * (1.0 - std::cos(number * on));
      slope += 0.5 * settings_.bump_height_m * number * std::sin(number * on);
    }
    point.normal_W = Eigen::Vector3d(-slope, 0.0, 1.0).normalized();
    point.friction = queries[i].y_m > 0.0 ? settings_.friction_left : settings_.friction_right;
    point.surface = ground::Surface::kAsphalt;
    point.inside = true;
  }
}

}  // namespace rodeira::manoeuvres
