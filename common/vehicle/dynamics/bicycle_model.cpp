// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/bicycle_model.hpp"

#include <cmath>

#include "common/core/base/assert.hpp"
#include "common/vehicle/dynamics/edge_contact.hpp"
#include "common/vehicle/dynamics/enveloping.hpp"

namespace rodeira::dynamics {

void BicycleModel::QueryGround(ground::Ground& ground, double steering_wheel_rad) {
  WheelPlaces places;
  std::array<WheelGround*, kWheels> wheels{};
  for (std::size_t i = 0; i < kWheels; ++i) {
    const double steer = chassis_.SteerAngle(i, steering_wheel_rad);
    places.hubs_W[i] = car_.HubAtRest_W(chassis_, i);
    places.axles_W[i] = car_.body.q_WG * Eigen::Vector3d(-std::sin(steer), std::cos(steer), 0.0);
    wheels[i] = &car_.wheels[i];
  }
  dynamics::QueryGround(ground, settings().wheel.enveloping, settings().wheel.radius_m, places, wheels);
}

void BicycleModel::Step(const Controls& controls, ground::Ground& ground, double dt_s) {
  RODEIRA_ASSERT(dt_s > 0.0 && dt_s <= kMaxStep_s);
  const Controls clamped = Clamp(controls);
  std::array<WheelGround, kWheels> before;
  for (std::size_t i = 0; i < kWheels; ++i) before[i] = car_.wheels[i];
  QueryGround(ground, clamped.steering_wheel_rad);
  car_.RollOn(chassis_, before);
  car_.Step(chassis_, clamped, push_, dt_s, findings_);
  push_ = {};
  Publish(clamped, dt_s);
}

}  // namespace rodeira::dynamics
