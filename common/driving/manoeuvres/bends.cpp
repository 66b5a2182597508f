// SPDX-License-Identifier: Apache-2.0
// Manoeuvres with the steering wheel. Angles of the front wheels are the steering wheel's over the steering ratio.
#include <algorithm>
#include <cmath>

#include "common/core/base/constants.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/driving/manoeuvres/manoeuvre.hpp"
#include "common/driving/manoeuvres/trial.hpp"

namespace rodeira::manoeuvres {
namespace {

using dynamics::Controls;

// Straight line through points, by least squares.
class Line {
 public:
  void Add(double x, double y) {
    ++count_;
    x_ += x;
    y_ += y;
    xx_ += x * x;
    xy_ += x * y;
  }
  bool IsKnown() const { return count_ > 10.0 && Spread() > 1e-12; }
  double Slope() const { return (count_ * xy_ - x_ * y_) / Spread(); }

 private:
  double Spread() const { return count_ * xx_ - x_ * x_; }

  double count_ = 0.0, x_ = 0.0, y_ = 0.0, xx_ = 0.0, xy_ = 0.0;
};

// How an answer follows A sin(ωt): by least squares over whole periods.
class Harmonic {
 public:
  void Add(double phase_rad, double answer) {
    sine_ += answer * std::sin(phase_rad);
    cosine_ += answer * std::cos(phase_rad);
    ++count_;
  }
  double amplitude() const { return 2.0 * std::hypot(sine_, cosine_) / count_; }
  double lag_rad() const { return -std::atan2(cosine_, sine_); }

