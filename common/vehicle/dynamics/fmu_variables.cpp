// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/fmu_variables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "common/core/base/suggest.hpp"

namespace rodeira::dynamics {
namespace {

enum class Way { kStart, kInput, kOutput };

struct Finder {
  const fmi::Description& description;
  const std::map<std::string, std::string>& names;
  const std::string& context;
  base::Status status = {};
  std::set<std::string> known = {};
  std::string missing = {};  // the first one
  Way missing_way = Way::kInput;

  void Complain(const std::string& what) {
    if (status) status = base::WrongInput(what, context);
  }

  // The nearest name is one that no other variable of ours has.
  void ComplainOfMissing() {
    if (missing.empty()) return;
    const bool output = missing_way == Way::kOutput;
    std::vector<std::string> there;
    for (const fmi::Variable& variable : description.variables) {
      if ((variable.causality == "output") == output && variable.causality != "local" && !known.contains(variable.name))
        there.push_back(variable.name);
    }
    Complain(fmt::format("the FMU has no variable '{}' ({}){}", missing, output ? "an output" : "an input",
                         base::DidYouMean(missing, there)));
  }

  // `unit` as FMI writes it; "" for what has none.
  void operator()(FmuVariables::Variable& into, const std::string& name, Way way, const std::string& unit,
                  bool needed = false) {
    known.insert(name);
    const auto renamed = names.find(name);
    const std::string own = renamed == names.end() ? name : renamed->second;
    into = description.Find(own);
    if (into == nullptr) {
      if ((needed || renamed != names.end()) && missing.empty()) {
        missing = own;
        missing_way = way;
      }
      return;
    }
    const bool fits = way == Way::kOutput
                          ? into->causality == "output"
                          : into->causality == "input" || (way == Way::kStart && into->causality == "parameter");
    if (!fits) {
      Complain(fmt::format("'{}' of the FMU is declared '{}'; {} was expected", own, into->causality,
                           way == Way::kOutput  ? "'output'"
                           : way == Way::kStart ? "'input' or 'parameter'"
                                                : "'input'"));
    }
    if (into->type == fmi::VariableType::kOther) Complain(fmt::format("'{}' of the FMU is no number", own));
    if (!into->unit.empty() && into->unit != unit) {
      Complain(fmt::format("'{}' of the FMU is declared in '{}'; '{}' was expected", own, into->unit,
                           unit.empty() ? "1" : unit));
    }
  }
};

}  // namespace

bool FmuVariables::takes_pushes() const {
  const auto is_there = [](Variable variable) { return variable != nullptr; };
  return std::ranges::all_of(push_force, is_there) && std::ranges::all_of(push_moment, is_there);
}

base::Result<FmuVariables> FindVariables(const fmi::Description& description,
                                         const std::map<std::string, std::string>& names, const std::string& context) {
  FmuVariables v;
  Finder find{description, names, context};
  find(v.start_x, "start_x_m", Way::kStart, "m", true);
  find(v.start_y, "start_y_m", Way::kStart, "m", true);
  find(v.start_z, "start_z_m", Way::kStart, "m", true);
  find(v.start_heading, "start_heading_rad", Way::kStart, "rad", true);
  find(v.start_pitch, "start_pitch_rad", Way::kStart, "rad");
  find(v.start_roll, "start_roll_rad", Way::kStart, "rad");
  find(v.start_speed, "start_speed_mps", Way::kStart, "m/s");
  find(v.start_lateral_speed, "start_lateral_speed_mps", Way::kStart, "m/s");
  find(v.start_yaw_rate, "start_yaw_rate_radps", Way::kStart, "rad/s");
  find(v.steering_wheel, "steering_wheel_rad", Way::kInput, "rad");
  find(v.throttle, "throttle", Way::kInput, "1");
  find(v.brake, "brake", Way::kInput, "1");
  find(v.clutch, "clutch", Way::kInput, "1");
  find(v.handbrake, "handbrake", Way::kInput, "1");
  find(v.gear_wish, "gear_lever", Way::kInput, "1");
  find(v.automatic, "automatic", Way::kInput, "1");
  find(v.starter, "starter", Way::kInput, "1");
  const std::array<std::string, 3> axes = {"x", "y", "z"}, angles = {"roll", "pitch", "heading"},
                                   rates = {"roll", "pitch", "yaw"};
  for (std::size_t i = 0; i < 3; ++i) {
    find(v.push_force[i], "push_" + axes[i] + "_N", Way::kInput, "N");
    find(v.push_moment[i], "push_moment_" + axes[i] + "_Nm", Way::kInput, "N.m");
    find(v.position[i], axes[i] + "_m", Way::kOutput, "m", true);
    find(v.angle[i], angles[i] + "_rad", Way::kOutput, "rad", true);
    find(v.velocity[i], "velocity_" + axes[i] + "_mps", Way::kOutput, "m/s", true);
    find(v.rate[i], rates[i] + "_rate_radps", Way::kOutput, "rad/s", true);
  }
  find(v.engine_speed, "engine_speed_radps", Way::kOutput, "rad/s");
  find(v.engine_torque, "engine_torque_Nm", Way::kOutput, "N.m");
  find(v.gear, "gear", Way::kOutput, "1");
  find(v.steering_torque, "steering_torque_Nm", Way::kOutput, "N.m");
  find(v.fuel_rate, "fuel_rate_kgps", Way::kOutput, "kg/s");
  const std::array<std::string, kWheels> wheels = {"front_left", "front_right", "rear_left", "rear_right"};
  for (std::size_t i = 0; i < kWheels; ++i) {
    FmuVariables::Wheel& w = v.wheels[i];
    const std::string wheel = wheels[i] + ".";
    find(w.ground_z, wheel + "ground_z_m", Way::kInput, "m");
    find(w.normal_x, wheel + "ground_normal_x", Way::kInput, "1");
    find(w.normal_y, wheel + "ground_normal_y", Way::kInput, "1");
    find(w.normal_z, wheel + "ground_normal_z", Way::kInput, "1");
    find(w.friction, wheel + "friction", Way::kInput, "1");
    find(w.hub_x, wheel + "hub_x_m", Way::kOutput, "m");
    find(w.hub_y, wheel + "hub_y_m", Way::kOutput, "m");
    find(w.hub_z, wheel + "hub_z_m", Way::kOutput, "m");
    find(w.steer, wheel + "steer_rad", Way::kOutput, "rad");
    find(w.spin, wheel + "spin_radps", Way::kOutput, "rad/s");
    find(w.longitudinal, wheel + "longitudinal_N", Way::kOutput, "N");
    find(w.lateral, wheel + "lateral_N", Way::kOutput, "N");
    find(w.load, wheel + "load_N", Way::kOutput, "N");
  }
  find.ComplainOfMissing();
  for (const auto& [name, own] : names) {
    if (find.known.contains(name)) continue;
    find.Complain(fmt::format("'names.{}' is no variable of a vehicle{}", name,
                              base::DidYouMean(name, {find.known.begin(), find.known.end()})));
  }
  if (!find.status) return find.status.error();
  return v;
}

}  // namespace rodeira::dynamics
