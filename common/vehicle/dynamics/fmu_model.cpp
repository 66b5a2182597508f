// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/fmu_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/core/base/assert.hpp"
#include "common/core/base/carried_state.hpp"
#include "common/core/base/suggest.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/vehicle/dynamics/enveloping.hpp"

namespace rodeira::dynamics {
namespace {

const std::string kStateField = std::string(base::kCarried) + "fmu";

Eigen::Quaterniond Attitude(double roll, double pitch, double heading) {
  return Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX());
}

}  // namespace

base::Status FmuModel::Build() {
  auto unit = fmi::Unit::Load(settings_.fmu);
  if (!unit) return unit.error();
  unit_ = std::move(unit).value();
  auto variables = FindVariables(unit_->description(), settings_.names, settings_.fmu.string());
  if (!variables) return variables.error();
  variables_ = std::move(variables).value();
  if (!unit_->note().empty()) variables_.notes.push_back(unit_->note());
  std::vector<std::string> known;
  for (const fmi::Variable& variable : unit_->description().variables) {
    if (variable.causality == "parameter") known.push_back(variable.name);
  }
  for (const auto& [name, value] : settings_.parameters) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const auto place = settings_.parameter_places.find(name);
    return base::WrongInput("fmu.unknown_parameter",
                            fmt::format("the FMU has no parameter '{}'{}", name, base::DidYouMean(name, known)),
                            place == settings_.parameter_places.end() ? settings_.fmu.string() : place->second);
  }
  return {};
}

Eigen::Vector3d FmuModel::HubAtRest_B(std::size_t wheel) const {
  const VehicleDimensions& d = settings_.dimensions;
  const double half_track = 0.5 * (wheel < kRearLeft ? d.track_front_m : d.track_rear_m);
  return {(wheel < kRearLeft ? 0.5 : -0.5) * d.wheelbase_m, wheel % 2 == 0 ? half_track : -half_track,
          d.wheel_radius_m};
}

void FmuModel::QueryGround(ground::Ground& ground) {
  WheelPlaces places;
  std::array<WheelGround*, kWheels> wheels{};
  for (std::size_t i = 0; i < kWheels; ++i) {
    const WheelState& wheel = state_.wheels[i];
    places.hubs_W[i] = state_.p_WB_W + state_.q_WB * wheel.hub_B;
    places.axles_W[i] = state_.q_WB * Eigen::Vector3d(-std::sin(wheel.steer_rad), std::cos(wheel.steer_rad), 0.0);
    wheels[i] = &wheels_[i];
  }
  dynamics::QueryGround(ground, settings_.enveloping, settings_.dimensions.wheel_radius_m, places, wheels);
}

base::Status FmuModel::Set(const FmuVariables::Variable& variable, double value) {
  return variable ? instance_->Set(*variable.own, variable.FromOurs(value)) : base::Status();
}

base::Result<double> FmuModel::Get(const FmuVariables::Variable& variable, double default_value) {
  if (!variable) return default_value;
  const auto value = instance_->Get(*variable.own);
  if (!value) return value.error();
  if (!std::isfinite(value.value())) {
    return base::Failed("fmu.wrong_output",
                        fmt::format("its output '{}' is not a finite number at {:.6g} s", variable.own->name, time_s_),
                        settings_.fmu.string());
  }
  return variable.ToOurs(value.value());
}

// An FMU of which a process may have one instance is set back, another one is made anew.
base::Status FmuModel::TakeFreshInstance() {
  if (instance_ && unit_->description().only_once) return instance_->Reset();
  auto made = unit_->Instantiate("vehicle");
  if (!made) return made.error();
  instance_ = std::move(made).value();
  return {};
}

base::Status FmuModel::SetGround() {
  for (std::size_t i = 0; i < kWheels; ++i) {
    const FmuVariables::Wheel& w = variables_.wheels[i];
    const WheelGround& g = wheels_[i];
    const std::pair<FmuVariables::Variable, double> values[] = {{w.ground_z, g.plane_W.z()},
                                                                {w.normal_x, g.normal_W.x()},
                                                                {w.normal_y, g.normal_W.y()},
                                                                {w.normal_z, g.normal_W.z()},
                                                                {w.friction, g.friction}};
    for (const auto& [variable, value] : values) {
      if (auto status = Set(variable, value); !status) return status;
    }
  }
  return {};
}

