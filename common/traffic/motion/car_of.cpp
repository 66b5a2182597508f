// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/motion/car_of.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/base/constants.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kFullBrake_mps2 = 9.0;
constexpr double kHandbrake_mps2 = 3.0;
constexpr double kDamping = 0.3;         // share of the critical
constexpr double kSunk_m = 0.018;        // of a tyre under its load at rest
constexpr double kRollingRadius = 0.97;  // share of the wheel's
constexpr double kMaxSteer_rad = 0.75;
// Changes of gear without a jerk: these engines need so long to come up to a lower gear's speed; closed sooner the
// clutch brakes the car for it.
constexpr double kSwap_s = 0.5, kClose_s = 0.7;

double Rpm(double rpm) { return rpm * 2.0 * base::kPi / 60.0; }

// What cars and heavy vehicles differ in beside their measures: of_mass_kg is what the engine below belongs to, loads
// and brakes are shares, track_less_m of the width.
struct Make {
  double of_mass_kg, front_load, front_brakes, cg_height, natural_Hz, anti_roll, bump_m, track_less_m, wheel_kgm2,
      drag_area_m2, rolling, steering_ratio;
};
constexpr Make kCar{1050.0, 0.55, 0.68, 0.37, 1.35, 0.4, 0.09, 0.25, 0.8, 0.5, 0.012, 16.0};
constexpr Make kHeavy{11000.0, 0.42, 0.58, 0.37, 1.6, 0.7, 0.10, 0.35, 9.0, 5.5, 0.008, 20.0};

dynamics::PowertrainSettings CarPowertrain(double size) {
  dynamics::PowertrainSettings p;
  for (const auto& [rpm, torque] : {std::pair{1000.0, 87.5}, {3500.0, 115.5}, {6499.0, 62.5}})
    p.engine.full_load.push_back({Rpm(rpm), size * torque});
  p.engine.inertia_kgm2 *= size;
  p.engine.drag_Nm *= size;
  p.engine.drag_Nmspr *= size;
  p.engine.starter_Nm *= size;
  p.clutch.capacity_Nm *= size;
  return p;
}

dynamics::PowertrainSettings HeavyPowertrain(double size) {
  dynamics::PowertrainSettings p;
  for (const auto& [rpm, torque] : {std::pair{600.0, 600.0}, {1200.0, 1100.0}, {1600.0, 1100.0}, {2300.0, 800.0}}) {
    p.engine.full_load.push_back({Rpm(rpm), size * torque});
  }
  p.engine.inertia_kgm2 = 2.5 * size;
  p.engine.drag_Nm = 80.0 * size;
  p.engine.drag_Nmspr = 0.5 * size;
  p.engine.idle_radps = Rpm(600.0);
  p.engine.stall_radps = Rpm(300.0);
  p.engine.cut_radps = Rpm(2500.0);
  p.engine.resume_radps = Rpm(2400.0);
  p.engine.starter_Nm = 400.0 * size;
  p.engine.indicated_efficiency = 0.42;
  p.engine.heating_value_Jpkg = 42.8e6;
  p.clutch.capacity_Nm = 1900.0 * size;
  p.gearbox.forward = {6.70, 3.81, 2.29, 1.48, 1.0, 0.73};
  p.gearbox.reverse = 6.0;
  p.gearbox.final_drive = 5.0;
  p.automatic.up_light_radps = Rpm(1450.0);
  p.automatic.up_full_radps = Rpm(2100.0);
  p.automatic.down_light_radps = Rpm(850.0);
  p.automatic.down_full_radps = Rpm(1250.0);
  p.automatic.bite_radps = Rpm(620.0);
  p.automatic.closed_radps = Rpm(1100.0);
  return p;
}

dynamics::SuspensionSettings SpringsUnder(double wheel_load_N, const Make& make) {
  const double mass_kg = wheel_load_N / base::kGravity_mps2, rate = 2.0 * base::kPi * make.natural_Hz;
  dynamics::SuspensionSettings springs;
  springs.spring_Npm = mass_kg * rate * rate;
  springs.damper_Nspm = 2.0 * kDamping * mass_kg * rate;
  springs.anti_roll_Npm = make.anti_roll * springs.spring_Npm;
  springs.bump_m = springs.rebound_m = make.bump_m;
  return springs;
}

