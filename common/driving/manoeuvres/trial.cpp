// SPDX-License-Identifier: Apache-2.0
#include "common/driving/manoeuvres/trial.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/constants.hpp"
#include "common/core/geometry/angle.hpp"

namespace rodeira::manoeuvres {
namespace {

constexpr double kEach_s = 0.01;

}  // namespace

Trial::Trial(dynamics::VehicleModel& car, const ProvingGroundSettings& ground, double step_s)
    : car_(&car), ground_(ground), step_s_(step_s) {
  table_.names = {
      "time_s",         "x_m",          "y_m",        "heading_deg", "speed_kmph", "acceleration_mps2",  "lateral_mps2",
      "yaw_rate_degps", "sideslip_deg", "roll_deg",   "pitch_deg",   "height_m",   "steering_wheel_deg", "throttle",
      "brake",          "gear",         "engine_rpm", "load_fl_N",   "load_fr_N",  "load_rl_N",          "load_rr_N"};
  for (const std::string& name : car.output_names()) table_.names.push_back(name);
}

base::Result<Trial> Trial::Begin(dynamics::VehicleModel& car, const ProvingGroundSettings& ground, double speed_mps,
                                 double step_s) {
  Trial trial(car, ground, step_s);
  dynamics::InitialCondition initial;
  initial.speed_mps = speed_mps;
  if (auto status = car.Initialise(initial, trial.ground_); !status) return status.error();
  trial.Write();
  return trial;
}

void Trial::Step(const dynamics::Controls& controls) {
  controls_ = controls;
  car_->Step(controls, ground_, step_s_);
  ++steps_;
  if (time_s() > (static_cast<double>(rows_) - 1e-6) * kEach_s) Write();
}

double Trial::lateral_mps2() const {
  const double heading = state().heading_rad();
  return -std::sin(heading) * state().a_WB_W.x() + std::cos(heading) * state().a_WB_W.y();
}

void Trial::Write() {
  ++rows_;
  const dynamics::VehicleState& s = state();
  const Eigen::Vector3d v_WB_B = s.v_WB_B();
  const double heading = s.heading_rad();
  const double along = std::cos(heading) * s.a_WB_W.x() + std::sin(heading) * s.a_WB_W.y();
  const double sideslip = std::fabs(v_WB_B.x()) > 0.5 ? std::atan2(v_WB_B.y(), std::fabs(v_WB_B.x())) : 0.0;
  for (const double value : {time_s(),
                             s.p_WB_W.x(),
                             s.p_WB_W.y(),
                             heading * base::kDegreesPerRadian,
                             s.speed_mps() * 3.6,
                             along,
                             lateral_mps2(),
                             s.w_WB_B.z() * base::kDegreesPerRadian,
                             sideslip * base::kDegreesPerRadian,
                             s.roll_rad() * base::kDegreesPerRadian,
                             s.pitch_rad() * base::kDegreesPerRadian,
                             s.p_WB_W.z(),
                             s.steering_wheel_rad * base::kDegreesPerRadian,
                             s.throttle,
                             s.brake,
                             static_cast<double>(s.gear),
                             s.engine_speed_radps * 30.0 / geometry::kPi,
                             s.wheels[0].load_N,
                             s.wheels[1].load_N,
                             s.wheels[2].load_N,
                             s.wheels[3].load_N}) {
    table_.values.push_back(value);
  }
  for (const double value : car_->Outputs()) table_.values.push_back(value);
}

void SpeedHold::Press(double wanted_mps, const Trial& trial, dynamics::Controls& controls) {
  constexpr double kProportional_spm = 0.35, kIntegral_pm = 0.12, kBrake = 0.3;
  const double error = wanted_mps - trial.state().speed_mps();
  const double unbound = kProportional_spm * error + integral_;
  // The integral stands still where the pedal is at its end.
  if ((unbound > 0.0 || error > 0.0) && (unbound < 1.0 || error < 0.0))
    integral_ += kIntegral_pm * error * trial.step_s();
  controls.throttle = std::clamp(unbound, 0.0, 1.0);
  controls.brake = error < -0.5 ? std::clamp(-kBrake * (error + 0.5), 0.0, 1.0) : 0.0;
}

}  // namespace rodeira::manoeuvres
