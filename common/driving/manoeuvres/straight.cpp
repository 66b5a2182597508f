// SPDX-License-Identifier: Apache-2.0
// Manoeuvres along a straight line.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/core/base/constants.hpp"
#include "common/driving/manoeuvres/manoeuvre.hpp"
#include "common/driving/manoeuvres/trial.hpp"

namespace rodeira::manoeuvres {
namespace {

using dynamics::Controls;

constexpr double kHundred_mps = 100.0 / 3.6;

// When a quantity that begins at 0 passes a value, between the last step and this one.
class Passing {
 public:
  explicit Passing(double value) : value_(value) {}
  void See(double time_s, double quantity) {
    if (!passed_ && quantity >= value_) {
      passed_ = true;
      at_s_ = last_time_s_ + (time_s - last_time_s_) * (value_ - last_) / (quantity - last_);
    }
    last_ = quantity;
    last_time_s_ = time_s;
  }
  bool passed() const { return passed_; }
  double at_s() const { return at_s_; }

 private:
  double value_;
  double last_ = 0.0, last_time_s_ = 0.0, at_s_ = 0.0;
  bool passed_ = false;
};

// The fastest speed so far, and whether more is to come. Largest speeds of windows of time tell how the gains shrink;
// where they shrink by the same factor from window to window, the rest is a geometric series.
class TopSpeedSearch {
 public:
  void See(double time_s, double speed_mps, int gear) {
    if (gear != gear_) Restart(time_s, gear);
    window_mps_ = std::max(window_mps_, speed_mps);
    if (time_s - window_at_s_ < kWindow_s) return;
    const double gain_mps = window_mps_ - fastest_mps_;
    fastest_mps_ = std::max(fastest_mps_, window_mps_);
    window_mps_ = 0.0;
    window_at_s_ = time_s;
    ++windows_;
    const double before_mps = gain_mps_;
    gain_mps_ = gain_mps;
    if (windows_ < 3) return;
    const bool stands_still = gain_mps <= kNothing_mps && before_mps <= kNothing_mps;
    const bool shrinks = gain_mps > 0.0 && gain_mps < before_mps && gain_mps < kSlow_mps;
    reached_ = stands_still || (shrinks && gain_mps * gain_mps / (before_mps - gain_mps) < kRest_mps);
  }
  bool reached() const { return reached_; }
  double fastest_mps() const { return std::max(fastest_mps_, window_mps_); }

 private:
  static constexpr double kWindow_s = 2.0, kNothing_mps = 1e-5, kSlow_mps = 0.02, kRest_mps = 0.002 / 3.6;

  void Restart(double time_s, int gear) {
    gear_ = gear;
    windows_ = 0;
    window_at_s_ = time_s;
  }

  int gear_ = 0;
  int windows_ = 0;  // whole ones in this gear
  double window_at_s_ = 0.0, window_mps_ = 0.0;
  double fastest_mps_ = 0.0, gain_mps_ = 0.0;
  bool reached_ = false;
};

// Hands that hold the car in its lane of a straight road, by place, heading and yaw rate; they turn by 10 rad/s at
// most.
class LaneHands {
 public:
  void Turn(const Trial& t, Controls& controls) {
    constexpr double kFastest_radps = 10.0, kEarly_s = 2.0, kPerMetre = 0.15, kPerRadps = 0.25;
    const dynamics::VehicleState& s = t.state();
    const double wheels_rad = -(kPerMetre * s.p_WB_W.y() + s.heading_rad() + kPerRadps * s.w_WB_B.z());
    const double limit_rad = t.dimensions().steering_wheel_limit_rad, most_rad = kFastest_radps * t.step_s();
    const double wanted_rad = std::clamp(wheels_rad * t.dimensions().steering_ratio, -limit_rad, limit_rad);
    angle_rad_ += std::clamp(wanted_rad - angle_rad_, -most_rad, most_rad);
    controls.steering_wheel_rad = angle_rad_;
    largest_rad_ = std::max(largest_rad_, std::fabs(angle_rad_));
    if (t.time_s() < kEarly_s) early_rad_ = largest_rad_;
  }
  double early_rad() const { return early_rad_; }
  double largest_rad() const { return largest_rad_; }

