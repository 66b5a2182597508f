// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/motion/drivetrain.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/constants.hpp"
#include "common/vehicle/dynamics/vehicle_state.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kHolding = 0.15;          // of the brake, while standing
constexpr double kShiftLookAhead_s = 1.0;  // a gear change farther away has no effect yet
constexpr double kFree_mps2 = 1e3;
constexpr double kSpare = 0.9;  // of the jerk: the rest is for a grade that changes meanwhile

// What keeps a rolling car back beside engine and brakes.
double Resistance_N(const dynamics::BicycleSettings& car, double speed_mps, double grade) {
  const double weight_N = car.body.mass_kg * base::kGravity_mps2 / std::sqrt(1.0 + grade * grade);
  return weight_N * (grade + car.wheel.rolling_resistance) +
         dynamics::AirDrag(car.body.air_density_kgpm3, car.body.drag_area_m2, speed_mps);
}

// What the gears leave of an engine's torque at both driven wheels together (the inverse of dynamics::ShaftTorque).
double AtWheels(const dynamics::GearboxSettings& gearbox, double ratio, double engine_Nm) {
  return ratio * engine_Nm * (engine_Nm > 0.0 ? gearbox.efficiency : 2.0 - gearbox.efficiency);
}

}  // namespace

double FullBrake_N(const dynamics::BicycleSettings& car) {
  double torque_Nm = 0.0;
  for (std::size_t wheel = 0; wheel < dynamics::kWheels; ++wheel)
    torque_Nm += dynamics::BrakeTorque(car.brakes, wheel, 1.0, 0.0);
  return torque_Nm / car.wheel.rolling_radius_m;
}

// An engine without a torque curve's ends: what there is to open the throttle for, and the drag.
Torques::Torques(const dynamics::EngineSettings& engine, double radps)
    : full_Nm(dynamics::FullLoadTorque(engine, radps)), drag_Nm(dynamics::DragTorque(engine, radps)) {}

PlanarCar::PlanarCar(const dynamics::BicycleSettings& of)
    : settings_(&of), full_brake_N_(FullBrake_N(of)), idling_(of.powertrain.engine, of.powertrain.engine.idle_radps) {
  for (int gear = 1; gear <= static_cast<int>(of.powertrain.gearbox.forward.size()); ++gear)
    ratios_.push_back(dynamics::TotalRatio(of.powertrain.gearbox, gear));
}

namespace {

// What it takes to drive so.
struct DriveDemand {
  const PlanarCar& car;
  double speed_mps, resistance_N, force_N, at_wheels_Nm, wheels_radps;

  DriveDemand(const PlanarCar& planar, double v, double acceleration_mps2, double grade) : car(planar), speed_mps(v) {
    const dynamics::BicycleSettings& of = planar.settings();
    resistance_N = Resistance_N(of, v, grade);
    force_N = of.body.mass_kg * acceleration_mps2 + resistance_N;
    at_wheels_Nm = force_N * of.wheel.rolling_radius_m;
    wheels_radps = v / of.wheel.rolling_radius_m;
  }

