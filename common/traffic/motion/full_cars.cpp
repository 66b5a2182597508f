// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/motion/full_cars.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/assert.hpp"
#include "common/core/base/constants.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/traffic/motion/car_of.hpp"
#include "common/traffic/motion/hands.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kMinPlanSpeed_mps = 1e-3;
constexpr double kAsFast = 1.05;  // an engine that turns faster than this share of what its wheels ask for slips
constexpr double kSlows_mps2 = -0.3;
constexpr double kSlipFrom_mps = 1.0;  // slower, the motion of the rear axle says nothing of its slip angle

// The car's present limits as its driver assumes them: the engine's force in the engaged gear.
driver::PedalSettings PedalsOf(const dynamics::BicycleChassis& chassis, const dynamics::Powertrain& powertrain,
                               double speed_mps, double wanted_mps2) {
  const dynamics::BicycleSettings& car = chassis.settings;
  const dynamics::PowertrainSettings& p = car.powertrain;
  const double m = car.body.mass_kg, radius = car.wheel.rolling_radius_m;
  const double ratio = dynamics::TotalRatio(p.gearbox, std::max(1, powertrain.gear()));
  const double radps = std::max({p.engine.idle_radps, p.automatic.bite_radps, ratio * speed_mps / radius});
  const double drag_Nm = dynamics::DragTorque(p.engine, radps), full_Nm = dynamics::FullLoadTorque(p.engine, radps);
  const double engine_mps2 = p.gearbox.efficiency * ratio / (radius * m);  // of one newton metre
  driver::PedalSettings feet;
  feet.power_Wpkg = 1e6;
  feet.most_mps2 = engine_mps2 * (full_Nm + drag_Nm);
  feet.full_brake_mps2 = FullBrake_N(car) / m;
  feet.coasting_mps2 = 0.0;  // it is in the next: the throttle begins to push where it has overcome the engine's drag
  // A car that slows down with the clutch pressed has no drag of the engine, nor while the engine, not yet as slow
  // as the wheels, still pushes through a clutch that slips.
  const bool pushes = powertrain.engine().speed_radps() > kAsFast * ratio * speed_mps / radius;
  const double held = pushes ? 0.0 : 1.0 - powertrain.clutch(), drags = wanted_mps2 < 0.0 ? held : 1.0;
  // What turns with the wheels is to be sped up and slowed down as well: in a lorry's first gear the engine weighs as
  // much as the lorry.
  const double turning_kgm2 = dynamics::kWheels * car.wheel.inertia_kgm2 + held * ratio * ratio * p.engine.inertia_kgm2;
  const double turning_mps2 = wanted_mps2 * turning_kgm2 / (radius * radius * m);
  feet.rolling_mps2 = base::kGravity_mps2 * car.wheel.rolling_resistance + drags * engine_mps2 * drag_Nm + turning_mps2;
  feet.air_1pm = 0.5 * car.body.air_density_kgpm3 * car.body.drag_area_m2 / m;
  return feet;
}

}  // namespace

FullCars::FullCars(std::shared_ptr<ground::Ground> ground, std::size_t agents)
    : ground_(std::move(ground)), controls_(agents), feet_(agents) {
  for (std::uint32_t body = 0; body < kBodies; ++body) {
    const auto kind = cars_.AddKind(CarOfBody(body));
    RODEIRA_ASSERT(kind.ok() && kind.value() == body);
  }
  cars_.Resize(agents);
}

base::Status FullCars::Place(std::uint32_t id, std::uint32_t body, const dynamics::InitialCondition& initial) {
  if (const base::Status status = cars_.Place(id, body, initial, *ground_); !status) return status;
  controls_[id] = {};
  feet_[id] = {};
  if (initial.speed_mps > 0.0)
    feet_[id].InitialiseFrom(cars_.car(id).powertrain.engine().throttle(), 0.0, initial.speed_mps);
  return {};
}

Eigen::Vector2d FullCars::RearAxle_W(std::uint32_t id) const {
  const Eigen::Vector3d ahead_W = cars_.car(id).body.q_WG * Eigen::Vector3d::UnitX();
  return (cars_.p_WB_W(id) - 0.5 * cars_.chassis(id).settings.body.wheelbase_m * ahead_W).head<2>();
}

