#include "common/traffic/drivetrain.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/vehicle/engine.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kGravity_mps2 = 9.81;
constexpr double kAir_kgpm3 = 1.2;
constexpr double kAtRest_mps = 0.05;
constexpr double kFullBrake_mps2 = 8.0;
constexpr double kHolding = 0.15;  // of the brake, while standing

struct Drivetrain {
  vehicle::EngineSettings engine;
  double of_mass_kg = 1000.0;      // to which the engine belongs
  std::vector<double> ratios;      // engine over wheels, by gear
  double efficiency = 0.93;        // of gears
  double labours_radps = 150.0;    // below it no higher gear is taken
  double drag_area_m2 = 0.5;       // c_d A
  double rolling = 0.012;
};

double Rpm(double rpm) { return rpm * 2.0 * 3.14159265358979323846 / 60.0; }

// MOTORS, appendix A.19 and A.22.
Drivetrain MakeCar() {
  Drivetrain d;
  for (const auto& [rpm, torque] : {std::pair{1000.0, 87.5}, {3500.0, 115.5}, {6499.0, 62.5}}) d.engine.full_load.push_back({Rpm(rpm), torque});
  for (const double gear : {3.46, 1.96, 1.39, 1.03, 0.85}) d.ratios.push_back(4.19 * gear);
  d.of_mass_kg = 1050.0;
  d.labours_radps = Rpm(1500.0);
  return d;
}

// A diesel of six cylinders as lorries of 16 t and city buses have it: 1100 N m from 1200 to 1600 rpm.
Drivetrain MakeHeavy() {
  Drivetrain d;
  for (const auto& [rpm, torque] : {std::pair{600.0, 600.0}, {1200.0, 1100.0}, {1600.0, 1100.0}, {2300.0, 800.0}}) d.engine.full_load.push_back({Rpm(rpm), torque});
  for (const double gear : {6.70, 3.81, 2.29, 1.48, 1.0, 0.73}) d.ratios.push_back(5.0 * gear);
  d.of_mass_kg = 11000.0;
  d.engine.drag_Nm = 80.0;
  d.engine.drag_Nmspr = 0.5;
  d.engine.idle_radps = Rpm(600.0);
  d.labours_radps = Rpm(950.0);
  d.drag_area_m2 = 5.5;
  d.rolling = 0.008;
  return d;
}

const Drivetrain& DrivetrainOf(VehicleKind kind) {
  static const Drivetrain kCar = MakeCar(), kHeavy = MakeHeavy();
  return kind == VehicleKind::kLorry || kind == VehicleKind::kBus ? kHeavy : kCar;
}

}  // namespace

Driving DrivingFor(const AgentTraits& traits, double speed_mps, double acceleration_mps2, double grade) {
  const Drivetrain& d = DrivetrainOf(traits.kind);
  const double v = speed_mps, m = traits.mass_kg, idle = d.engine.idle_radps, size = m / d.of_mass_kg;
  if (v < kAtRest_mps && acceleration_mps2 <= 0.0) return {0.0, kHolding, 1.0, idle, 1};
  const double cosine = 1.0 / std::hypot(1.0, grade);
  const double force = m * (acceleration_mps2 + kGravity_mps2 * cosine * (grade + d.rolling)) + 0.5 * kAir_kgpm3 * d.drag_area_m2 * v * v;
  const double at_wheels_Nm = force * traits.wheel_radius_m;
  const auto turns = [&](std::size_t gear) { return v / traits.wheel_radius_m * d.ratios[gear]; };
  const auto full = [&](std::size_t gear) { return size * vehicle::FullLoadTorque(d.engine, std::max(idle, turns(gear))); };
  const auto reaches = [&](std::size_t gear) { return full(gear) * d.ratios[gear] * d.efficiency >= at_wheels_Nm; };
  std::size_t gear = d.ratios.size() - 1;
  while (gear > 0 && (turns(gear) < d.labours_radps || (!reaches(gear) && turns(gear - 1) < d.engine.resume_radps))) --gear;
  Driving driving;
  driving.gear = static_cast<int>(gear) + 1;
  driving.engine_radps = std::max(idle, turns(gear));
  driving.clutch = std::clamp(1.0 - turns(gear) / idle, 0.0, 1.0);
  const double drag = size * vehicle::DragTorque(d.engine, driving.engine_radps);
  const double wanted = at_wheels_Nm > 0.0 ? at_wheels_Nm / (d.ratios[gear] * d.efficiency) : at_wheels_Nm * d.efficiency / d.ratios[gear];
  const bool coasts = force < 0.0 && driving.clutch > 0.0;
  driving.throttle = coasts ? 0.0 : std::clamp((wanted + drag) / (full(gear) + drag), 0.0, 1.0);
  const double engine_brakes_N = drag * d.ratios[gear] / (d.efficiency * traits.wheel_radius_m) * (1.0 - driving.clutch);
  driving.brake = std::clamp((-force - engine_brakes_N) / (m * kFullBrake_mps2), 0.0, 1.0);
  return driving;
}

}  // namespace rodeira::traffic
