// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/parts_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "common/core/config/declared.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/vehicle/dynamics/tyre_file.hpp"
#include "common/vehicle/dynamics/vehicle_schema.hpp"

namespace rodeira::dynamics {
namespace {

using config::Map;

constexpr double kRadpsPerRpm = geometry::kPi / 30.0;

double Rpm(const config::DeclaredMap& map, const char* key) { return map.Number(key) * kRadpsPerRpm; }

// Coefficients of the aligning moment, beside the ones that `tyre` has. Without a trail there is no moment.
void ReadAligning(const config::DeclaredMap& map, const std::vector<config::Key>& keys, TyreSettings& tyre) {
  AligningSettings aligning = tyre.aligning.value_or(AligningSettings{});
  for (const AligningCoefficient& coefficient : AligningCoefficients()) {
    double& value = aligning.*coefficient.member;
    value = map.MapWith(coefficient.name).Number(coefficient.name, FindKey(keys, coefficient.name)->range, value);
  }
  if (tyre.aligning || aligning.qdz1 != 0.0) tyre.aligning = aligning;
}

std::vector<TorqueSample> ReadCurve(const config::DeclaredMap& map) {
  constexpr const char* kKey = "full_load_rpm_Nm";
  std::vector<TorqueSample> samples;
  const config::List items = map.MapWith(kKey).Items(kKey);
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::vector<double> pair = items.Numbers(i);
    if (pair.size() != 2) {
      items.Problem(
          i, "config.wrong_length",
          fmt::format("item {} of 'engine.{}' holds {} numbers; [rpm, Nm] was expected", i + 1, kKey, pair.size()));
      continue;
    }
    if (pair[0] <= 0.0 || (!samples.empty() && pair[0] * kRadpsPerRpm <= samples.back().speed_radps)) {
      items.Problem(i, "config.wrong_order",
                    fmt::format("item {} of 'engine.{}' is at {} rpm; speeds over 0 in ascending order were expected",
                                i + 1, kKey, pair[0]));
      continue;
    }
    samples.push_back({pair[0] * kRadpsPerRpm, pair[1]});
  }
  if (items.size() == 1)
    items.Problem(0, "config.too_few", fmt::format("'engine.{}' has one sample; at least two were expected", kKey));
  return samples;
}

EngineSettings ReadEngine(const Map& given) {
  const config::DeclaredMap map(given, EngineKeys());
  EngineSettings engine;
  engine.full_load = ReadCurve(map);
  if (map.Word("curve") == "smooth") engine.full_load_Nmspr = SmoothSlopes(engine.full_load);
  engine.inertia_kgm2 = map.Number("inertia_kgm2");
  engine.drag_Nm = map.Number("drag_Nm");
  engine.drag_Nmspr = map.Number("drag_Nmspr");
  engine.idle_radps = Rpm(map, "idle_rpm");
  engine.stall_radps = Rpm(map, "stall_rpm");
  engine.cut_radps = Rpm(map, "cut_rpm");
  engine.resume_radps = Rpm(map, "resume_rpm");
  engine.starter_Nm = map.Number("starter_Nm");
  engine.indicated_efficiency = map.Number("indicated_efficiency");
  engine.heating_value_Jpkg = map.Number("heating_value_Jpkg");
  if (const auto fuel_lph = map.OptionalNumber("throttle_fuel_lph"))
    engine.throttle_fuel_kgps = *fuel_lph * kPetrol_kgpl / 3600.0;
  if (engine.stall_radps >= engine.idle_radps)
    map.map().Problem("stall_rpm", "config.wrong_order", "'engine.stall_rpm' is not below 'engine.idle_rpm'");
  if (engine.resume_radps >= engine.cut_radps)
    map.map().Problem("resume_rpm", "config.wrong_order", "'engine.resume_rpm' is not below 'engine.cut_rpm'");
  return engine;
}

ClutchSettings ReadClutch(const Map& given) { return {config::DeclaredMap(given, ClutchKeys()).Number("capacity_Nm")}; }

GearboxSettings ReadGearbox(const Map& given) {
  const config::DeclaredMap map(given, GearboxKeys());
  GearboxSettings gearbox;
  gearbox.forward = map.Numbers("forward");
  if (gearbox.forward.empty())
    map.map().Problem("forward", "config.too_few", "'gearbox.forward' is empty; at least one ratio was expected");
  for (std::size_t i = 1; i < gearbox.forward.size(); ++i) {
    if (gearbox.forward[i] >= gearbox.forward[i - 1])
      map.map().Problem("forward", "config.wrong_order", "'gearbox.forward' does not fall from gear to gear");
  }
  gearbox.reverse = map.Number("reverse");
  gearbox.final_drive = map.Number("final_drive");
  gearbox.efficiency = map.Number("efficiency");
  return gearbox;
}

DifferentialSettings ReadDifferential(const Map& given) {
  const config::DeclaredMap map(given, DifferentialKeys());
  DifferentialSettings differential;
  differential.preload_Nm = map.Number("preload_Nm");
  differential.locking_drive = map.Number("locking_drive");
  differential.locking_overrun = map.Number("locking_overrun");
  return differential;
}

CentreDifferentialSettings ReadCentreDifferential(const Map& given) {
  const config::DeclaredMap map(given, CentreDifferentialKeys());
  CentreDifferentialSettings centre;
  centre.front_share = map.Number("front_share");
  centre.locked = map.Flag("locked");
  centre.plates.preload_Nm = map.Number("preload_Nm");
  centre.plates.locking_drive = map.Number("locking_drive");
  centre.plates.locking_overrun = map.Number("locking_overrun");
  for (const char* key : {"preload_Nm", "locking_drive", "locking_overrun"})
    if (centre.locked && given.Has(key))
      given.Problem(key, "vehicle.locked_with_plates",
                    fmt::format("'{}' does nothing where 'locked' is true: only one of them was expected", key));
  return centre;
}

DrivenWheels ReadDriven(const Map& root) {
  const config::DeclaredMap map(root, DrivenAxleKeys());
  const std::string driven = map.Word("driven_axle");
  for (const char* key : {"centre_differential", "rear_differential"})
    if (driven != "all" && root.Has(key))
      root.Problem(
          key, "vehicle.not_all_driven",
          fmt::format("'{}' belongs to 'driven_axle: all'; here 'driven_axle' is '{}' and the key is 'differential'",
                      key, driven));
  return driven == "all" ? DrivenWheels::kAll : driven == "rear" ? DrivenWheels::kRear : DrivenWheels::kFront;
}

AutomaticSettings ReadAutomatic(const Map& given) {
  const config::DeclaredMap map(given, AutomaticKeys());
  AutomaticSettings automatic;
  automatic.up_light_radps = Rpm(map, "up_light_rpm");
  automatic.up_full_radps = Rpm(map, "up_full_rpm");
  automatic.down_light_radps = Rpm(map, "down_light_rpm");
  automatic.down_full_radps = Rpm(map, "down_full_rpm");
  automatic.margin = map.Number("margin");
  automatic.pause_s = map.Number("pause_s");
  automatic.open_s = map.Number("open_s");
  automatic.swap_s = map.Number("swap_s");
  automatic.close_s = map.Number("close_s");
  automatic.press_s = map.Number("press_s");
  automatic.release_s = map.Number("release_s");
  automatic.bite_radps = Rpm(map, "bite_rpm");
  automatic.closed_radps = Rpm(map, "closed_rpm");
  if (automatic.closed_radps <= automatic.bite_radps)
    map.map().Problem("closed_rpm", "config.wrong_order", "'automatic.closed_rpm' is not above 'automatic.bite_rpm'");
  return automatic;
}

SlipCurve ReadSlipCurve(const Map& given) {
  const config::DeclaredMap map(given, SlipCurveKeys());
  SlipCurve curve;
  curve.extremum_slip = map.Number("extremum_slip");
  curve.extremum_value = map.Number("extremum_value");
  curve.asymptote_slip = map.Number("asymptote_slip");
  curve.asymptote_value = map.Number("asymptote_value");
  if (given.Has("asymptote_slip") && curve.asymptote_slip <= curve.extremum_slip)
    map.map().Problem("asymptote_slip", "config.wrong_order", "'asymptote_slip' is not above 'extremum_slip'");
  if (given.Has("asymptote_value") && curve.asymptote_value > curve.extremum_value)
    map.map().Problem("asymptote_value", "config.wrong_order",
                      "'asymptote_value' is above 'extremum_value', the largest");
  return curve;
}

}  // namespace

