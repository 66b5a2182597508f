// SPDX-License-Identifier: Apache-2.0
// The double lane change.
#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/base/constants.hpp"
#include "common/driving/driver/steering.hpp"
#include "common/driving/manoeuvres/manoeuvre.hpp"
#include "common/driving/manoeuvres/trial.hpp"

namespace rodeira::manoeuvres {
namespace {

using dynamics::Controls;

constexpr double kRunUp_m = 25.0, kOffset_m = 3.5;
// Ends of the sections, from the first one's beginning: entry, over, left lane, back, exit.
constexpr std::array<double, 5> kEnds_m = {15.0, 45.0, 70.0, 95.0, 125.0};

// 0 to 1 with no speed and no acceleration at both ends.
double Smooth(double u) {
  const double x = std::clamp(u, 0.0, 1.0);
  return x * x * x * (10.0 + x * (6.0 * x - 15.0));
}

// The line that the driver means to follow. It begins to turn within a lane and ends within the next, as far as their
// widths allow: 3.5 m over the 30 m between them would need more grip than there is.
double PathY(double x_m) {
  constexpr std::array<double, 2> kOver_m = {7.5, 52.5}, kBack_m = {62.5, 103.0};
  const double x = x_m - kRunUp_m;
  return kOffset_m *
         (Smooth((x - kOver_m[0]) / (kOver_m[1] - kOver_m[0])) - Smooth((x - kBack_m[0]) / (kBack_m[1] - kBack_m[0])));
}

// How far a point is outside of the lanes that its section has; negative inside, and where there is no lane.
double Outside(double x_m, double y_m, double car_width_m) {
  const double x = x_m - kRunUp_m;
  double middle = 0.0, width = 1.1 * car_width_m + 0.25;
  if (x >= kEnds_m[1] && x <= kEnds_m[2]) {
    middle = kOffset_m;
    width = 1.2 * car_width_m + 0.25;
  } else if (x >= kEnds_m[3] && x <= kEnds_m[4]) {
    width = 1.3 * car_width_m + 0.25;
  } else if (x < 0.0 || x > kEnds_m[0]) {
    return -1.0;
  }
  return std::fabs(y_m - middle) - 0.5 * width;
}

double WorstCorner(const dynamics::VehicleState& s, const dynamics::VehicleDimensions& d) {
  const double c = std::cos(s.heading_rad()), n = std::sin(s.heading_rad());
  double worst = -1.0;
  for (const double along : {d.front_m, -d.rear_m}) {
    for (const double aside : {0.5 * d.width_m, -0.5 * d.width_m}) {
      worst = std::max(worst,
                       Outside(s.p_WB_W.x() + c * along - n * aside, s.p_WB_W.y() + n * along + c * aside, d.width_m));
    }
  }
  return worst;
}

// The autopilot's way of steering, nearer to the car and from where the car will be when it answers the steering wheel.
double WheelAngle(const dynamics::VehicleState& s, const dynamics::VehicleDimensions& d) {
  constexpr double kAhead_s = 0.3, kAnswer_s = 0.15;
  driver::SteeringSettings settings;
  settings.preview_s = kAhead_s;
  const double heading = s.heading_rad() + kAnswer_s * s.w_WB_B.z();
  const Eigen::Vector2d rear_axle_W = s.p_WB_W.head<2>() + kAnswer_s * s.v_WB_W.head<2>() -
                                      0.5 * d.wheelbase_m * Eigen::Vector2d(std::cos(heading), std::sin(heading));
  const double target_x = rear_axle_W.x() + driver::PreviewDistance(settings, s.speed_mps());
  return driver::PursuitAngle(settings, rear_axle_W, heading, {target_x, PathY(target_x)}, d.wheelbase_m,
                              s.speed_mps()) *
         d.steering_ratio;
}

}  // namespace

base::Result<Outcome> LaneChange(dynamics::VehicleModel& car, double step_s) {
  constexpr double kSpeed_mps = 80.0 / 3.6, kHands_radps = 15.0, kLongest_s = 30.0;
  auto begun = Trial::Begin(car, {}, kSpeed_mps, step_s);
  if (!begun) return begun.error();
  Trial& t = begun.value();
  SpeedHold foot;
  double off_m = 0.0, lateral = 0.0, hands = 0.0, outside_m = -1.0, wheel_rad = 0.0;
  while (t.state().p_WB_W.x() < kRunUp_m + kEnds_m.back() + 30.0) {
    if (t.time_s() > kLongest_s || std::fabs(t.state().heading_rad()) > 1.5)
      return base::Failed("scenario.manoeuvre_failed", "the car is lost on its way through the lane change");
    Controls controls;
    foot.Press(kSpeed_mps, t, controls);
    const double before = wheel_rad;
    wheel_rad +=
        std::clamp(WheelAngle(t.state(), t.dimensions()) - wheel_rad, -kHands_radps * step_s, kHands_radps * step_s);
    hands = std::max(hands, std::fabs(wheel_rad - before) / step_s);
    controls.steering_wheel_rad = wheel_rad;
    t.Step(controls);
    off_m = std::max(off_m, std::fabs(t.state().p_WB_W.y() - PathY(t.state().p_WB_W.x())));
    lateral = std::max(lateral, std::fabs(t.lateral_mps2()));
    outside_m = std::max(outside_m, WorstCorner(t.state(), t.dimensions()));
  }
  Outcome outcome{t.table(), {}};
  outcome.figures.push_back({"largest distance from the line", off_m, "m"});
  outcome.figures.push_back({"room left to the cones", -outside_m, "m"});
  outcome.figures.push_back({"largest lateral acceleration", lateral, "m/s²"});
  outcome.figures.push_back({"fastest steering", hands * base::kDegreesPerRadian, "deg/s"});
  return outcome;
}

}  // namespace rodeira::manoeuvres