 private:
  double angle_rad_ = 0.0, early_rad_ = 0.0, largest_rad_ = 0.0;
};

// `hands`: null where the steering is held straight.
base::Result<Outcome> BrakeFrom(dynamics::VehicleModel& car, const ProvingGroundSettings& ground, double speed_mps,
                                double step_s, LaneHands* hands = nullptr) {
  constexpr double kLongest_s = 120.0;
  auto trial = Trial::Begin(car, ground, speed_mps, step_s);
  if (!trial) return trial.error();
  Trial& t = trial.value();
  Controls controls;
  controls.brake = 1.0;
  constexpr double kRest_mps = 0.05, kTurned_rad = 1.5;
  const auto moves = [&t] { return t.state().v_WB_W.head<2>().norm() > kRest_mps; };
  double most_heading_rad = 0.0;
  while (moves() && most_heading_rad < kTurned_rad) {
    if (t.time_s() > kLongest_s)
      return base::Failed("scenario.manoeuvre_failed", "the car does not come to rest within two minutes");
    if (hands != nullptr) hands->Turn(t, controls);
    t.Step(controls);
    most_heading_rad = std::max(most_heading_rad, std::fabs(t.state().heading_rad()));
  }
  Outcome outcome{t.table(), {}};
  if (moves()) {
    outcome.missing.push_back(
        fmt::format("distance, time and mean deceleration: the car has turned by {:.0f} deg before it rests",
                    most_heading_rad * base::kDegreesPerRadian));
  } else {
    const double distance_m = t.state().p_WB_W.head<2>().norm();
    outcome.figures.push_back({"distance", distance_m, "m"});
    outcome.figures.push_back({"time", t.time_s(), "s"});
    outcome.figures.push_back({"mean deceleration", speed_mps * speed_mps / (2.0 * distance_m), "m/s²"});
  }
  outcome.figures.push_back({"drift to the left", t.state().p_WB_W.y(), "m"});
  outcome.figures.push_back({"largest yaw", most_heading_rad * base::kDegreesPerRadian, "deg"});
  return outcome;
}

}  // namespace

base::Result<Outcome> Acceleration(dynamics::VehicleModel& car, double step_s) {
  constexpr double kLongest_s = 600.0;
  auto trial = Trial::Begin(car, {}, 0.0, step_s);
  if (!trial) return trial.error();
  Trial& t = trial.value();
  Controls controls;
  controls.throttle = 1.0;
  Passing hundred(kHundred_mps), quarter(400.0);
  TopSpeedSearch top;
  while (t.time_s() < kLongest_s && !top.reached()) {
    t.Step(controls);
    hundred.See(t.time_s(), t.state().speed_mps());
    quarter.See(t.time_s(), t.state().p_WB_W.x());
    top.See(t.time_s(), t.state().speed_mps(), t.state().gear);
  }
  Outcome outcome{t.table(), {}};
  const double top_kmh = top.fastest_mps() * 3.6;
  if (hundred.passed())
    outcome.figures.push_back({"0 to 100 km/h", hundred.at_s(), "s"});
  else
    outcome.missing.push_back(fmt::format("0 to 100 km/h: the car reaches {:.1f} km/h", top_kmh));
  if (quarter.passed())
    outcome.figures.push_back({"0 to 400 m", quarter.at_s(), "s"});
  else
    outcome.missing.push_back(fmt::format("0 to 400 m: the car comes {:.0f} m far", t.state().p_WB_W.x()));
  if (top.reached())
    outcome.figures.push_back({"top speed", top_kmh, "km/h"});
  else
    outcome.missing.push_back(fmt::format("top speed: the car still gains speed after {:.0f} s", t.time_s()));
  if (top.fastest_mps() < 1.0) return base::Failed("scenario.manoeuvre_failed", "the car does not get going");
  return outcome;
}

base::Result<Outcome> Braking(dynamics::VehicleModel& car, double step_s) {
  return BrakeFrom(car, {}, kHundred_mps, step_s);
}

base::Result<Outcome> SplitFriction(dynamics::VehicleModel& car, double step_s) {
  ProvingGroundSettings ground;
  ground.friction_right = 0.3;
  return BrakeFrom(car, ground, 80.0 / 3.6, step_s);
}

base::Result<Outcome> SplitSteered(dynamics::VehicleModel& car, double step_s) {
  ProvingGroundSettings ground;
  ground.friction_right = 0.3;
  LaneHands hands;
  auto outcome = BrakeFrom(car, ground, 50.0 / 3.6, step_s, &hands);
  if (!outcome) return outcome;
  outcome.value().figures.push_back({"steering in the first 2 s", hands.early_rad() * base::kDegreesPerRadian, "deg"});
  outcome.value().figures.push_back({"largest steering", hands.largest_rad() * base::kDegreesPerRadian, "deg"});
  return outcome;
}

base::Result<Outcome> Park(dynamics::VehicleModel& car, double step_s) {
  ProvingGroundSettings ground;
  ground.slope = 0.2;
  auto trial = Trial::Begin(car, ground, 0.0, step_s);
  if (!trial) return trial.error();
  Trial& t = trial.value();
  Controls controls;
  controls.gearbox = dynamics::GearboxMode::kManual;
  controls.gear = 0;
  controls.handbrake = 1.0;
  while (t.time_s() < 5.0) t.Step(controls);  // it settles on its springs first
  const Eigen::Vector3d settled_W = t.state().p_WB_W;
  while (t.time_s() < 65.0) t.Step(controls);
  Outcome outcome{t.table(), {}};
  outcome.figures.push_back({"creep", (t.state().p_WB_W - settled_W).norm() * 1e3, "mm in a minute"});
  return outcome;
}

base::Result<Outcome> Bump(dynamics::VehicleModel& car, double step_s) {
  constexpr double kCalm_mps2 = 0.2, kSpeed_mps = 40.0 / 3.6, kFor_s = 6.0;
  ProvingGroundSettings ground;
  ground.bump_height_m = 0.05;
  ground.bump_length_m = 0.5;
  ground.bump_at_m = 15.0;
  auto trial = Trial::Begin(car, ground, kSpeed_mps, step_s);
  if (!trial) return trial.error();
  Trial& t = trial.value();
  SpeedHold foot;
  double up = 0.0, down = 0.0, most_N = 0.0, least_N = 1e12, moved_at_s = 0.0, reached_s = 0.0;
  while (t.time_s() < kFor_s) {
    Controls controls;
    foot.Press(kSpeed_mps, t, controls);
    t.Step(controls);
    const dynamics::VehicleState& s = t.state();
    if (s.p_WB_W.x() + 0.5 * t.dimensions().wheelbase_m < ground.bump_at_m) continue;
    if (reached_s == 0.0) reached_s = t.time_s();
    const double vertical = s.a_WB_W.z();
    up = std::max(up, vertical);
    down = std::max(down, -vertical);
    for (const auto& wheel : s.wheels) {
      most_N = std::max(most_N, wheel.load_N);
      least_N = std::min(least_N, wheel.load_N);
    }
    if (std::fabs(vertical) > kCalm_mps2) moved_at_s = t.time_s();
  }
  if (reached_s == 0.0) return base::Failed("scenario.manoeuvre_failed", "the car does not come to the bump");
  Outcome outcome{t.table(), {}};
  outcome.figures.push_back({"largest acceleration upward", up, "m/s²"});
  outcome.figures.push_back({"largest acceleration downward", down, "m/s²"});
  outcome.figures.push_back({"largest wheel load", most_N, "N"});
  outcome.figures.push_back({"smallest wheel load", least_N, "N"});
  outcome.figures.push_back({"calm again after", std::max(0.0, moved_at_s - reached_s), "s"});
  return outcome;
}

}  // namespace rodeira::manoeuvres