PowertrainSettings ReadPowertrain(const Map& root) {
  PowertrainSettings powertrain;
  powertrain.driven = ReadDriven(root);
  powertrain.engine = ReadEngine(root.Child("engine"));
  powertrain.clutch = ReadClutch(root.Child("clutch"));
  powertrain.gearbox = ReadGearbox(root.Child("gearbox"));
  powertrain.differential = ReadDifferential(root.OptionalChild("differential"));
  powertrain.rear_differential = ReadDifferential(root.OptionalChild("rear_differential"));
  powertrain.centre = ReadCentreDifferential(root.OptionalChild("centre_differential"));
  powertrain.automatic = ReadAutomatic(root.OptionalChild("automatic"));
  return powertrain;
}

SuspensionSettings ReadSuspension(const Map& given) {
  const config::DeclaredMap map(given, SuspensionKeys());
  SuspensionSettings suspension;
  suspension.spring_Npm = map.Number("spring_Npm");
  suspension.damper_Nspm = map.Number("damper_Nspm");
  suspension.anti_roll_Npm = map.Number("anti_roll_Npm");
  suspension.bump_m = map.Number("bump_m");
  suspension.rebound_m = map.Number("rebound_m");
  return suspension;
}

Enveloping ReadEnveloping(const Map& map) {
  const std::vector<config::Key> keys{EnvelopingKey()};
  return config::DeclaredMap(map, keys).Word("enveloping") == "ring" ? Enveloping::kRing : Enveloping::kNone;
}