dynamics::BodySettings BodyOf(const AgentTraits& traits, const Make& make) {
  const double m = traits.mass_kg, l2 = traits.length_m * traits.length_m, w2 = traits.width_m * traits.width_m,
               h2 = traits.height_m * traits.height_m;
  dynamics::BodySettings body;
  body.mass_kg = m;
  body.roll_inertia_kgm2 = m * (w2 + h2) / 12.0;
  body.pitch_inertia_kgm2 = m * (l2 + h2) / 12.0;
  body.yaw_inertia_kgm2 = m * (l2 + w2) / 12.0;
  body.cg_height_m = make.cg_height * traits.height_m;
  body.wheelbase_m = traits.wheelbase_m;
  body.cg_to_front_axle_m = (1.0 - make.front_load) * traits.wheelbase_m;
  body.drag_area_m2 = make.drag_area_m2;
  return body;
}

}  // namespace

dynamics::BicycleSettings CarOf(const AgentTraits& traits) {
  const bool heavy = traits.kind == VehicleKind::kLorry || traits.kind == VehicleKind::kBus;
  const Make& make = heavy ? kHeavy : kCar;
  const double m = traits.mass_kg, weight_N = m * base::kGravity_mps2, size = m / make.of_mass_kg;
  dynamics::BicycleSettings car;
  car.body = BodyOf(traits, make);
  car.steering.ratio = make.steering_ratio;
  car.steering.limit_rad = kMaxSteer_rad * make.steering_ratio;
  car.suspension = {SpringsUnder(0.5 * make.front_load * weight_N, make),
                    SpringsUnder(0.5 * (1.0 - make.front_load) * weight_N, make)};
  for (dynamics::TyreSettings& tyre : car.tyre) {
    tyre.slip_curve = dynamics::SlipCurveSettings{};
    tyre.low_speed_damping_Nspm *= size;
  }
  car.wheel.radius_m = traits.wheel_radius_m;
  car.wheel.rolling_radius_m = kRollingRadius * traits.wheel_radius_m;
  car.wheel.inertia_kgm2 = make.wheel_kgm2 * size;
  car.wheel.vertical_Npm = 0.25 * weight_N / kSunk_m;
  car.wheel.rolling_resistance = make.rolling;
  const double full_Nm = m * kFullBrake_mps2 * car.wheel.rolling_radius_m;
  car.brakes.front_Nm = 0.5 * make.front_brakes * full_Nm;
  car.brakes.rear_Nm = 0.5 * (1.0 - make.front_brakes) * full_Nm;
  car.brakes.handbrake_Nm = 0.5 * m * kHandbrake_mps2 * car.wheel.rolling_radius_m;
  car.powertrain = heavy ? HeavyPowertrain(size) : CarPowertrain(size);
  car.powertrain.automatic.swap_s = kSwap_s;
  car.powertrain.automatic.close_s = kClose_s;
  car.powertrain.driven = heavy ? dynamics::DrivenWheels::kRear : dynamics::DrivenWheels::kFront;
  dynamics::VehicleDimensions& d = car.dimensions;
  d.wheelbase_m = traits.wheelbase_m;
  d.track_front_m = d.track_rear_m = traits.width_m - make.track_less_m;
  d.front_m = d.rear_m = 0.5 * traits.length_m;
  d.width_m = traits.width_m;
  d.height_m = traits.height_m;
  d.wheel_radius_m = car.wheel.radius_m;
  d.wheel_width_m = car.wheel.width_m;
  d.mass_kg = m;
  d.steering_ratio = car.steering.ratio;
  d.steering_wheel_limit_rad = car.steering.limit_rad;
  d.forward_gears = static_cast<int>(car.powertrain.gearbox.forward.size());
  return car;
}

double TipsAt_mps2(const TrafficSettings& settings) {
  double least = settings.speed.tips_mps2;
  for (const std::uint32_t body : BodiesOf(settings)) {
    const dynamics::BicycleSettings& car = CarOfBody(body);
    const double track_m = std::min(car.dimensions.track_front_m, car.dimensions.track_rear_m);
    least = std::min(least, base::kGravity_mps2 * track_m / (2.0 * car.body.cg_height_m));
  }
  return least;
}

const dynamics::BicycleSettings& CarOfBody(std::uint32_t body) {
  static const std::vector<dynamics::BicycleSettings> kCars = [] {
    std::vector<dynamics::BicycleSettings> cars;
    for (std::uint32_t i = 0; i < kBodies; ++i) cars.push_back(CarOf(TraitsOfBody(i)));
    return cars;
  }();
  return kCars[body];
}

const PlanarCar& PlanarCarOfBody(std::uint32_t body) {
  static const std::vector<PlanarCar> kCars = [] {
    std::vector<PlanarCar> cars;
    for (std::uint32_t i = 0; i < kBodies; ++i) cars.emplace_back(CarOfBody(i));
    return cars;
  }();
  return kCars[body];
}

}  // namespace rodeira::traffic
