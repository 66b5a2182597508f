// SPDX-License-Identifier: Apache-2.0
// The keys of the parts of a vehicle file.
#include <fmt/format.h>

#include <limits>

#include "common/core/geometry/angle.hpp"
#include "common/vehicle/dynamics/bicycle_settings.hpp"
#include "common/vehicle/dynamics/multibody_settings.hpp"
#include "common/vehicle/dynamics/ode_settings.hpp"
#include "common/vehicle/dynamics/vehicle_schema.hpp"

namespace rodeira::dynamics {
namespace {

using config::Key;
using config::MappingKey;
using config::NumberKey;
using config::RequiredNumberKey;
using config::WithSample;

constexpr double kRpm_radps = geometry::kPi / 30.0;

// Loads and pressures, which a factor or a shift is not.
bool IsSize(std::string_view coefficient) {
  return coefficient == "FNOMIN" || coefficient == "FZMAX" || coefficient == "NOMPRES" || coefficient == "INFLPRES" ||
         coefficient == "LFZO" || coefficient == "UNLOADED_RADIUS";
}

Key CoefficientKey(std::string_view name, double value, std::string meaning) {
  const config::Range range = IsSize(name) ? config::Range::Positive() : config::Range{};
  Key key = config::ComputedNumberKey(std::string(name), range, "that of `tir`", std::move(meaning));
  if (value >= range.low && value <= range.high) key.default_note = fmt::format("that of `tir`, else {}", value);
  return key;
}

}  // namespace

Key EnvelopingKey() {
  return config::WordKey("enveloping", {"none", "ring"}, "none", "Contact: the plane below the hub, or a ring.");
}

const std::vector<Key>& FormulaKeys() {
  static const std::vector<Key> keys = [] {
    const MagicFormulaSettings usual;
    std::vector<Key> all;
    for (const MagicFormulaCoefficient& coefficient : MagicFormulaCoefficients())
      all.push_back(CoefficientKey(coefficient.name, usual.*coefficient.member, "Coefficient of the Magic Formula."));
    const AligningSettings aligning;
    for (const AligningCoefficient& coefficient : AligningCoefficients())
      all.push_back(
          CoefficientKey(coefficient.name, aligning.*coefficient.member, "Coefficient of the aligning moment."));
    return all;
  }();
  return keys;
}

const std::vector<Key>& AligningKeys() {
  static const std::vector<Key> keys = [] {
    const AligningSettings usual;
    std::vector<Key> all{WithSample("3000", RequiredNumberKey("FNOMIN", config::Range::Positive(), "Nominal load."))};
    for (const AligningCoefficient& coefficient : AligningCoefficients())
      all.push_back(CoefficientKey(coefficient.name, usual.*coefficient.member, "Coefficient of the aligning moment."));
    return all;
  }();
  return keys;
}

const std::vector<Key>& BodyKeys() {
  static const BodySettings body;
  static const std::vector<Key> keys{
      WithSample("1000",
                 RequiredNumberKey("mass_kg", {50.0, 100000.0}, "Mass of the whole car with wheels and driver.")),
      WithSample("1000",
                 RequiredNumberKey("roll_inertia_kgm2", config::Range::Positive(), "Moment of inertia about x.")),
      WithSample("3000",
                 RequiredNumberKey("pitch_inertia_kgm2", config::Range::Positive(), "Moment of inertia about y.")),
      WithSample("3000",
                 RequiredNumberKey("yaw_inertia_kgm2", config::Range::Positive(), "Moment of inertia about z.")),
      RequiredNumberKey("cg_height_m", {0.05, 5.0}, "Centre of gravity above the road at rest."),
      WithSample("2.5", RequiredNumberKey("wheelbase_m", {0.5, 20.0}, "Distance of the axles.")),
      WithSample("1", RequiredNumberKey("cg_to_front_axle_m", config::Range::Positive(),
                                        "From the front axle to the centre of gravity.")),
      RequiredNumberKey("drag_area_m2", config::Range::NotNegative(), "Drag coefficient times area."),
      NumberKey("air_density_kgpm3", {0.0, 3.0}, body.air_density_kgpm3, "Density of the air.")};
  return keys;
}

const std::vector<Key>& SteeringKeys() {
  static const SteeringSettings steering;
  static const std::vector<Key> keys{
      WithSample("16",
                 RequiredNumberKey("ratio", {1.0, 50.0}, "Angle of the steering wheel over that of the front wheels.")),
      WithSample("9", RequiredNumberKey("wheel_limit_rad", {0.1, 50.0}, "Lock of the steering wheel, each side.")),
      NumberKey("mechanical_trail_m", {0.0, 0.2}, steering.mechanical_trail_m,
                "Mechanical trail, for the steering torque."),
      NumberKey("scrub_radius_m", {-0.1, 0.1}, steering.scrub_radius_m,
                "From the steering axis on the ground to the contact, outwards."),
      NumberKey("pneumatic_trail_m", {0.0, 0.2}, steering.pneumatic_trail_m,
                "Trail of tyres without an aligning moment.")};
  return keys;
}

const std::vector<Key>& DimensionKeys() {
  static const std::vector<Key> keys{
      RequiredNumberKey("track_front_m", {0.3, 5.0}, "Track of the front axle."),
      RequiredNumberKey("track_rear_m", {0.3, 5.0}, "Track of the rear axle."),
      RequiredNumberKey("front_m", config::Range::Positive(), "From the middle of the wheelbase to the front bumper."),
      RequiredNumberKey("rear_m", config::Range::Positive(), "From the middle of the wheelbase to the rear bumper."),
      RequiredNumberKey("width_m", config::Range::Positive(), "Width of the body."),
      WithSample("1.5", RequiredNumberKey("height_m", config::Range::Positive(), "Height of the body."))};
  return keys;
}

const std::vector<Key>& SuspensionKeys() {
  static const std::vector<Key> keys{
      RequiredNumberKey("spring_Npm", config::Range::Positive(), "Stiffness at the wheel."),
      RequiredNumberKey("damper_Nspm", config::Range::Positive(), "Damping at the wheel."),
      RequiredNumberKey("anti_roll_Npm", config::Range::NotNegative(), "Anti-roll stiffness at the wheel."),
      RequiredNumberKey("bump_m", {0.01, 0.5}, "Travel upwards to the stop."),
      RequiredNumberKey("rebound_m", {0.01, 0.5}, "Travel downwards to the stop.")};
  return keys;
}

const std::vector<Key>& WheelKeys() {
  static const std::vector<Key> keys{
      WithSample("0.3", RequiredNumberKey("radius_m", {0.05, 2.0}, "Radius without load.")),
      RequiredNumberKey("rolling_radius_m", {0.05, 2.0}, "Effective rolling radius."),
      RequiredNumberKey("width_m", {0.02, 1.0}, "Width."),
      WithSample("0.8", RequiredNumberKey("inertia_kgm2", {0.05, 1000.0},
                                          "Moment of inertia about the axle, with hub and disc.")),
      RequiredNumberKey("vertical_Npm", {1e4, 1e7}, "Vertical stiffness of the tyre."),
      RequiredNumberKey("rolling_resistance", {0.0, 0.5}, "Rolling resistance over load."),
      EnvelopingKey()};
  return keys;
}

const std::vector<Key>& BrakeKeys() {
  static const std::vector<Key> keys{
      RequiredNumberKey("front_Nm", config::Range::NotNegative(), "Torque of a front wheel with the pedal pressed."),
      RequiredNumberKey("rear_Nm", config::Range::NotNegative(), "Torque of a rear wheel with the pedal pressed."),
      RequiredNumberKey("handbrake_Nm", config::Range::NotNegative(), "Torque of a rear wheel with the handbrake.")};
  return keys;
}

const std::vector<Key>& AssistKeys() {
  static const std::vector<Key> keys{config::FlagKey("abs", false, "Anti-lock brakes."),
                                     config::FlagKey("tcs", false, "Traction control."),
                                     config::FlagKey("esc", false, "Stability control.")};
  return keys;
}

const std::vector<Key>& EngineKeys() {
  static const EngineSettings engine;
  static const std::vector<Key> keys{
      WithSample(
          "[[1000, 90], [5000, 100]]",
          config::Required(config::OtherKey("full_load_rpm_Nm", "a list of [rpm, Nm]", "[[1000, 90], [5000, 100]]",
                                            "Torque at full throttle, by ascending speed."))),
      config::WordKey("curve", {"linear", "smooth"}, "linear", "Between the samples."),
      WithSample("0.8",
                 RequiredNumberKey("inertia_kgm2", config::Range::Positive(), "Moment of inertia with the flywheel.")),
      RequiredNumberKey("drag_Nm", config::Range::Positive(), "Drag torque at rest."),
      RequiredNumberKey("drag_Nmspr", config::Range::NotNegative(), "Drag torque a speed."),
      NumberKey("idle_rpm", {0.0, 30000.0}, engine.idle_radps / kRpm_radps, "Idle speed."),
      NumberKey("stall_rpm", {0.0, 30000.0}, engine.stall_radps / kRpm_radps,
                "Below it combustion ends; below the idle speed."),
      NumberKey("cut_rpm", {0.0, 30000.0}, engine.cut_radps / kRpm_radps, "The limiter cuts the fuel from here."),
      NumberKey("resume_rpm", {0.0, 30000.0}, engine.resume_radps / kRpm_radps,
                "The limiter ends here; below `cut_rpm`."),
      NumberKey("starter_Nm", config::Range::Positive(), engine.starter_Nm, "Torque of the starter."),
      NumberKey("indicated_efficiency", {0.05, 0.7}, engine.indicated_efficiency, "Efficiency of combustion."),
      NumberKey("heating_value_Jpkg", {1e6, 2e8}, engine.heating_value_Jpkg, "Heating value of the fuel."),
      config::OptionalNumberKey("throttle_fuel_lph", {0.1, 1000.0},
                                "Fuel of full throttle, in proportion to the throttle.")};
  return keys;
}

const std::vector<Key>& ClutchKeys() {
  static const std::vector<Key> keys{RequiredNumberKey("capacity_Nm", config::Range::Positive(), "Largest torque.")};
  return keys;
}

const std::vector<Key>& GearboxKeys() {
  static const std::vector<Key> keys{
      config::Required(config::Counted(1, std::numeric_limits<std::size_t>::max(),
                                       config::ListKey("forward", config::NumberItem(config::Range::Positive()),
                                                       "Ratios of the forward gears; each below the one before."))),
      RequiredNumberKey("reverse", config::Range::Positive(), "Ratio of the reverse gear."),
      RequiredNumberKey("final_drive", config::Range::Positive(), "Ratio of the final drive."),
      RequiredNumberKey("efficiency", {0.5, 1.0}, "Efficiency.")};
  return keys;
}

const std::vector<Key>& DifferentialKeys() {
  static const DifferentialSettings differential;
  static const std::vector<Key> keys{
      NumberKey("preload_Nm", config::Range::NotNegative(), differential.preload_Nm, "Locking torque without load."),
      NumberKey("locking_drive", {0.0, 1.0}, differential.locking_drive, "Locking share while the engine drives."),
      NumberKey("locking_overrun", {0.0, 1.0}, differential.locking_overrun,
                "Locking share while the wheels drive the engine.")};
  return keys;
}

const std::vector<Key>& CentreDifferentialKeys() {
  static const CentreDifferentialSettings centre;
  static const std::vector<Key> keys = [] {
    std::vector<Key> all{
        NumberKey("front_share", {0.05, 0.95}, centre.front_share, "Share of the torque for the front axle."),
        config::FlagKey("locked", centre.locked, "Both axles turn alike; the tyres share the torque.")};
    all.insert(all.end(), DifferentialKeys().begin(), DifferentialKeys().end());
    return all;
  }();
  return keys;
}

const std::vector<Key>& DrivenAxleKeys() {
  static const std::vector<Key> keys{
      config::Required(config::WordKey("driven_axle", {"front", "rear", "all"}, "front", "Driven axle or axles."))};
  return keys;
}

const std::vector<Key>& AutomaticKeys() {
  static const AutomaticSettings automatic;
  static const std::vector<Key> keys{
      NumberKey("up_light_rpm", {0.0, 30000.0}, automatic.up_light_radps / kRpm_radps,
                "Change up with little throttle."),
      NumberKey("up_full_rpm", {0.0, 30000.0}, automatic.up_full_radps / kRpm_radps, "Change up with full throttle."),
      NumberKey("down_light_rpm", {0.0, 30000.0}, automatic.down_light_radps / kRpm_radps,
                "Change down with little throttle."),
      NumberKey("down_full_rpm", {0.0, 30000.0}, automatic.down_full_radps / kRpm_radps,
                "Change down with full throttle."),
      NumberKey("margin", {1.0, 2.0}, automatic.margin, "Distance of a new gear from the change back."),
      NumberKey("pause_s", {0.0, 10.0}, automatic.pause_s, "Time between two changes."),
      NumberKey("open_s", {0.01, 2.0}, automatic.open_s, "Time to open the clutch."),
      NumberKey("swap_s", {0.0, 2.0}, automatic.swap_s, "Longest time to reach the speed of the new gear."),
      NumberKey("close_s", {0.01, 2.0}, automatic.close_s, "Time to close the clutch."),
      NumberKey("press_s", {0.0, 5.0}, automatic.press_s, "Smoothing of a pedal that is pressed."),
      NumberKey("release_s", {0.0, 20.0}, automatic.release_s, "Smoothing of a pedal that is released."),
      NumberKey("bite_rpm", {0.0, 30000.0}, automatic.bite_radps / kRpm_radps,
                "Engine speed at which the clutch begins to close."),
      NumberKey("closed_rpm", {0.0, 30000.0}, automatic.closed_radps / kRpm_radps,
                "Engine speed at which it is closed; above `bite_rpm`.")};
  return keys;
}

const std::vector<Key>& SlipCurveKeys() {
  static const std::vector<Key> keys{
      WithSample("0.1", RequiredNumberKey("extremum_slip", {0.005, 2.0}, "Slip of the largest force.")),
      WithSample("1", RequiredNumberKey("extremum_value", {0.05, 5.0}, "Largest force over load.")),
      WithSample("2", RequiredNumberKey("asymptote_slip", {0.005, 10.0}, "Slip of constant force.")),
      WithSample("0.5", RequiredNumberKey("asymptote_value", {0.0, 5.0}, "Force over load there."))};
  return keys;
}

const std::vector<Key>& TyreKeys() {
  static const TyreSettings tyre;
  static const std::vector<Key> keys{
      RequiredNumberKey("relaxation_longitudinal_m", {0.05, 5.0}, "Relaxation length along the wheel."),
      RequiredNumberKey("relaxation_lateral_m", {0.05, 5.0}, "Relaxation length across the wheel."),
      NumberKey("low_speed_mps", {0.1, 20.0}, tyre.low_speed_mps, "Below this speed a damper fades in."),
      config::ComputedNumberKey("pneumatic_trail_m", {0.0, 0.2}, "that of `steering`",
                                "Trail of a tyre without an aligning moment."),
      NumberKey("low_speed_damping_Nspm", {0.0, 8000.0}, tyre.low_speed_damping_Nspm, "Damping at rest."),
      config::ComputedTextKey("tir", "none", "", "Tyre property file."),
      WithSample("{}", config::Summarised("as in tyre files",
                                          MappingKey("magic_formula", FormulaKeys(),
                                                     "Coefficients; beside `tir` they replace those of the file."))),
      MappingKey("slip_curve",
                 {config::Required(MappingKey("longitudinal", SlipCurveKeys(), "Along the wheel.")),
                  config::Required(config::Summarised("as `longitudinal`",
                                                      MappingKey("lateral", SlipCurveKeys(), "Across the wheel.")))},
                 "Instead of the coefficients."),
      config::Summarised("`FNOMIN` and `Q…` as in tyre files",
                         MappingKey("aligning", AligningKeys(), "Aligning moment beside `slip_curve`."))};
  return keys;
}

const std::vector<Key>& OdeKeys() {
  static const OdeSettings ode;
  static const std::vector<Key> keys{
      WithSample("15", RequiredNumberKey("wheel_mass_kg", {0.5, 5000.0}, "Mass of a wheel with hub and brake.")),
      WithSample("0.5", RequiredNumberKey("wheel_across_kgm2", config::Range::Positive(),
                                          "Moment of inertia of a wheel across its axle.")),
      RequiredNumberKey("tyre_damping_Nspm", {0.0, 1e5}, "Vertical damping of a tyre."),
      RequiredNumberKey("stop_Npm", {0.0, 1e6}, "Stiffness of the stops of the suspension."),
      WithSample("0.15", RequiredNumberKey("clearance_m", {0.01, 2.0},
                                           "From the road to the underside of the body; below its height.")),
      RequiredNumberKey("body_friction", {0.0, 2.0}, "Friction of the body on what it touches."),
      NumberKey("longest_substep_s", {1e-5, 0.005}, ode.longest_substep_s, "Longer steps are divided.")};
  return keys;
}

const std::vector<Key>& ChassisKeys() {
  static const std::vector<Key> keys{
      config::RequiredTextKey("chassis", "chassis", "Body of the mechanism, a general one."),
      RequiredNumberKey("drag_area_m2", config::Range::NotNegative(), "Drag coefficient times area."),
      NumberKey("air_density_kgpm3", {0.0, 3.0}, MultibodySettings{}.air_density_kgpm3, "Density of the air."),
      RequiredNumberKey("drag_height_m", {0.0, 5.0}, "Where the drag acts, above the road as drawn.")};
  return keys;
}

const std::vector<Key>& HungWheelKeys() {
  using config::RequiredTextKey;
  static const std::vector<Key> keys{RequiredTextKey("carrier", "chassis", "Body that holds the hub, a general one."),
                                     RequiredTextKey("centre", "hub", "Point in the middle of the wheel."),
                                     RequiredTextKey("axle", "axle", "Vector of the axle, drawn to the left."),
                                     RequiredTextKey("suspension", "spring", "Force of the spring."),
                                     RequiredTextKey("travel", "strut", "Distance or angle that is the travel.")};
  return keys;
}

const std::vector<Key>& ColumnKeys() {
  static const std::vector<Key> keys{
      config::RequiredTextKey("angle", "pinion", "Angle of the column's lower end, left positive."),
      RequiredNumberKey("ratio", {1.0, 50.0}, "Angle of the steering wheel over that of the front wheels."),
      RequiredNumberKey("wheel_limit_rad", {0.1, 50.0}, "Lock of the steering wheel, each side."),
      RequiredNumberKey("column_Nmprad", {1.0, 1e6}, "Stiffness of the column."),
      RequiredNumberKey("column_Nmsprad", {0.0, 1e5}, "Damping of the column.")};
  return keys;
}

const std::vector<Key>& OuterDimensionKeys() {
  static const std::vector<Key> keys(DimensionKeys().begin() + 2, DimensionKeys().end());
  return keys;
}

const std::vector<Key>& FmuDimensionKeys() {
  static const std::vector<Key> keys{
      WithSample("2.5", RequiredNumberKey("wheelbase_m", {0.5, 20.0}, "Distance of the axles.")),
      RequiredNumberKey("track_front_m", {0.3, 5.0}, "Track of the front axle."),
      RequiredNumberKey("track_rear_m", {0.3, 5.0}, "Track of the rear axle."),
      RequiredNumberKey("wheel_radius_m", {0.05, 2.0}, "Radius of the wheels."),
      RequiredNumberKey("wheel_width_m", {0.02, 1.0}, "Width of the wheels."),
      RequiredNumberKey("front_m", config::Range::Positive(), "From the middle of the wheelbase to the front bumper."),
      RequiredNumberKey("rear_m", config::Range::Positive(), "From the middle of the wheelbase to the rear bumper."),
      RequiredNumberKey("width_m", config::Range::Positive(), "Width of the body."),
      WithSample("1.5", RequiredNumberKey("height_m", config::Range::Positive(), "Height of the body.")),
      WithSample("1000", RequiredNumberKey("mass_kg", {50.0, 100000.0}, "Mass.")),
      RequiredNumberKey("steering_ratio", {1.0, 50.0}, "Angle of the steering wheel over that of the front wheels."),
      RequiredNumberKey("steering_wheel_limit_rad", {0.1, 50.0}, "Lock of the steering wheel, each side."),
      config::RequiredIntegerKey("forward_gears", 1, 30, "Forward gears.")};
  return keys;
}

}  // namespace rodeira::dynamics
