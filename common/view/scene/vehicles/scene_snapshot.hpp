// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "common/view/scene/mesh/mesh.hpp"
#include "common/view/scene/vehicles/car_lights.hpp"
#include "common/world/network/lights.hpp"
#include "common/world/weather/weather.hpp"

namespace rodeira::scene {

// A wheel on its car.
struct WheelPose {
  Eigen::Vector3d hub_B = Eigen::Vector3d::Zero();
  double steer_rad = 0.0;  // about B's z, positive to the left
  double spin_rad = 0.0;   // positive rolling forward
  double spin_radps = 0.0;
};

// A car with a model: the driver's.
struct CarPose {
  std::uint64_t id = 0;
  Colour colour = Colour::Of(0xb01e26);
  Eigen::Vector3d p_WB_W = Eigen::Vector3d::Zero();
  Eigen::Quaterniond q_WB = Eigen::Quaterniond::Identity();
  std::array<WheelPose, 4> wheels;  // front left, front right, rear left, rear right
  double speed_mps = 0.0;           // forward
  double brake = 0.0;               // 0 … 1
  CarLights lights;
  std::int32_t gear = 0;
  double engine_rpm = 0.0, fuel_used_l = 0.0, fuel_lph = 0.0;  // litres burnt since the start, litres an hour
  double odometer_m = 0.0;
  double steering_wheel_rad = 0.0;  // positive to the left
  double throttle = 0.0;            // 0 … 1
  bool horn = false;
  double sliding = 0.0, blow = 0.0;                        // of its tyres, and against its body: 0 none … 1
  double length_m = 3.85, front_m = 2.01, width_m = 1.65;  // front bumper from B's origin
  double height_m = 1.42, wheelbase_m = 2.46, wheel_radius_m = 0.2915;  // at rest
  std::array<double, 2> track_m = {1.42, 1.42};                         // front, rear
};

enum class AgentKind { kCar, kVan, kLorry, kBus, kPedestrian };

// What an agent's driver and engine do.
struct AgentDetail {
  double throttle = 0.0, brake = 0.0, clutch = 0.0;  // 0 … 1; of the clutch 1 is disengaged
  std::int32_t gear = 0;
  double engine_rpm = 0.0, fuel_lph = 0.0;
  double fuel_used_l = 0.0;       // since it entered
  double target_speed_mps = 0.0;  // what its driver plans for here and now
  // The point that it steers for, ahead and to the left of B, and where its path leads beside it, from the car's
  // heading, positive to the left: both go with the car, as what was said of it is held for a tenth of a second.
  Eigen::Vector2d target_B = Eigen::Vector2d::Zero();
  double path_turn_rad = 0.0;
  Eigen::Vector2d look_ahead_W = Eigen::Vector2d::Zero();  // up to where it looks for what slows it
};

// A car of the traffic, or a pedestrian: B's origin is the middle of its footprint, between the axles, on the
// ground.
struct AgentPose {
  std::uint64_t id = 0;  // of one appearance: a vehicle that enters again elsewhere has another
  AgentKind kind = AgentKind::kCar;
  Colour colour;
  Eigen::Vector3d p_WB_W = Eigen::Vector3d::Zero();
  Eigen::Quaterniond q_WB = Eigen::Quaterniond::Identity();
  double speed_mps = 0.0;
  double steer_rad = 0.0;       // of the front wheels
  double wheel_spin_rad = 0.0;  // of a pedestrian: a turn in two steps
  CarLights lights;
  double length_m = 4.0, width_m = 1.7, height_m = 1.45, wheelbase_m = 2.5, wheel_radius_m = 0.3;
  std::optional<AgentDetail> detail;  // as it was said last; none where nothing is said of it
};

// Heading from east counter-clockwise, pitch positive nose down, roll positive left side up (ISO 8855).
Eigen::Quaterniond Attitude(double heading_rad, double pitch_rad, double roll_rad);

// What the lights of one of the network's controllers show.
struct LightShown {
  std::uint32_t controller = 0;  // its index
  network::LightColour colour = network::LightColour::kRed;
};

// All that moves and changes, at one time of the simulation.
struct SceneSnapshot {
  std::int64_t time_ns = 0;
  std::vector<CarPose> cars;       // ascending ids
  std::vector<AgentPose> agents;   // ascending ids
  std::vector<LightShown> lights;  // ascending controllers; the others are dark
  weather::Weather weather;
};

// (1 - alpha) a + alpha b with the same alpha for everything; alpha in [0, 1], 0 is exactly a and 1 exactly b.
// Attitudes turn on the shortest way, wheels turn on as fast as they did; lights and weather are a's below 0.5, and so
// is a car that was placed elsewhere in between. What is only in one of the two is not in the result, unless alpha is 0
// or 1.
SceneSnapshot Interpolate(const SceneSnapshot& a, const SceneSnapshot& b, double alpha);

// The last few moments, to draw those between them.
class PoseHistory {
 public:
  // A moment later than all before it; another one of the same time replaces it. The eight newest are kept.
  void Add(SceneSnapshot moment);
  bool empty() const { return moments_.empty(); }
  // The time of the last one; there must be one.
  std::int64_t newest_ns() const { return moments_.back().time_ns; }
  // The interval between the last two; 0 where there is only one.
  std::int64_t interval_ns() const;
  // At a time of the simulation, held within what is known; there must be one moment at least.
  SceneSnapshot At(double time_ns) const;

 private:
  static constexpr std::size_t kKept = 8;
  std::deque<SceneSnapshot> moments_;
};

}  // namespace rodeira::scene