  double Turns_radps(int gear) const { return wheels_radps * car.Ratio(gear); }
  // Whether the engine can do `margin` times it in this gear.
  bool Reaches(int gear, double margin = 1.0) const {
    const dynamics::PowertrainSettings& p = car.settings().powertrain;
    const double ratio = car.Ratio(gear);
    return at_wheels_Nm <= 0.0 ||
           AtWheels(p.gearbox, ratio,
                    dynamics::FullLoadTorque(p.engine, std::max(p.engine.idle_radps, wheels_radps * ratio))) >=
               margin * at_wheels_Nm;
  }
};

// The highest gear in which the engine neither labours nor is too weak.
int BestGear(const DriveDemand& demand) {
  const dynamics::PowertrainSettings& p = demand.car.settings().powertrain;
  int gear = demand.car.gears();
  while (gear > 1 && (demand.Turns_radps(gear) < p.automatic.down_light_radps ||
                      (!demand.Reaches(gear) && demand.Turns_radps(gear - 1) < p.engine.resume_radps)))
    --gear;
  return gear;
}

int NextGear(const DriveDemand& demand, const Driving& before) {
  const dynamics::PowertrainSettings& p = demand.car.settings().powertrain;
  const int best = BestGear(demand), gear = before.gear;
  if (before.engine_radps <= 0.0 || best == gear) return best;
  if (best < gear) {
    int next = best;  // none that it would be too fast for soon
    while (demand.Turns_radps(gear) >= p.automatic.down_light_radps && next < gear &&
           demand.Turns_radps(next) * p.automatic.margin > p.engine.resume_radps)
      ++next;
    return next;
  }
  if (demand.Turns_radps(gear) > p.engine.resume_radps) return best;
  if (before.gear_s < p.automatic.pause_s || demand.force_N <= 0.0) return gear;
  for (int next = best; next > gear; --next) {
    if (demand.Turns_radps(next) >= p.automatic.margin * p.automatic.down_light_radps &&
        demand.Reaches(next, p.automatic.margin))
      return next;
  }
  return gear;
}

Driving AtRest(const PlanarCar& car, double grade) {
  const dynamics::BicycleSettings& of = car.settings();
  return {0.0, std::min(1.0, kHolding + of.body.mass_kg * base::kGravity_mps2 * std::fabs(grade) / car.full_brake_N()),
          1.0, of.powertrain.engine.idle_radps, 1};
}

// How fast the engine turns in a gear.
double EngineIn_radps(int gear, const DriveDemand& demand) {
  return std::max(demand.car.settings().powertrain.engine.idle_radps, demand.Turns_radps(gear));
}

// The pedals for it in a gear.
Driving DrivingIn(int gear, const DriveDemand& demand, const Torques& torques) {
  const dynamics::PowertrainSettings& p = demand.car.settings().powertrain;
  Driving driving;
  driving.gear = gear;
  driving.engine_radps = EngineIn_radps(gear, demand);
  driving.clutch = std::clamp(1.0 - demand.Turns_radps(gear) / p.engine.idle_radps, 0.0, 1.0);
  const double ratio = demand.car.Ratio(gear);
  if (demand.force_N < 0.0 && driving.clutch > 0.0) {
    driving.clutch = 1.0;  // nothing is left for the engine to do
  } else {
    const double wanted = dynamics::ShaftTorque(p.gearbox, demand.at_wheels_Nm, 1.0) / ratio;
    driving.throttle = std::clamp((wanted + torques.drag_Nm) / (torques.full_Nm + torques.drag_Nm), 0.0, 1.0);
  }
  if (driving.throttle > 0.0) return driving;
  const double overrun_N = -AtWheels(p.gearbox, ratio, -torques.drag_Nm) /
                           demand.car.settings().wheel.rolling_radius_m * (1.0 - driving.clutch);
  driving.brake = std::clamp((-demand.force_N - overrun_N) / demand.car.full_brake_N(), 0.0, 1.0);
  return driving;
}

Torques TorquesIn(int gear, const DriveDemand& demand) {
  return {demand.car.settings().powertrain.engine, EngineIn_radps(gear, demand)};
}

double AccelerationWith(const PlanarCar& car, const Driving& driving, double speed_mps, double resistance_N,
                        const Torques& torques) {
  const dynamics::BicycleSettings& of = car.settings();
  const double net_Nm = torques.Net(driving.throttle) * (driving.throttle > 0.0 ? 1.0 : 1.0 - driving.clutch);
  const double push_N = AtWheels(of.powertrain.gearbox, car.Ratio(driving.gear), net_Nm) / of.wheel.rolling_radius_m;
  const double brake_N = driving.brake * car.full_brake_N();
  if (speed_mps <= 0.0 && push_N - resistance_N - brake_N <= 0.0) return 0.0;
  return (push_N - resistance_N - brake_N) / of.body.mass_kg;
}

double FuelFlowWith_mgps(const PlanarCar& car, const Driving& driving, const Torques& torques) {
  const dynamics::EngineSettings& engine = car.settings().powertrain.engine;
  double indicated_Nm = driving.throttle * (torques.full_Nm + torques.drag_Nm);
  if (driving.clutch > 0.0) indicated_Nm = std::max(indicated_Nm, torques.drag_Nm);  // idle control
  return 1e6 * indicated_Nm * driving.engine_radps / (engine.indicated_efficiency * engine.heating_value_Jpkg);
}

}  // namespace

