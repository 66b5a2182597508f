#include "common/traffic/drivetrain.hpp"

#include <algorithm>
#include <cmath>

#include "common/vehicle/vehicle_state.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kGravity_mps2 = 9.81;
constexpr double kHolding = 0.15;  // of the brake, while standing

// What keeps a rolling car back beside engine and brakes.
double Resistance_N(const vehicle::BicycleSettings& car, double speed_mps, double grade) {
  const double weight_N = car.body.mass_kg * kGravity_mps2 / std::sqrt(1.0 + grade * grade);
  return weight_N * (grade + car.wheel.rolling_resistance) + vehicle::AirDrag(car.body.air_density_kgpm3, car.body.drag_area_m2, speed_mps);
}

// An engine without a torque curve's ends: what there is to open the throttle for, and the drag.
struct Torques {
  double full_Nm = 0.0, drag_Nm = 0.0;

  Torques(const vehicle::EngineSettings& engine, double radps) : full_Nm(vehicle::FullLoadTorque(engine, radps)), drag_Nm(vehicle::DragTorque(engine, radps)) {}
  double Net(double throttle) const { return throttle * (full_Nm + drag_Nm) - drag_Nm; }
};

// What the gears leave of an engine's torque at both driven wheels together (the inverse of vehicle::ShaftTorque).
double AtWheels(const vehicle::GearboxSettings& gearbox, double ratio, double engine_Nm) {
  return ratio * engine_Nm * (engine_Nm > 0.0 ? gearbox.efficiency : 2.0 - gearbox.efficiency);
}

}  // namespace

double FullBrake_N(const vehicle::BicycleSettings& car) {
  double torque_Nm = 0.0;
  for (std::size_t wheel = 0; wheel < vehicle::kWheels; ++wheel) torque_Nm += vehicle::BrakeTorque(car.brakes, wheel, 1.0, 0.0);
  return torque_Nm / car.wheel.rolling_radius_m;
}

Driving DrivingFor(const vehicle::BicycleSettings& car, double speed_mps, double acceleration_mps2, double grade) {
  const vehicle::PowertrainSettings& p = car.powertrain;
  const double v = speed_mps, idle = p.engine.idle_radps, radius = car.wheel.rolling_radius_m;
  if (v <= 0.0 && acceleration_mps2 <= 0.0) return {0.0, std::min(1.0, kHolding + car.body.mass_kg * kGravity_mps2 * std::fabs(grade) / FullBrake_N(car)), 1.0, idle, 1};
  const double force = car.body.mass_kg * acceleration_mps2 + Resistance_N(car, v, grade);
  const double at_wheels_Nm = force * radius;
  const auto turns = [&](int gear) { return v / radius * vehicle::TotalRatio(p.gearbox, gear); };
  const auto reaches = [&](int gear) {
    const double ratio = vehicle::TotalRatio(p.gearbox, gear);
    return at_wheels_Nm <= 0.0 || AtWheels(p.gearbox, ratio, vehicle::FullLoadTorque(p.engine, std::max(idle, v / radius * ratio))) >= at_wheels_Nm;
  };
  int gear = static_cast<int>(p.gearbox.forward.size());
  while (gear > 1 && (turns(gear) < p.automatic.down_light_radps || (!reaches(gear) && turns(gear - 1) < p.engine.resume_radps))) --gear;
  Driving driving;
  driving.gear = gear;
  driving.engine_radps = std::max(idle, turns(gear));
  driving.clutch = std::clamp(1.0 - turns(gear) / idle, 0.0, 1.0);
  const Torques torques(p.engine, driving.engine_radps);
  const double ratio = vehicle::TotalRatio(p.gearbox, gear);
  if (force < 0.0 && driving.clutch > 0.0) {
    driving.clutch = 1.0;  // nothing is left for the engine to do
  } else {
    const double wanted = vehicle::ShaftTorque(p.gearbox, at_wheels_Nm, 1.0) / ratio;
    driving.throttle = std::clamp((wanted + torques.drag_Nm) / (torques.full_Nm + torques.drag_Nm), 0.0, 1.0);
  }
  if (driving.throttle > 0.0) return driving;
  const double overrun_N = -AtWheels(p.gearbox, ratio, -torques.drag_Nm) / radius * (1.0 - driving.clutch);
  driving.brake = std::clamp((-force - overrun_N) / FullBrake_N(car), 0.0, 1.0);
  return driving;
}

double AccelerationOf(const vehicle::BicycleSettings& car, const Driving& driving, double speed_mps, double grade) {
  const Torques torques(car.powertrain.engine, driving.engine_radps);
  const double net_Nm = torques.Net(driving.throttle) * (driving.throttle > 0.0 ? 1.0 : 1.0 - driving.clutch);
  const double ratio = vehicle::TotalRatio(car.powertrain.gearbox, driving.gear);
  const double push_N = AtWheels(car.powertrain.gearbox, ratio, net_Nm) / car.wheel.rolling_radius_m;
  const double brake_N = driving.brake * FullBrake_N(car), resistance_N = Resistance_N(car, speed_mps, grade);
  if (speed_mps <= 0.0 && push_N - resistance_N - brake_N <= 0.0) return 0.0;
  return (push_N - resistance_N - brake_N) / car.body.mass_kg;
}

double FuelFlow_mgps(const vehicle::BicycleSettings& car, const Driving& driving) {
  const vehicle::EngineSettings& engine = car.powertrain.engine;
  const Torques torques(engine, driving.engine_radps);
  double indicated_Nm = driving.throttle * (torques.full_Nm + torques.drag_Nm);
  if (driving.clutch > 0.0) indicated_Nm = std::max(indicated_Nm, torques.drag_Nm);  // idle control
  return 1e6 * indicated_Nm * driving.engine_radps / (engine.indicated_efficiency * engine.heating_value_Jpkg);
}

}  // namespace rodeira::traffic