base::Status FmuModel::SetPushInputs() {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    if (auto status = Set(variables_.push_force[i], push_.force_W[k]); !status) return status;
    if (auto status = Set(variables_.push_moment[i], push_.moment_WB_W[k]); !status) return status;
  }
  return {};
}

base::Status FmuModel::SetControls(const Controls& c) {
  const FmuVariables& v = variables_;
  const double limit = settings_.dimensions.steering_wheel_limit_rad;
  const std::pair<FmuVariables::Variable, double> values[] = {
      {v.steering_wheel, std::clamp(c.steering_wheel_rad, -limit, limit)},
      {v.throttle, c.throttle},
      {v.brake, c.brake},
      {v.clutch, c.clutch},
      {v.handbrake, c.handbrake},
      {v.gear_lever, static_cast<double>(c.gear)},
      {v.automatic, c.gearbox == GearboxMode::kAutomatic ? 1.0 : 0.0},
      {v.starter, c.starter ? 1.0 : 0.0}};
  for (const auto& [variable, value] : values) {
    if (auto status = Set(variable, value); !status) return status;
  }
  return {};
}

// On the plane of the ground under the wheels; the FMU may settle from there as it likes.
base::Status FmuModel::SetStart(const InitialCondition& initial) {
  const FmuVariables& v = variables_;
  const auto refusal = [&](const char* name) {
    return base::WrongInput("fmu.missing_variable",
                            fmt::format("the FMU cannot begin in motion: it has no variable '{}'", name),
                            settings_.fmu.string());
  };
  if (!v.start_speed && initial.speed_mps != 0.0) return refusal("start_speed_mps");
  const std::pair<FmuVariables::Variable, double> values[] = {{v.start_x, initial.x_m},
                                                              {v.start_y, initial.y_m},
                                                              {v.start_z, state_.p_WB_W.z()},
                                                              {v.start_heading, initial.heading_rad},
                                                              {v.start_pitch, state_.pitch_rad()},
                                                              {v.start_roll, state_.roll_rad()},
                                                              {v.start_speed, initial.speed_mps},
                                                              {v.start_lateral_speed, initial.lateral_speed_mps},
                                                              {v.start_yaw_rate, initial.yaw_rate_radps}};
  for (const auto& [variable, value] : values) {
    if (auto status = Set(variable, value); !status) return status;
  }
  for (const auto& [name, value] : settings_.parameters) {
    if (auto status = instance_->Set(*unit_->description().Find(name), value); !status) return status;
  }
  return {};
}

base::Status FmuModel::Begin(const InitialCondition& initial, ground::Ground& ground) {
  const auto refusal = [&](const std::string& what) {
    return base::WrongInput("vehicle.cannot_be_placed",
                            fmt::format("the car cannot be placed at x {:.3f} m, y {:.3f} m, heading {:.4f} rad: {}",
                                        initial.x_m, initial.y_m, initial.heading_rad, what));
  };
  const ground::GroundPoint start = ground.At(initial.x_m, initial.y_m, initial.z_hint_m);
  if (!start.inside) return refusal("that is outside of the world");
  state_ = VehicleState();
  for (std::size_t i = 0; i < kWheels; ++i) state_.wheels[i].hub_B = HubAtRest_B(i);
  const Eigen::Vector3d ahead(std::cos(initial.heading_rad), std::sin(initial.heading_rad), 0.0);
  const Eigen::Vector3d up = start.normal_W;
  const double pitch = std::atan(ahead.dot(up) / up.z());
  const Eigen::Vector3d forward = std::cos(pitch) * ahead - std::sin(pitch) * Eigen::Vector3d::UnitZ();
  state_.p_WB_W = {initial.x_m, initial.y_m, start.z_m};
  state_.q_WB = Attitude(std::atan2(up.cross(forward).z(), up.z()), pitch, initial.heading_rad);
  QueryGround(ground);
  for (const WheelGround& wheel : wheels_) {
    if (!wheel.inside) return refusal("a wheel would stand outside of the world");
  }
  if (auto status = TakeFreshInstance(); !status) return status;
  time_s_ = 0.0;
  if (auto status = instance_->EnterInitialisation(0.0); !status) return status;
  if (auto status = SetStart(initial); !status) return status;
  if (auto status = SetControls(Controls{}); !status) return status;
  if (auto status = SetGround(); !status) return status;
  if (auto status = instance_->ExitInitialisation(); !status) return status;
  return Publish(Controls{}, 0.0);
}

