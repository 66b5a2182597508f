// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/motion/hands.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::traffic {
namespace {

constexpr double kRate_radps = 12.0;  // of the hands
constexpr double kSmoothing_s = 0.04;
constexpr double kPreview_s = 0.7, kPreviewLeast_m = 3.0;
constexpr double kAnswer_s = 0.6, kAnswerLeast_m = 2.0;

}  // namespace

double RearLine_m(double wheelbase_m, double length_m, double turns_rad) {
  return 0.25 * wheelbase_m * wheelbase_m * turns_rad / length_m;
}

double SteeredWay_m(double wheelbase_m, double speed_mps) {
  return std::max({kPreviewLeast_m, wheelbase_m, kPreview_s * speed_mps});
}

double AnsweredWay_m(double speed_mps) { return std::max(kAnswerLeast_m, kAnswer_s * speed_mps); }

// The curvature that the rear axle is to follow: the path's, and what leads back to its line.
double MovedWheel_rad(const dynamics::BicycleSettings& car, const RearBeside& rear, double now_rad, double dt_s) {
  const double wheelbase = car.body.wheelbase_m, way = SteeredWay_m(wheelbase, rear.speed_mps);
  const double curvature = rear.curvature_1pm - 2.0 * rear.turned_rad / way - rear.aside_m / (way * way);
  const double wanted = std::clamp(std::atan(wheelbase * curvature) * car.steering.ratio, -car.steering.limit_rad,
                                   car.steering.limit_rad);
  const double move = (wanted - now_rad) * dt_s / (kSmoothing_s + dt_s), most = kRate_radps * dt_s;
  return now_rad + std::clamp(move, -most, most);
}

}  // namespace rodeira::traffic