 private:
  double sine_ = 0.0, cosine_ = 0.0, count_ = 0.0;
};

constexpr double kStraight_s = 0.5;  // before the steering wheel turns
constexpr double kTurn_s = 0.1;      // it takes that long

struct Steered {
  Trial trial;
  double yaw_rate_radps = 0.0;  // means of the last second
  double lateral_mps2 = 0.0;
  double most_yaw_rate_radps = 0.0;
  double peak_at_s = 0.0;    // from half of the turn on
  double ninety_at_s = 0.0;  // the lateral acceleration's 90 % of its end
};

// A step of the steering wheel to `wheel_rad`, to the left, at a held speed.
base::Result<Steered> Steer(dynamics::VehicleModel& car, double speed_mps, double wheel_rad, double for_s,
                            double step_s) {
  auto begun = Trial::Begin(car, {}, speed_mps, step_s);
  if (!begun) return begun.error();
  Steered steered{std::move(begun).value()};
  Trial& t = steered.trial;
  SpeedHold foot;
  std::vector<double> lateral;
  double count = 0.0;
  while (t.time_s() < for_s) {
    Controls controls;
    foot.Press(speed_mps, t, controls);
    controls.steering_wheel_rad = wheel_rad * std::clamp((t.time_s() - kStraight_s) / kTurn_s, 0.0, 1.0);
    t.Step(controls);
    const double yaw_rate = t.state().w_WB_B.z();
    lateral.push_back(t.state().speed_mps() * yaw_rate);
    if (yaw_rate > steered.most_yaw_rate_radps) {
      steered.most_yaw_rate_radps = yaw_rate;
      steered.peak_at_s = t.time_s() - kStraight_s - 0.5 * kTurn_s;
    }
    if (t.time_s() <= for_s - 1.0) continue;
    steered.yaw_rate_radps += yaw_rate;
    steered.lateral_mps2 += lateral.back();
    ++count;
  }
  steered.yaw_rate_radps /= count;
  steered.lateral_mps2 /= count;
  const auto ninety =
      std::find_if(lateral.begin(), lateral.end(), [&](double a) { return a >= 0.9 * steered.lateral_mps2; });
  steered.ninety_at_s = static_cast<double>(ninety - lateral.begin() + 1) * step_s - kStraight_s - 0.5 * kTurn_s;
  return steered;
}

// The angle of the steering wheel that ends at a lateral acceleration.
base::Result<double> AngleFor(dynamics::VehicleModel& car, double speed_mps, double lateral_mps2, double step_s) {
  constexpr int kMost = 8;
  double wheel_rad = 0.1;
  for (int i = 0; i < kMost; ++i) {
    const auto steered = Steer(car, speed_mps, wheel_rad, 5.0, step_s);
    if (!steered) return steered.error();
    const double reached = steered.value().lateral_mps2;
    if (!(reached > 0.05))
      return base::Failed("scenario.manoeuvre_failed", "the car does not turn with the steering wheel");
    if (std::fabs(reached - lateral_mps2) < 0.002 * lateral_mps2) return wheel_rad;
    wheel_rad *= std::clamp(lateral_mps2 / reached, 0.3, 3.0);
    if (wheel_rad > car.dimensions().steering_wheel_limit_rad) break;
  }
  return base::Failed("scenario.manoeuvre_failed",
                      "no angle of the steering wheel leads to the wanted lateral acceleration");
}

}  // namespace

base::Result<Outcome> ConstantRadius(dynamics::VehicleModel& car, double step_s) {
  constexpr double kRadius_m = 40.0, kFirst_mps = 5.0, kFaster_mps2 = 0.15, kLost_m = 2.0, kLow_mps2 = 1.0,
                   kHigh_mps2 = 4.0;
  auto begun = Trial::Begin(car, {}, kFirst_mps, step_s);
  if (!begun) return begun.error();
  Trial& t = begun.value();
  SpeedHold foot;
  Line steer, roll;
  double integral = 0.0, most = 0.0, last_off_m = 0.0;
  double wanted_mps = kFirst_mps;
  while (true) {
    const dynamics::VehicleState& s = t.state();
    // How far outside of the circle about (0, radius). A car answers as off'' = -V²/L (angle - L/R): two rad/s, well
    // damped.
    const double off_m = std::hypot(s.p_WB_W.x(), s.p_WB_W.y() - kRadius_m) - kRadius_m;
    const double rate_mps = t.time_s() > 0.0 ? (off_m - last_off_m) / step_s : 0.0;
    last_off_m = off_m;
    if (std::fabs(off_m) > kLost_m || wanted_mps - s.speed_mps() > 1.5) break;
    const double speed = std::max(s.speed_mps(), 1.0);
    const double give = t.dimensions().wheelbase_m / (speed * speed);
    integral += 1.0 * give * off_m * step_s;
    const double angle =
        std::atan(t.dimensions().wheelbase_m / kRadius_m) + 4.0 * give * off_m + 3.2 * give * rate_mps + integral;
    Controls controls;
    controls.steering_wheel_rad = angle * t.dimensions().steering_ratio;
    if (t.time_s() > 10.0) wanted_mps += kFaster_mps2 * step_s;  // first it settles on the circle
    foot.Press(wanted_mps, t, controls);
    t.Step(controls);
    const double lateral = s.speed_mps() * s.w_WB_B.z();
    if (t.time_s() <= 10.0) continue;
    most = std::max(most, s.speed_mps() * s.speed_mps() / (kRadius_m + off_m));
    if (lateral < kLow_mps2 || lateral > kHigh_mps2) continue;
    steer.Add(lateral, s.steering_wheel_rad / t.dimensions().steering_ratio);
    roll.Add(lateral, s.roll_rad());
  }
  if (!steer.IsKnown())
    return base::Failed("scenario.manoeuvre_failed", "the car does not stay on the circle up to 1 m/s²");
  Outcome outcome{t.table(), {}};
  outcome.figures.push_back(
      {"understeer gradient", steer.Slope() * base::kDegreesPerRadian * base::kGravity_mps2, "deg/g"});
  outcome.figures.push_back({"roll gradient", roll.Slope() * base::kDegreesPerRadian * base::kGravity_mps2, "deg/g"});
  outcome.figures.push_back({"largest lateral acceleration", most, "m/s²"});
  return outcome;
}

base::Result<Outcome> StepSteer(dynamics::VehicleModel& car, double step_s) {
  constexpr double kSpeed_mps = 100.0 / 3.6, kLateral_mps2 = 4.0;
  const auto angle = AngleFor(car, kSpeed_mps, kLateral_mps2, step_s);
  if (!angle) return angle.error();
  const auto steered = Steer(car, kSpeed_mps, angle.value(), 6.0, step_s);
  if (!steered) return steered.error();
  const Steered& s = steered.value();
  Outcome outcome{s.trial.table(), {}};
  outcome.figures.push_back({"steering wheel", angle.value() * base::kDegreesPerRadian, "deg"});
  outcome.figures.push_back({"yaw rate gain", s.yaw_rate_radps / angle.value(), "1/s"});
  outcome.figures.push_back({"yaw rate overshoot", (s.most_yaw_rate_radps / s.yaw_rate_radps - 1.0) * 100.0, "%"});
  outcome.figures.push_back({"yaw rate peak after", s.peak_at_s, "s"});
  outcome.figures.push_back({"90 % of lateral acceleration after", s.ninety_at_s, "s"});
  return outcome;
}

base::Result<Outcome> Sine(dynamics::VehicleModel& car, double step_s) {
  constexpr double kSpeed_mps = 80.0 / 3.6, kFrequency_Hz = 0.5, kLateral_mps2 = 2.0;
  constexpr double kTurning_radps = 2.0 * geometry::kPi * kFrequency_Hz, kFrom_s = 2.0 / kFrequency_Hz,
                   kUntil_s = 8.0 / kFrequency_Hz;
  const auto angle = AngleFor(car, kSpeed_mps, kLateral_mps2, step_s);
  if (!angle) return angle.error();
  auto begun = Trial::Begin(car, {}, kSpeed_mps, step_s);
  if (!begun) return begun.error();
  Trial& t = begun.value();
  SpeedHold foot;
  Harmonic yaw, lateral;
  while (t.time_s() < kUntil_s - 0.5 * step_s) {
    Controls controls;
    foot.Press(kSpeed_mps, t, controls);
    controls.steering_wheel_rad = angle.value() * std::sin(kTurning_radps * t.time_s());
    t.Step(controls);
    if (t.time_s() <= kFrom_s + 0.5 * step_s) continue;
    yaw.Add(kTurning_radps * t.time_s(), t.state().w_WB_B.z());
    lateral.Add(kTurning_radps * t.time_s(), t.lateral_mps2());
  }
  Outcome outcome{t.table(), {}};
  outcome.figures.push_back({"steering wheel", angle.value() * base::kDegreesPerRadian, "deg"});
  outcome.figures.push_back({"yaw rate gain", yaw.amplitude() / angle.value(), "1/s"});
  outcome.figures.push_back({"yaw rate delay", yaw.lag_rad() / kTurning_radps * 1e3, "ms"});
  outcome.figures.push_back(
      {"lateral acceleration gain", lateral.amplitude() / angle.value() / base::kDegreesPerRadian, "m/s² per deg"});
  outcome.figures.push_back({"lateral acceleration delay", lateral.lag_rad() / kTurning_radps * 1e3, "ms"});
  return outcome;
}

}  // namespace rodeira::manoeuvres
