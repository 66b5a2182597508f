// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/parts_file.hpp"

#include <fmt/format.h>

#include <string_view>

#include "common/core/geometry/angle.hpp"
#include "common/vehicle/dynamics/tyre_file.hpp"

namespace rodeira::dynamics {
namespace {

using config::Map;
using config::Range;

constexpr double kRadpsPerRpm = geometry::kPi / 30.0;

double Rpm(const Map& map, const char* key, double otherwise_radps) {
  return map.Number(key, {0.0, 30000.0}, otherwise_radps / kRadpsPerRpm) * kRadpsPerRpm;
}

// Loads and pressures, which a factor or a shift is not.
bool IsSize(std::string_view coefficient) {
  return coefficient == "FNOMIN" || coefficient == "FZMAX" || coefficient == "NOMPRES" || coefficient == "INFLPRES" ||
         coefficient == "LFZO";
}

std::vector<TorqueSample> ReadCurve(const Map& map) {
  constexpr const char* kKey = "full_load_rpm_Nm";
  std::vector<TorqueSample> samples;
  const config::List items = map.Items(kKey);
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

EngineSettings ReadEngine(const Map& map) {
  EngineSettings engine;
  engine.full_load = ReadCurve(map);
  if (map.Choice("curve", {"linear", "smooth"}, "linear") == "smooth")
    engine.full_load_Nmspr = SmoothSlopes(engine.full_load);
  engine.inertia_kgm2 = map.Number("inertia_kgm2", Range::Positive());
  engine.drag_Nm = map.Number("drag_Nm", Range::Positive());
  engine.drag_Nmspr = map.Number("drag_Nmspr", Range::NotNegative());
  engine.idle_radps = Rpm(map, "idle_rpm", engine.idle_radps);
  engine.stall_radps = Rpm(map, "stall_rpm", engine.stall_radps);
  engine.cut_radps = Rpm(map, "cut_rpm", engine.cut_radps);
  engine.resume_radps = Rpm(map, "resume_rpm", engine.resume_radps);
  engine.starter_Nm = map.Number("starter_Nm", Range::Positive(), engine.starter_Nm);
  engine.indicated_efficiency = map.Number("indicated_efficiency", {0.05, 0.7}, engine.indicated_efficiency);
  engine.heating_value_Jpkg = map.Number("heating_value_Jpkg", {1e6, 2e8}, engine.heating_value_Jpkg);
  if (map.Has("throttle_fuel_lph"))
    engine.throttle_fuel_kgps = map.Number("throttle_fuel_lph", {0.1, 1000.0}) * kPetrol_kgpl / 3600.0;
  if (engine.stall_radps >= engine.idle_radps)
    map.Problem("stall_rpm", "config.wrong_order", "'engine.stall_rpm' is not below 'engine.idle_rpm'");
  if (engine.resume_radps >= engine.cut_radps)
    map.Problem("resume_rpm", "config.wrong_order", "'engine.resume_rpm' is not below 'engine.cut_rpm'");
  return engine;
}

ClutchSettings ReadClutch(const Map& map) { return {map.Number("capacity_Nm", Range::Positive())}; }

GearboxSettings ReadGearbox(const Map& map) {
  GearboxSettings gearbox;
  gearbox.forward = map.Numbers("forward", Range::Positive());
  if (gearbox.forward.empty())
    map.Problem("forward", "config.too_few", "'gearbox.forward' is empty; at least one ratio was expected");
  for (std::size_t i = 1; i < gearbox.forward.size(); ++i) {
    if (gearbox.forward[i] >= gearbox.forward[i - 1])
      map.Problem("forward", "config.wrong_order", "'gearbox.forward' does not fall from gear to gear");
  }
  gearbox.reverse = map.Number("reverse", Range::Positive());
  gearbox.final_drive = map.Number("final_drive", Range::Positive());
  gearbox.efficiency = map.Number("efficiency", {0.5, 1.0});
  return gearbox;
}

DifferentialSettings ReadDifferential(const Map& map) {
  constexpr Range kLocking{0.0, 1.0};
  DifferentialSettings differential;
  differential.preload_Nm = map.Number("preload_Nm", Range::NotNegative(), differential.preload_Nm);
  differential.locking_drive = map.Number("locking_drive", kLocking, differential.locking_drive);
  differential.locking_overrun = map.Number("locking_overrun", kLocking, differential.locking_overrun);
  return differential;
}

AutomaticSettings ReadAutomatic(const Map& map) {
  AutomaticSettings automatic;
  automatic.up_light_radps = Rpm(map, "up_light_rpm", automatic.up_light_radps);
  automatic.up_full_radps = Rpm(map, "up_full_rpm", automatic.up_full_radps);
  automatic.down_light_radps = Rpm(map, "down_light_rpm", automatic.down_light_radps);
  automatic.down_full_radps = Rpm(map, "down_full_rpm", automatic.down_full_radps);
  automatic.margin = map.Number("margin", {1.0, 2.0}, automatic.margin);
  automatic.pause_s = map.Number("pause_s", {0.0, 10.0}, automatic.pause_s);
  automatic.open_s = map.Number("open_s", {0.01, 2.0}, automatic.open_s);
  automatic.swap_s = map.Number("swap_s", {0.0, 2.0}, automatic.swap_s);
  automatic.close_s = map.Number("close_s", {0.01, 2.0}, automatic.close_s);
  automatic.press_s = map.Number("press_s", {0.0, 5.0}, automatic.press_s);
  automatic.release_s = map.Number("release_s", {0.0, 20.0}, automatic.release_s);
  automatic.bite_radps = Rpm(map, "bite_rpm", automatic.bite_radps);
  automatic.closed_radps = Rpm(map, "closed_rpm", automatic.closed_radps);
  if (automatic.closed_radps <= automatic.bite_radps)
    map.Problem("closed_rpm", "config.wrong_order", "'automatic.closed_rpm' is not above 'automatic.bite_rpm'");
  return automatic;
}

SlipCurve ReadSlipCurve(const Map& map) {
  SlipCurve curve;
  curve.extremum_slip = map.Number("extremum_slip", {0.005, 2.0});
  curve.extremum_value = map.Number("extremum_value", {0.05, 5.0});
  curve.asymptote_slip = map.Number("asymptote_slip", {0.005, 10.0});
  curve.asymptote_value = map.Number("asymptote_value", {0.0, 5.0});
  if (curve.asymptote_slip <= curve.extremum_slip)
    map.Problem("asymptote_slip", "config.wrong_order", "'asymptote_slip' is not above 'extremum_slip'");
  if (curve.asymptote_value > curve.extremum_value)
    map.Problem("asymptote_value", "config.wrong_order", "'asymptote_value' is above 'extremum_value', the largest");
  return curve;
}

}  // namespace

PowertrainSettings ReadPowertrain(const Map& root) {
  PowertrainSettings powertrain;
  powertrain.engine = ReadEngine(root.Child("engine"));
  powertrain.clutch = ReadClutch(root.Child("clutch"));
  powertrain.gearbox = ReadGearbox(root.Child("gearbox"));
  powertrain.differential = ReadDifferential(root.OptionalChild("differential"));
  powertrain.automatic = ReadAutomatic(root.OptionalChild("automatic"));
  return powertrain;
}

SuspensionSettings ReadSuspension(const Map& map) {
  SuspensionSettings suspension;
  suspension.spring_Npm = map.Number("spring_Npm", Range::Positive());
  suspension.damper_Nspm = map.Number("damper_Nspm", Range::Positive());
  suspension.anti_roll_Npm = map.Number("anti_roll_Npm", Range::NotNegative());
  suspension.bump_m = map.Number("bump_m", {0.01, 0.5});
  suspension.rebound_m = map.Number("rebound_m", {0.01, 0.5});
  return suspension;
}

Enveloping ReadEnveloping(const Map& map) {
  return map.Choice("enveloping", {"none", "ring"}, "none") == "ring" ? Enveloping::kRing : Enveloping::kNone;
}

WheelSettings ReadWheel(const Map& map) {
  WheelSettings wheel;
  wheel.radius_m = map.Number("radius_m", {0.05, 2.0});
  wheel.rolling_radius_m = map.Number("rolling_radius_m", {0.05, 2.0});
  wheel.width_m = map.Number("width_m", {0.02, 1.0});
  wheel.inertia_kgm2 = map.Number("inertia_kgm2", {0.05, 1000.0});
  wheel.vertical_Npm = map.Number("vertical_Npm", {1e4, 1e7});
  wheel.rolling_resistance = map.Number("rolling_resistance", {0.0, 0.5});
  wheel.enveloping = ReadEnveloping(map);
  return wheel;
}

BrakeSettings ReadBrakes(const Map& map) {
  BrakeSettings brakes;
  brakes.front_Nm = map.Number("front_Nm", Range::NotNegative());
  brakes.rear_Nm = map.Number("rear_Nm", Range::NotNegative());
  brakes.handbrake_Nm = map.Number("handbrake_Nm", Range::NotNegative());
  return brakes;
}

TyreSettings ReadTyre(const Map& map) {
  TyreSettings tyre;
  tyre.relaxation_longitudinal_m = map.Number("relaxation_longitudinal_m", {0.05, 5.0});
  tyre.relaxation_lateral_m = map.Number("relaxation_lateral_m", {0.05, 5.0});
  tyre.low_speed_mps = map.Number("low_speed_mps", {0.1, 20.0}, tyre.low_speed_mps);
  tyre.low_speed_damping_Nspm = map.Number("low_speed_damping_Nspm", {0.0, 8000.0}, tyre.low_speed_damping_Nspm);
  if (map.Has("slip_curve")) {
    for (const char* other : {"tir", "magic_formula"}) {
      if (map.Has(other))
        map.Problem(other, "config.conflicting_keys",
                    fmt::format("'{}' stands beside 'slip_curve'; one of the two was expected", other));
    }
    const Map curve = map.Child("slip_curve");
    tyre.slip_curve =
        SlipCurveSettings{ReadSlipCurve(curve.Child("longitudinal")), ReadSlipCurve(curve.Child("lateral"))};
    return tyre;
  }
  // From a file of its maker, by coefficients that stand here, or by both: what stands here counts.
  if (const auto tir = map.OptionalPath("tir")) {
    auto file = LoadTyreFile(*tir);
    if (!file) {
      map.Problem("tir", file.error().id, file.error().Text());
    } else {
      tyre.formula = file.value().formula;
      tyre.model = file.value().model;
      if (tyre.model && map.Has("magic_formula"))
        map.Problem("magic_formula", "config.conflicting_keys",
                    fmt::format("'magic_formula' stands beside a tyre of the model {}, which has no "
                                "such coefficients",
                                file.value().kind));
    }
  }
  const Map coefficients = map.Has("tir") ? map.OptionalChild("magic_formula") : map.Child("magic_formula");
  for (const MagicFormulaCoefficient& coefficient : MagicFormulaCoefficients()) {
    double& value = tyre.formula.*coefficient.member;
    value = coefficients.Number(coefficient.name, IsSize(coefficient.name) ? Range::Positive() : Range{}, value);
  }
  return tyre;
}

}  // namespace rodeira::dynamics
