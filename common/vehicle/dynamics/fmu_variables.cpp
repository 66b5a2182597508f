// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/fmu_variables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "common/core/base/suggest.hpp"
#include "common/vehicle/dynamics/fmu_units.hpp"

namespace rodeira::dynamics {
namespace {

enum class Way { kStart, kInput, kOutput };

struct Finder {
  const fmi::Description& description;
  const FmuNames& names;
  const std::string& file;
  base::Status status = {};
  std::set<std::string> known = {};
  std::map<const fmi::Variable*, std::string> inputs = {};  // the FMU's variables that are set, to our names
  std::vector<std::string> converted = {};
  std::string missing = {};  // the first one
  Way missing_way = Way::kInput;

  void AddProblem(const std::string& what, const std::string& place) {
    if (status) status = base::WrongInput("fmu.wrong_variable", what, place);
  }
  // The line of `names` that maps it, or that of the FMU's description.
  std::string PlaceFor(const std::string& name, const fmi::Variable* variable) const {
    const auto place = names.places.find(name);
    if (place != names.places.end()) return place->second;
    return variable == nullptr ? file : fmi::PlaceOf(file, variable->line);
  }

  // The nearest name is one that no other variable of ours has.
  void ReportMissing() {
    if (missing.empty()) return;
    const bool output = missing_way == Way::kOutput;
    std::vector<std::string> there;
    for (const fmi::Variable& variable : description.variables) {
      if ((variable.causality == "output") == output && variable.causality != "local" && !known.contains(variable.name))
        there.push_back(variable.name);
    }
    std::string place = file;
    for (const auto& [ours, own] : names.own) {
      if (own == missing) place = PlaceFor(ours, nullptr);
    }
    AddProblem(fmt::format("the FMU has no variable '{}' ({}){}", missing, output ? "an output" : "an input",
                           base::DidYouMean(missing, there)),
               place);
  }

  // FMI 2.0.4, 2.1.7: any variable may be read; inputs and tunable parameters are set.
  static bool Fits(const std::string& causality, Way way) {
    if (way == Way::kOutput) {
      return causality == "output" || causality == "local" || causality == "parameter" ||
             causality == "calculatedParameter";
    }
    return causality == "input" || (way == Way::kStart && causality == "parameter");
  }

  // `unit` as FMI writes it.
  void operator()(FmuVariables::Variable& into, const std::string& name, Way way, const std::string& unit,
                  bool needed = false) {
    known.insert(name);
    const auto renamed = names.own.find(name);
    const std::string own = renamed == names.own.end() ? name : renamed->second;
    const fmi::Variable* const found = description.Find(own);
    into.own = found;
    if (found == nullptr) {
      if ((needed || renamed != names.own.end()) && missing.empty()) {
        missing = own;
        missing_way = way;
      }
      return;
    }
    const std::string place = PlaceFor(name, found);
    if (!Fits(found->causality, way)) {
      AddProblem(fmt::format("'{}' of the FMU is declared '{}'; {} was expected", own, found->causality,
                             way == Way::kOutput  ? "'output'"
                             : way == Way::kStart ? "'input' or 'parameter'"
                                                  : "'input'"),
                 place);
    }
    if (found->type == fmi::VariableType::kOther) AddProblem(fmt::format("'{}' of the FMU is no number", own), place);
    const auto conversion = ConversionOf(description, found->unit, unit);
    if (!conversion) {
      AddProblem(fmt::format("'{}' of the FMU is declared in '{}'; '{}' was expected", own, found->unit, unit), place);
      return;
    }
    into.factor = conversion->factor;
    into.offset = conversion->offset;
    if (!conversion->is_identity()) converted.push_back(fmt::format("{} ({} to {})", own, found->unit, unit));
    if (way == Way::kOutput) return;
    const auto [other, is_new] = inputs.emplace(found, name);
    if (!is_new)
      AddProblem(fmt::format("'{}' and '{}' are both the variable '{}' of the FMU; each input needs one of its own",
                             other->second, name, own),
                 names.places.contains(name) ? place : PlaceFor(other->second, found));
  }
};

}  // namespace

bool FmuVariables::takes_pushes() const {
  const auto is_there = [](const Variable& variable) { return static_cast<bool>(variable); };
  return std::ranges::all_of(push_force, is_there) && std::ranges::all_of(push_moment, is_there);
}

base::Result<FmuVariables> FindVariables(const fmi::Description& description, const FmuNames& names,
                                         const std::string& file) {
  FmuVariables v;
  Finder find{description, names, file};
  const std::array<std::string, 4> parts = {"w", "x", "y", "z"};
  for (std::size_t i = 0; i < parts.size(); ++i)
    find(v.quaternion[i], "quaternion_" + parts[i], Way::kOutput, "1", i > 0 && v.has_quaternion());
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
  find(v.gear_lever, "gear_lever", Way::kInput, "1");
  find(v.automatic, "automatic", Way::kInput, "1");
  find(v.starter, "starter", Way::kInput, "1");
  const std::array<std::string, 3> axes = {"x", "y", "z"}, angles = {"roll", "pitch", "heading"},
                                   rates = {"roll", "pitch", "yaw"};
  for (std::size_t i = 0; i < 3; ++i) {
    find(v.push_force[i], "push_" + axes[i] + "_N", Way::kInput, "N");
    find(v.push_moment[i], "push_moment_" + axes[i] + "_Nm", Way::kInput, "N.m");
    find(v.position[i], axes[i] + "_m", Way::kOutput, "m", true);
    find(v.angle[i], angles[i] + "_rad", Way::kOutput, "rad", !v.has_quaternion());
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
  find.ReportMissing();
  for (const auto& [name, own] : names.own) {
    if (find.known.contains(name)) continue;
    find.AddProblem(fmt::format("'names.{}' is no variable of a vehicle{}", name,
                                base::DidYouMean(name, {find.known.begin(), find.known.end()})),
                    find.PlaceFor(name, nullptr));
  }
  if (!find.status) return find.status.error();
  if (!find.converted.empty())
    v.notes.push_back(fmt::format("units of the FMU are converted: {}", fmt::join(find.converted, ", ")));
  return v;
}

}  // namespace rodeira::dynamics