// With rear wheels that do not slide the middle moves by atan(½ tan δ) off where the car points.
double FullCars::PlanSpeed_mps(std::uint32_t id) const {
  const Eigen::Vector2d v = cars_.car(id).body.VelocityAt(cars_.p_WB_W(id)).head<2>();
  if (v.norm() < kMinPlanSpeed_mps) return 0.0;
  const Eigen::Vector2d ahead = (cars_.car(id).body.q_WG * Eigen::Vector3d::UnitX()).head<2>().normalized(),
                        left(-ahead.y(), ahead.x());
  const double half =
      0.5 * std::tan(cars_.chassis(id).SteerAngle(dynamics::kFrontLeft, controls_[id].steering_wheel_rad));
  return (v.dot(ahead) + half * v.dot(left)) / std::hypot(1.0, half);
}

double FullCars::SteeringWheel(std::uint32_t id, const PathAhead& path, double dt_s) const {
  const dynamics::BicycleCar& car = cars_.car(id);
  const dynamics::BicycleSettings& settings = cars_.chassis(id).settings;
  const Eigen::Vector2d ahead = (car.body.q_WG * Eigen::Vector3d::UnitX()).head<2>().normalized(),
                        left(-ahead.y(), ahead.x());
  const Eigen::Vector3d rear_W =
      cars_.p_WB_W(id) - 0.5 * settings.body.wheelbase_m * (car.body.q_WG * Eigen::Vector3d::UnitX());
  const Eigen::Vector2d v = car.body.VelocityAt(rear_W).head<2>();
  const double slip = std::atan2(v.dot(left), std::max(kSlipFrom_mps, v.dot(ahead)));
  const Eigen::Vector2d path_left(-path.ahead_W.y(), path.ahead_W.x());
  const RearBeside rear{std::atan2(ahead.dot(path_left), ahead.dot(path.ahead_W)) + slip,
                        (rear_W.head<2>() - path.rear_W).dot(path_left), path.curvature_1pm, v.norm()};
  return MovedWheel_rad(settings, rear, controls_[id].steering_wheel_rad, dt_s);
}

void FullCars::Drive(std::uint32_t id, double wanted_mps2, const PathAhead& path, double dt_s) {
  const dynamics::BicycleCar& car = cars_.car(id);
  const Eigen::Vector3d ahead_W = car.body.q_WG * Eigen::Vector3d::UnitX();
  const double speed = PlanSpeed_mps(id), grade = ahead_W.z() / std::max(1e-3, std::hypot(ahead_W.x(), ahead_W.y()));
  dynamics::Controls& controls = controls_[id];
  // A car that slows down does not first make good the speed that its engine was too weak to come to.
  driver::Pedals& foot = feet_[id];
  if (wanted_mps2 < kSlows_mps2 && !foot.holds() && foot.throttle() > 0.0 && foot.reference_mps() > speed)
    foot.InitialiseFrom(foot.throttle(), foot.brake(), speed);
  foot.Step(PedalsOf(cars_.chassis(id), car.powertrain, speed, wanted_mps2), wanted_mps2, speed, grade, dt_s);
  controls.throttle = foot.throttle();
  controls.brake = foot.brake();
  controls.steering_wheel_rad = SteeringWheel(id, path, dt_s);
}

void FullCars::Step(double dt_s, base::ThreadPool* pool) { cars_.Step(controls_, *ground_, dt_s, pool); }

Driving FullCars::DrivingOf(std::uint32_t id) const {
  const dynamics::Powertrain& powertrain = cars_.car(id).powertrain;
  return {powertrain.engine().throttle(), controls_[id].brake, powertrain.clutch(), powertrain.engine().speed_radps(),
          powertrain.gear()};
}

void FullCars::Tell(std::uint32_t id, AgentPose& pose) const {
  const dynamics::BicycleCar& car = cars_.car(id);
  pose.p_WB_W = cars_.p_WB_W(id);
  pose.q_WB = car.body.q_WG;
  pose.steer_rad = cars_.chassis(id).SteerAngle(dynamics::kFrontLeft, controls_[id].steering_wheel_rad);
  pose.wheel_spin_rad = car.wheels[dynamics::kFrontLeft].spin_rad;
}

void FullCars::Save(base::StateWriter& writer) const {
  writer.Put("cars", cars_);
  for (std::size_t i = 0; i < controls_.size(); ++i) {
    if (!cars_.present(i)) continue;
    writer.Put("controls", controls_[i]);
    writer.Put("feet", feet_[i]);
  }
}

void FullCars::Restore(base::StateReader& reader) {
  reader.Get("cars", cars_);
  for (std::size_t i = 0; i < controls_.size(); ++i) {
    controls_[i] = {};
    feet_[i] = {};
    if (!cars_.present(i)) continue;
    reader.Get("controls", controls_[i]);
    reader.Get("feet", feet_[i]);
  }
}

}  // namespace rodeira::traffic