base::Status FmuModel::Initialise(const InitialCondition& initial, ground::Ground& ground) {
  if (!IsFinite(initial))
    return base::WrongInput("vehicle.wrong_start", "the car's initial place or speed is not a finite number");
  // Where the new start fails, the car goes on as it was; an FMU that allows one instance cannot.
  auto instance = unit_->description().only_once ? nullptr : std::move(instance_);
  const auto wheels = wheels_;
  const VehicleState state = state_;
  const double time_s = time_s_;
  problem_ = {};
  restored_.clear();
  const base::Status status = Begin(initial, ground);
  if (status) return {};
  if (instance) instance_ = std::move(instance);
  wheels_ = wheels;
  state_ = state;
  time_s_ = time_s;
  return status;
}

base::Status FmuModel::Publish(const Controls& controls, double dt_s) {
  VehicleState s = state_;
  const FmuVariables& v = variables_;
  base::Status status;
  const auto get = [&](const FmuVariables::Variable& variable, double default_value = 0.0) {
    const auto value = status ? Get(variable, default_value) : base::Result<double>(default_value);
    if (!value) status = value.error();
    return value ? value.value() : default_value;
  };
  Eigen::Vector3d angle, w_B, velocity;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    s.p_WB_W[k] = get(v.position[i]);
    angle[k] = get(v.angle[i]);
    velocity[k] = get(v.velocity[i]);
    w_B[k] = get(v.rate[i]);
  }
  if (v.has_quaternion()) {
    const double w = get(v.quaternion[0], 1.0), x = get(v.quaternion[1]), y = get(v.quaternion[2]),
                 z = get(v.quaternion[3]);
    const Eigen::Quaterniond q(w, x, y, z);
    if (status && !(q.norm() > 0.5 && q.norm() < 2.0))
      status = base::Failed(
          "fmu.wrong_output",
          fmt::format("its quaternion has the length {:.6g} at {:.6g} s; 1 was expected", q.norm(), time_s_),
          settings_.fmu.string());
    s.q_WB = q.norm() > 0.0 ? q.normalized() : s.q_WB;
  } else {
    s.q_WB = Attitude(angle[0], angle[1], angle[2]);
  }
  s.a_WB_W = dt_s > 0.0 ? Eigen::Vector3d((velocity - s.v_WB_W) / dt_s) : Eigen::Vector3d::Zero();
  s.alpha_WB_B = dt_s > 0.0 ? Eigen::Vector3d((w_B - s.w_WB_B) / dt_s) : Eigen::Vector3d::Zero();
  s.v_WB_W = velocity;
  s.w_WB_B = w_B;
  s.odometer_m += dt_s * std::fabs(s.speed_mps());
  s.inside_world = true;
  const double limit = settings_.dimensions.steering_wheel_limit_rad;
  s.steering_wheel_rad = std::clamp(controls.steering_wheel_rad, -limit, limit);
  for (std::size_t i = 0; i < kWheels; ++i) {
    const FmuVariables::Wheel& of = v.wheels[i];
    WheelState& w = s.wheels[i];
    const Eigen::Vector3d rest = HubAtRest_B(i);
    w.hub_B = {get(of.hub_x, rest.x()), get(of.hub_y, rest.y()), get(of.hub_z, rest.z())};
    w.steer_rad = get(of.steer, i < kRearLeft ? s.steering_wheel_rad / settings_.dimensions.steering_ratio : 0.0);
    w.spin_radps = get(of.spin, s.speed_mps() / settings_.dimensions.wheel_radius_m);
    w.spin_rad = geometry::WrapAngle(w.spin_rad + dt_s * w.spin_radps);
    w.longitudinal_N = get(of.longitudinal);
    w.lateral_N = get(of.lateral);
    w.load_N = get(of.load);
    w.travel_m = w.hub_B.z() - rest.z();
    const Eigen::Vector3d hub_W = s.p_WB_W + s.q_WB * w.hub_B;
    w.contact_normal_W = wheels_[i].normal_W;
    w.contact_W = hub_W - (hub_W - wheels_[i].plane_W).dot(w.contact_normal_W) * w.contact_normal_W;
    w.friction = wheels_[i].friction;
    w.surface = wheels_[i].surface;
    s.inside_world = s.inside_world && wheels_[i].inside;
  }
  s.engine_speed_radps = get(v.engine_speed);
  s.engine_torque_Nm = get(v.engine_torque);
  s.engine_running = true;
  s.gear = static_cast<std::int32_t>(std::lround(std::clamp(get(v.gear, controls.gear), -9.0, 99.0)));
  s.clutch = controls.clutch;
  s.throttle = controls.throttle;
  s.brake = controls.brake;
  s.steering_torque_Nm = get(v.steering_torque);
  s.fuel_rate_kgps = get(v.fuel_rate);
  s.fuel_kg += dt_s * s.fuel_rate_kgps;
  if (status) state_ = s;
  return status;
}

