#include "common/traffic/hands.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::traffic {
namespace {

constexpr double kRate_radps = 12.0;  // of the hands
constexpr double kSmoothing_s = 0.04;
constexpr double kPreview_s = 0.7, kPreviewLeast_m = 3.0;
constexpr double kAnswer_s = 0.6, kAnswerLeast_m = 2.0;

}  // namespace

double SteeredWay_m(double speed_mps) { return std::max(kPreviewLeast_m, kPreview_s * speed_mps); }

double AnsweredWay_m(double speed_mps) { return std::max(kAnswerLeast_m, kAnswer_s * speed_mps); }

// The curvature that the rear axle is to follow: the path's, and what leads back to it. The path is kept by the middle between both axles' tracks: in a bend
// the rear one runs L² κ / 4 inside, the front one as much outside.
double MovedWheel_rad(const vehicle::BicycleSettings& car, const RearBeside& rear, double now_rad, double dt_s) {
  const double wheelbase = car.body.wheelbase_m;
  const double aside = rear.aside_m - 0.25 * wheelbase * wheelbase * rear.curvature_1pm;
  const double way = SteeredWay_m(rear.speed_mps);
  const double curvature = rear.curvature_1pm - 2.0 * rear.turned_rad / way - aside / (way * way);
  const double wanted = std::clamp(std::atan(wheelbase * curvature) * car.steering.ratio, -car.steering.limit_rad, car.steering.limit_rad);
  const double move = (wanted - now_rad) * dt_s / (kSmoothing_s + dt_s), most = kRate_radps * dt_s;
  return now_rad + std::clamp(move, -most, most);
}

}  // namespace rodeira::traffic