Driving DrivingFor(const PlanarCar& car, double speed_mps, double acceleration_mps2, double grade) {
  if (speed_mps <= 0.0 && acceleration_mps2 <= 0.0) return AtRest(car, grade);
  const DriveDemand demand(car, speed_mps, acceleration_mps2, grade);
  const int gear = BestGear(demand);
  return DrivingIn(gear, demand, TorquesIn(gear, demand));
}

Driving DriveOn(const PlanarCar& car, const Driving& before, double speed_mps, double acceleration_mps2, double grade,
                double dt_s) {
  return Drive(car, before, speed_mps, acceleration_mps2, grade, dt_s).driving;
}

double AccelerationOf(const PlanarCar& car, const Driving& driving, double speed_mps, double grade) {
  return AccelerationWith(car, driving, speed_mps, Resistance_N(car.settings(), speed_mps, grade),
                          Torques(car.settings().powertrain.engine, driving.engine_radps));
}

double FuelFlow_mgps(const PlanarCar& car, const Driving& driving) {
  return FuelFlowWith_mgps(car, driving, Torques(car.settings().powertrain.engine, driving.engine_radps));
}

double AtMostBeforeChange_mps2(const PlanarCar& car, const Driving& before, double speed_mps, double acceleration_mps2,
                               double grade, double jerk_mps3) {
  if (acceleration_mps2 <= 0.0 || before.engine_radps <= 0.0 || before.gear >= car.gears()) return kFree_mps2;
  const dynamics::BicycleSettings& of = car.settings();
  const double fastest_radps = of.powertrain.engine.resume_radps, ratio = car.Ratio(before.gear);
  const double changes_mps = fastest_radps / ratio * of.wheel.rolling_radius_m;
  if (speed_mps > changes_mps || changes_mps > speed_mps + kShiftLookAhead_s * acceleration_mps2) return kFree_mps2;
  Driving then;
  then.gear = before.gear + 1;
  then.throttle = 1.0;
  then.engine_radps = std::max(of.powertrain.engine.idle_radps, fastest_radps * car.Ratio(then.gear) / ratio);
  return AccelerationOf(car, then, changes_mps, grade) +
         kSpare * jerk_mps3 * (changes_mps - speed_mps) / acceleration_mps2;
}

Driven Drive(const PlanarCar& car, const Driving& before, double speed_mps, double acceleration_mps2, double grade,
             double dt_s) {
  if (speed_mps <= 0.0 && acceleration_mps2 <= 0.0) {
    const Driving held = AtRest(car, grade);
    return {held, AccelerationWith(car, held, speed_mps, Resistance_N(car.settings(), speed_mps, grade), car.idling()),
            FuelFlowWith_mgps(car, held, car.idling())};
  }
  const DriveDemand demand(car, speed_mps, acceleration_mps2, grade);
  const int gear = NextGear(demand, before);
  const Torques torques = TorquesIn(gear, demand);
  Driving driving = DrivingIn(gear, demand, torques);
  driving.gear_s = gear == before.gear ? before.gear_s + dt_s : 0.0;
  return {driving, AccelerationWith(car, driving, speed_mps, demand.resistance_N, torques),
          FuelFlowWith_mgps(car, driving, torques)};
}

}  // namespace rodeira::traffic