base::Status FmuModel::Advance(const Controls& controls, double dt_s) {
  if (auto status = SetControls(controls); !status) return status;
  if (auto status = SetGround(); !status) return status;
  if (auto status = SetPushInputs(); !status) return status;
  if (auto status = instance_->DoStep(time_s_, dt_s); !status) return status;
  time_s_ += dt_s;
  return Publish(controls, dt_s);
}

void FmuModel::Step(const Controls& controls, ground::Ground& ground, double dt_s) {
  RODEIRA_ASSERT(dt_s > 0.0 && dt_s <= kMaxStep_s);
  QueryGround(ground);
  restored_.clear();
  if (problem_) problem_ = Advance(Clamp(controls), dt_s);
  push_ = {};
}

// The serialised bytes may hold addresses, which differ from process to process. They are carried in snapshots
// (base::kCarried) and are no part of a digest, for which a writer writes no names: there a number takes its own bytes.
void FmuModel::Save(base::StateWriter& writer) const {
  const std::size_t before = writer.bytes().size();
  writer.Put("time_s", time_s_);
  const bool is_digest = writer.bytes().size() - before == sizeof(time_s_);
  for (const WheelGround& wheel : wheels_) writer.Put("wheel", wheel);
  writer.Put("published", state_);
  if (!can_save() || is_digest) return;
  if (!restored_.empty()) return writer.Put(kStateField, restored_);
  const auto state = instance_ ? instance_->State() : base::Result<base::Bytes>(base::Bytes());
  // An FMU that offers its state and does not give it has failed; the next step would say so, and the snapshot is of no
  // use.
  const base::Bytes& bytes = state ? state.value() : base::Bytes();
  const auto* raw = reinterpret_cast<const std::uint8_t*>(bytes.data());
  writer.Put(kStateField, std::vector<std::uint8_t>(raw, raw + bytes.size()));
}

void FmuModel::Restore(base::StateReader& reader) {
  reader.Get("time_s", time_s_);
  for (WheelGround& wheel : wheels_) reader.Get("wheel", wheel);
  reader.Get("published", state_);
  reader.Get(kStateField, restored_);
  // A fresh instance, whatever the old one has come to.
  problem_ = TakeFreshInstance();
  if (problem_) problem_ = instance_->EnterInitialisation(0.0);
  if (problem_) problem_ = instance_->ExitInitialisation();
  if (problem_ && !restored_.empty()) problem_ = instance_->SetState(std::as_bytes(std::span(restored_)));
  if (!problem_) {
    problem_ = problem_.error().WithMessage(
        fmt::format("its state at {:.6g} s cannot be taken over: {}", time_s_, problem_.error().message));
  }
}

}  // namespace rodeira::dynamics