WheelSettings ReadWheel(const Map& given) {
  const config::DeclaredMap map(given, WheelKeys());
  WheelSettings wheel;
  wheel.radius_m = map.Number("radius_m");
  wheel.rolling_radius_m = map.Number("rolling_radius_m");
  wheel.width_m = map.Number("width_m");
  wheel.inertia_kgm2 = map.Number("inertia_kgm2");
  wheel.vertical_Npm = map.Number("vertical_Npm");
  wheel.rolling_resistance = map.Number("rolling_resistance");
  wheel.enveloping = ReadEnveloping(map.MapWith("enveloping"));
  return wheel;
}

BrakeSettings ReadBrakes(const Map& given) {
  const config::DeclaredMap map(given, BrakeKeys());
  BrakeSettings brakes;
  brakes.front_Nm = map.Number("front_Nm");
  brakes.rear_Nm = map.Number("rear_Nm");
  brakes.handbrake_Nm = map.Number("handbrake_Nm");
  return brakes;
}

assists::AssistSettings ReadAssists(const Map& root, const BrakeSettings& brakes) {
  const config::DeclaredMap map(root.OptionalChild("assists"), AssistKeys());
  assists::AssistSettings assists;
  assists.abs = map.Flag("abs");
  assists.tcs = map.Flag("tcs");
  assists.esc = map.Flag("esc");
  for (const auto& [key, works] : {std::pair{"abs", assists.abs}, std::pair{"esc", assists.esc}}) {
    if (works && !(brakes.front_Nm > 0.0 && brakes.rear_Nm > 0.0))
      map.map().Problem(
          key, "config.conflicting_keys",
          fmt::format("'assists.{}' is true; 'brakes.front_Nm' and 'brakes.rear_Nm' above 0 were expected", key));
  }
  return assists;
}

TyreSettings ReadTyre(const Map& given) {
  const config::DeclaredMap map(given, TyreKeys());
  TyreSettings tyre;
  tyre.relaxation_longitudinal_m = map.Number("relaxation_longitudinal_m");
  tyre.relaxation_lateral_m = map.Number("relaxation_lateral_m");
  tyre.low_speed_mps = map.Number("low_speed_mps");
  tyre.pneumatic_trail_m = map.Number("pneumatic_trail_m", tyre.pneumatic_trail_m);
  tyre.low_speed_damping_Nspm = map.Number("low_speed_damping_Nspm");
  if (map.map().Has("slip_curve")) {
    for (const char* other : {"tir", "magic_formula"}) {
      if (map.map().Has(other))
        map.map().Problem(other, "config.conflicting_keys",
                          fmt::format("'{}' stands beside 'slip_curve'; one of the two was expected", other));
    }
    const Map curve = map.MapWith("slip_curve").Child("slip_curve");
    tyre.slip_curve =
        SlipCurveSettings{ReadSlipCurve(curve.Child("longitudinal")), ReadSlipCurve(curve.Child("lateral"))};
    if (map.map().Has("aligning")) {
      const config::DeclaredMap aligning = map.Child("aligning");
      tyre.formula.fnomin = aligning.Number("FNOMIN");
      ReadAligning(aligning, AligningKeys(), tyre);
    }
    return tyre;
  }
  if (map.map().Has("aligning"))
    map.map().Problem("aligning", "config.conflicting_keys",
                      "'aligning' stands without 'slip_curve'; its coefficients were expected in 'magic_formula'");
  // From a file of its maker, by coefficients that stand here, or by both: what stands here counts.
  if (const auto tir = map.MapWith("tir").OptionalPath("tir")) {
    auto file = LoadTyreFile(*tir);
    if (!file) {
      map.map().Problem("tir", file.error().id, file.error().Text());
    } else {
      tyre.formula = file.value().formula;
      tyre.model = file.value().model;
      tyre.aligning = file.value().aligning;
      if (tyre.model && map.map().Has("magic_formula"))
        map.map().Problem("magic_formula", "config.conflicting_keys",
                          fmt::format("'magic_formula' stands beside a tyre of the model {}, which has no "
                                      "such coefficients",
                                      file.value().kind));
    }
  }
  const Map& with_formula = map.MapWith("magic_formula");
  const Map found =
      map.map().Has("tir") ? with_formula.OptionalChild("magic_formula") : with_formula.Child("magic_formula");
  const config::DeclaredMap coefficients(found, FormulaKeys());
  for (const MagicFormulaCoefficient& coefficient : MagicFormulaCoefficients()) {
    double& value = tyre.formula.*coefficient.member;
    value = coefficients.MapWith(coefficient.name)
                .Number(coefficient.name, FindKey(FormulaKeys(), coefficient.name)->range, value);
  }
  ReadAligning(coefficients, FormulaKeys(), tyre);
  return tyre;
}

void LimitDamping(const WheelSettings& wheel, double step_s, TyreSettings& tyre) {
  const double most_Nspm = wheel.inertia_kgm2 / (wheel.rolling_radius_m * wheel.rolling_radius_m * step_s);
  tyre.low_speed_damping_Nspm = std::min(tyre.low_speed_damping_Nspm, most_Nspm);
}

}  // namespace rodeira::dynamics
