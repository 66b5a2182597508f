// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "common/vehicle/dynamics/multibody_model.hpp"
#include "tests/common/vehicle/dynamics/test_ground.hpp"

namespace rodeira::dynamics {

// A rig that the multibody car drives on: a field of acceleration acts on all bodies as a bend's would, so that it
// rolls and shifts its loads as in a bend, but keeps it going straight ahead at a heading of its own. Axle forces over
// slip angles are the axles' cornering stiffnesses, with all that rolling and yielding does to them.
class RigLoad final : public multibody::Load {
 public:
  RigLoad(const multibody::Drawing& drawing, int chassis)
      : frame_(drawing.bodies[static_cast<std::size_t>(chassis)].frame) {
    for (const auto& body : drawing.bodies) bodies_.emplace_back(body.mass_kg, body.centre);
    ground_ = frame_.PointAt(Eigen::Vector3d::Zero());
  }
  void Hold(double heading_rad, double speed_mps) {
    heading_rad_ = heading_rad;
    speed_mps_ = speed_mps;
  }

  void Add(const multibody::Motion& motion, multibody::Sink& sink) const override {
    if (speed_mps_ == 0.0) return;  // not on the rig as yet
    Eigen::Vector3d at = Eigen::Vector3d::Zero(), v = Eigen::Vector3d::Zero();
    double mass = 0.0;
    for (const auto& [each, centre] : bodies_) {
      mass += each;
      at += each * multibody::Evaluate(centre, motion.q);
      v += each * multibody::Evaluate(centre, motion.qd);
    }
    at /= mass;
    v /= mass;
    constexpr double kFast = 20.0, kYawInertia_kgm2 = 600.0;  // rad/s, well damped
    const Eigen::Vector3d field(0.0, -kFast * (kFast * at.y() + 2.0 * v.y()), 0.0);
    for (const auto& [each, centre] : bodies_) sink.Push(centre, each * field);
    sink.Push(ground_, {5.0 * mass * (speed_mps_ - v.x()), 0.0, 0.0});  // where the driven wheels would push
    const Eigen::Vector3d ahead = multibody::Evaluate(frame_.axes[0], motion.q);
    const Eigen::Vector3d turning = ahead.cross(multibody::Evaluate(frame_.axes[0], motion.qd));
    const double off = std::atan2(ahead.y(), ahead.x()) - heading_rad_;
    sink.PushTorque(frame_, {0.0, 0.0, -kYawInertia_kgm2 * kFast * (kFast * off + 2.0 * turning.z())}, motion.q);
  }

 private:
  multibody::Frame frame_;
  multibody::Form ground_;
  std::vector<std::pair<double, multibody::Form>> bodies_;
  double heading_rad_ = 0.0;
  double speed_mps_ = 0.0;
};

struct AxleStiffness {
  double front_Nprad = 0.0, rear_Nprad = 0.0;
  double front_to_centre_m = 0.0, centre_to_rear_m = 0.0;  // of the whole car's mass
  double front_share = 0.0, rear_share = 0.0;              // of the side force in a bend: aligning moments shift them
  double mass_kg = 0.0;
  double steering_ratio = 0.0;  // of the linkage alone, nothing yielding

  double wheelbase_m() const { return front_to_centre_m + centre_to_rear_m; }
  // rad per m/s²
  double UndersteerGradient() const { return mass_kg * (front_share / front_Nprad - rear_share / rear_Nprad); }
};

// Where the mass is, along x, as drawn.
inline double CentreOfMass(const MultibodySettings& settings) {
  std::vector<double> drawn;
  for (const auto& entity : settings.mechanism.entities)
    drawn.insert(drawn.end(), entity.at.data(), entity.at.data() + 3);
  double moment = 0.0;
  for (const auto& body : settings.mechanism.bodies)
    moment += body.mass_kg * multibody::Evaluate(body.centre, drawn.data()).x();
  return moment / settings.mass_kg;
}

// Two small loads, one by the heading (both axles slip) and one by the steering wheel (the front axle slips), are put
// together so that side forces and aligning moments balance about the centre of mass, as they do in a bend.
inline AxleStiffness MeasureAxles(MultibodySettings settings, double speed_mps) {
  const auto rig = std::make_shared<RigLoad>(settings.mechanism, settings.chassis);
  settings.mechanism.loads.push_back({"rig", rig});
  MultibodyModel car(settings);
  EXPECT_TRUE(car.Build().ok());
  const auto drive = [&](double heading_rad, double wheel_rad, double friction) {
    ground::PlaneGround ground(Eigen::Vector3d::Zero(), 0.0, 0.0, friction);
    rig->Hold(0.0, 0.0);
    EXPECT_TRUE(car.Initialise({.heading_rad = heading_rad, .speed_mps = speed_mps}, ground).ok());
    rig->Hold(heading_rad, speed_mps);
    Controls controls;
    controls.gearbox = GearboxMode::kManual;
    controls.gear = 0;
    controls.steering_wheel_rad = wheel_rad;
    for (int i = 0; i < 1500; ++i) car.Step(controls, ground, 0.001);
    // Side force of the axles, front wheels' angle, aligning moment of all tyres.
    Eigen::Vector4d result = Eigen::Vector4d::Zero();
    for (std::size_t i = 0; i < kWheels; ++i) {
      const WheelState& w = car.state().wheels[i];
      result[i < 2 ? 0 : 1] += w.lateral_N * std::cos(w.steer_rad) + w.longitudinal_N * std::sin(w.steer_rad);
      if (i < 2) result[2] += 0.5 * w.steer_rad;
      result[3] += w.aligning_Nm;
    }
    return result;
  };
  AxleStiffness axles;
  axles.mass_kg = settings.mass_kg;
  const double centre = CentreOfMass(settings);
  double front = 0.0, rear = 0.0;
  for (std::size_t i = 0; i < kWheels; ++i)
    (i < 2 ? front : rear) +=
        0.5 * settings.mechanism.entities[static_cast<std::size_t>(settings.wheels[i].centre)].at.x();
  axles.front_to_centre_m = front - centre;
  axles.centre_to_rear_m = centre - rear;
  constexpr double kHeading = 0.004, kWheel = 0.064;
  axles.steering_ratio = 2.0 * kWheel / (drive(0.0, kWheel, 1e-9) - drive(0.0, -kWheel, 1e-9))[2];
  const Eigen::Vector4d crab = (drive(kHeading, 0.0, 1.0) - drive(-kHeading, 0.0, 1.0)) / (2.0 * kHeading);
  const Eigen::Vector4d steer =
      (drive(0.0, kWheel, 1.0) - drive(0.0, -kWheel, 1.0)) / (2.0 * kWheel / axles.steering_ratio);
  const auto turns = [&](const Eigen::Vector4d& by) {
    return axles.front_to_centre_m * by[0] - axles.centre_to_rear_m * by[1] + by[3];
  };
  Eigen::Matrix2d balance;
  balance << crab[0] + crab[1], steer[0] + steer[1], turns(crab), turns(steer);
  const Eigen::Vector2d slip = balance.inverse() * Eigen::Vector2d(1.0, 0.0);  // heading, steering per newton
  axles.front_share = crab[0] * slip[0] + steer[0] * slip[1];
  axles.rear_share = crab[1] * slip[0] + steer[1] * slip[1];
  axles.front_Nprad = axles.front_share / (slip[0] + slip[1]);
  axles.rear_Nprad = axles.rear_share / slip[0];
  return axles;
}

}  // namespace rodeira::dynamics
