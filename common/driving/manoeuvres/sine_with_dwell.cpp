// SPDX-License-Identifier: Apache-2.0
// The sine with dwell of UN R140, annex 3, and of FMVSS 126.
#include <algorithm>
#include <cmath>

#include "common/core/base/constants.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/driving/manoeuvres/manoeuvre.hpp"
#include "common/driving/manoeuvres/trial.hpp"

namespace rodeira::manoeuvres {
namespace {

using dynamics::Controls;

constexpr double kDwellSpeed_mps = 80.0 / 3.6;
constexpr double kPeriod_s = 1.0 / 0.7, kDwell_s = 0.5, kSteered_s = kPeriod_s + kDwell_s;

// The angle of the steering wheel, turned by 13.5 degrees a second, at which the car takes 0.3 g.
base::Result<double> SlowSteer(dynamics::VehicleModel& car, double step_s) {
  constexpr double kRate_radps = 13.5 / base::kDegreesPerRadian, kLateral_mps2 = 0.3 * base::kGravity_mps2;
  auto begun = Trial::Begin(car, {}, kDwellSpeed_mps, step_s);
  if (!begun) return begun.error();
  Trial& t = begun.value();
  SpeedHold foot;
  Controls controls;
  while (t.state().w_WB_B.z() * t.state().speed_mps() < kLateral_mps2) {
    if (controls.steering_wheel_rad > t.dimensions().steering_wheel_limit_rad)
      return base::Failed("scenario.manoeuvre_failed", "the car does not come to 0.3 g at 80 km/h");
    foot.Press(kDwellSpeed_mps, t, controls);
    controls.steering_wheel_rad += kRate_radps * step_s;
    t.Step(controls);
  }
  return controls.steering_wheel_rad;
}

// -1 … 1: one sine that waits at its second peak.
double Course(double time_s) {
  const double peak_s = 0.75 * kPeriod_s;
  const double in_sine_s = time_s < peak_s + kDwell_s ? std::min(time_s, peak_s) : time_s - kDwell_s;
  return in_sine_s < kPeriod_s ? std::sin(2.0 * geometry::kPi * in_sine_s / kPeriod_s) : 0.0;
}

}  // namespace

base::Result<Outcome> SineWithDwell(dynamics::VehicleModel& car, double step_s) {
  constexpr double kTimes = 6.5, kLeast_rad = 270.0 / base::kDegreesPerRadian,
                   kMost_rad = 300.0 / base::kDegreesPerRadian, kAside_s = 1.07, kFirst_s = 1.0, kSecond_s = 1.75;
  const auto slow = SlowSteer(car, step_s);
  if (!slow) return slow.error();
  const double amplitude_rad =
      std::min({std::max(kTimes * slow.value(), kLeast_rad), kMost_rad, car.dimensions().steering_wheel_limit_rad});
  auto begun = Trial::Begin(car, {}, kDwellSpeed_mps, step_s);
  if (!begun) return begun.error();
  Trial& t = begun.value();
  Controls controls;
  controls.gearbox = dynamics::GearboxMode::kManual;
  controls.gear = 0;
  double peak_radps = 0.0, aside_m = 0.0, first_radps = 0.0, second_radps = 0.0, sideslip_rad = 0.0;
  while (t.time_s() < kSteered_s + kSecond_s + 0.5 * step_s) {
    const double before_s = t.time_s();
    controls.steering_wheel_rad = amplitude_rad * Course(before_s + step_s);
    t.Step(controls);
    const double yaw_radps = t.state().w_WB_B.z();
    const auto passes = [&](double at_s) {
      return before_s < at_s - 0.5 * step_s && t.time_s() >= at_s - 0.5 * step_s;
    };
    if (t.time_s() > 0.5 * kPeriod_s && t.time_s() < kSteered_s) peak_radps = std::max(peak_radps, -yaw_radps);
    if (passes(kAside_s)) aside_m = t.state().p_WB_W.y();
    if (passes(kSteered_s + kFirst_s)) first_radps = std::fabs(yaw_radps);
    if (passes(kSteered_s + kSecond_s)) second_radps = std::fabs(yaw_radps);
    const Eigen::Vector3d v_WB_B = t.state().v_WB_B();
    sideslip_rad = std::max(sideslip_rad, std::fabs(std::atan2(v_WB_B.y(), v_WB_B.x())));
  }
  if (!(peak_radps > 0.0))
    return base::Failed("scenario.manoeuvre_failed", "the car does not turn to the right with the steering wheel");
  Outcome outcome{t.table(), {}};
  outcome.figures.push_back({"steering wheel at 0.3 g", slow.value() * base::kDegreesPerRadian, "deg"});
  outcome.figures.push_back({"steering wheel", amplitude_rad * base::kDegreesPerRadian, "deg"});
  outcome.figures.push_back({"yaw rate 1.00 s after the end", first_radps / peak_radps * 100.0, "% of its peak"});
  outcome.figures.push_back({"yaw rate 1.75 s after the end", second_radps / peak_radps * 100.0, "% of its peak"});
  outcome.figures.push_back({"aside 1.07 s after the beginning", aside_m, "m"});
  outcome.figures.push_back({"largest sideslip angle", sideslip_rad * base::kDegreesPerRadian, "deg"});
  return outcome;
}

}  // namespace rodeira::manoeuvres
