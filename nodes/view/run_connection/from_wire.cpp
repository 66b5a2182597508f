// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/run_connection/from_wire.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "common/core/base/constants.hpp"
#include "idl/codec.hpp"
#include "idl/topics.hpp"
#include "nodes/messages/vectors.hpp"

namespace rodeira::nodes {
namespace {

constexpr std::array<scene::Colour, 4> kPaints = {scene::Colour::Of(0xb01e26), scene::Colour::Of(0x1e4fa0),
                                                  scene::Colour::Of(0xd9b11e), scene::Colour::Of(0x2b7a3d)};

constexpr std::uint64_t kIdBits = 0xffffffU;  // of an agent's own number within the scene's
constexpr double kPetrol_kgpl = 0.745;        // as gauges count it

double Double(float value) { return static_cast<double>(value); }

// What lies outside of what can be (a recording from elsewhere) is cut to it.
weather::Weather WeatherOf(const msg::WeatherState& message) {
  const auto cut = [](double value, double low, double high) { return value >= low ? std::min(value, high) : low; };
  return {cut(message.wetness(), 0.0, 1.0), cut(message.rain_mmph(), 0.0, 200.0),
          cut(message.visibility_m(), 10.0, weather::kClear_m), cut(message.clouds(), 0.0, 1.0),
          cut(message.hour(), 0.0, 24.0)};
}

// Of an agent that stood there, heading so, when it was said.
scene::AgentDetail DetailOf(const msg::TrafficDetail& message, const Eigen::Vector2d& at_W, double heading_rad) {
  scene::AgentDetail detail;
  detail.throttle = std::clamp(Double(message.throttle()), 0.0, 1.0);
  detail.brake = std::clamp(Double(message.brake()), 0.0, 1.0);
  detail.clutch = std::clamp(Double(message.clutch()), 0.0, 1.0);
  detail.gear = message.gear();
  detail.engine_rpm = Double(message.engine_speed_radps()) * 30.0 / base::kPi;
  detail.fuel_lph = 3600.0 * Double(message.fuel_rate_kgps()) / kPetrol_kgpl;
  detail.fuel_used_l = Double(message.fuel_used_kg()) / kPetrol_kgpl;
  detail.target_speed_mps = Double(message.target_speed_mps());
  const Eigen::Vector2d target_W(Double(message.target_x_m()), Double(message.target_y_m()));
  detail.target_B = Eigen::Rotation2Dd(-heading_rad) * (target_W - at_W);
  detail.path_turn_rad = std::remainder(Double(message.path_heading_rad()) - heading_rad, 2.0 * base::kPi);
  detail.look_ahead_W = {Double(message.look_ahead_x_m()), Double(message.look_ahead_y_m())};
  return detail;
}

// The traffic of a node and what it says of it are two of its streams; the second one was said so long ago, and the car
// has gone straight on since.
void AddDetails(const lockstep::Roster& roster, lockstep::NodeIndex node, const msg::TrafficDetails& message,
                double age_s, std::vector<scene::AgentPose>& agents) {
  std::map<std::uint64_t, const msg::TrafficDetail*> by_id;
  for (const msg::TrafficDetail& detail : message.agents()) by_id[detail.id() & kIdBits] = &detail;
  for (scene::AgentPose& agent : agents) {
    if (roster.source(static_cast<lockstep::SourceIndex>(agent.id >> 48)).node != node) continue;
    const auto found = by_id.find(agent.id >> 24 & kIdBits);
    if (found == by_id.end()) continue;
    const Eigen::Vector3d ahead_W = agent.q_WB * Eigen::Vector3d::UnitX();
    const Eigen::Vector2d at_W = (agent.p_WB_W - age_s * agent.speed_mps * ahead_W).head<2>();
    agent.detail = DetailOf(*found->second, at_W, std::atan2(ahead_W.y(), ahead_W.x()));
  }
}

// Bits as in vehicle.idl.
scene::CarLights LightsOf(std::uint32_t bits) {
  const auto on = [bits](std::uint32_t bit) { return (bits & bit) != 0; };
  return {on(1), on(2), on(4), on(8), on(16), on(32)};
}

// Tyres begin to be heard beyond the slip of their greatest force, some 0.12, and where the car moves.
double Sliding(const msg::VehicleState& message) {
  double most = 0.0;
  for (const msg::WheelState& wheel : message.wheels()) {
    if (wheel.in_contact() == 0) continue;
    const double slip = std::hypot(Double(wheel.slip()), Double(wheel.slip_angle_tan())),
                 moving = std::fabs(Double(wheel.spin_radps())) * 0.3 + FromMessage(message.velocity_w_mps()).norm();
    most = std::max(most, std::clamp((slip - 0.12) / 0.3, 0.0, 1.0) * std::clamp(moving / 5.0 - 0.2, 0.0, 1.0));
  }
  return most;
}

// Tyres alone do not accelerate a car by more than some 12 m/s2 in the plane.
double Blow(const msg::VehicleState& message) {
  const double level = std::hypot(Double(message.acceleration_w_mps2().x()), Double(message.acceleration_w_mps2().y()));
  return std::clamp((level - 25.0) / 150.0, 0.0, 1.0);
}

}  // namespace

scene::CarPose CarPoseOf(const msg::VehicleState& message, std::uint32_t source, std::size_t order) {
  scene::CarPose car;
  car.id = source;
  car.colour = kPaints[order % kPaints.size()];
  car.p_WB_W = FromMessage(message.position_w_m());
  car.q_WB = FromMessage(message.attitude_wb()).normalized();
  for (std::size_t i = 0; i < car.wheels.size(); ++i) {
    const msg::WheelState& wheel = message.wheels()[i];
    car.wheels[i] = {FromMessage(wheel.hub_b_m()), Double(wheel.steer_rad()), Double(wheel.spin_rad()),
                     Double(wheel.spin_radps())};
  }
  car.speed_mps = (car.q_WB.conjugate() * FromMessage(message.velocity_w_mps())).x();
  car.brake = Double(message.brake());
  car.lights = LightsOf(message.lights());
  car.gear = message.gear();
  car.engine_rpm = message.engine_speed_radps() * 30.0 / base::kPi;
  car.fuel_used_l = message.fuel_used_kg() / kPetrol_kgpl;
  car.fuel_lph = 3600.0 * Double(message.fuel_rate_kgps()) / kPetrol_kgpl;
  car.odometer_m = message.odometer_m();
  car.steering_wheel_rad = message.steering_wheel_rad();
  car.throttle = std::clamp(Double(message.throttle()), 0.0, 1.0);
  car.horn = message.horn() != 0;
  car.sliding = Sliding(message);
  car.blow = Blow(message);
  if (message.length_m() > 0.0F && message.width_m() > 0.0F) {
    car.length_m = Double(message.length_m());
    car.front_m = Double(message.front_m());
    car.width_m = Double(message.width_m());
  }
  if (message.wheelbase_m() > 0.0F && message.wheel_radius_m() > 0.0F) {
    car.height_m = Double(message.height_m());
    car.wheelbase_m = Double(message.wheelbase_m());
    car.track_m = {Double(message.track_front_m()), Double(message.track_rear_m())};
    car.wheel_radius_m = Double(message.wheel_radius_m());
  }
  return car;
}

void AppendAgents(const msg::TrafficState& message, std::uint32_t source, std::vector<scene::AgentPose>& agents) {
  const auto first = static_cast<std::ptrdiff_t>(agents.size());
  for (const msg::TrafficAgent& from : message.agents()) {
    scene::AgentPose agent;
    agent.id = (static_cast<std::uint64_t>(source) << 48) | ((from.id() & kIdBits) << 24) | (from.trip() & kIdBits);
    agent.colour = scene::Colour::Of(from.colour_rgb());
    agent.p_WB_W = {from.position_x_m(), from.position_y_m(), from.position_z_m()};
    agent.q_WB = scene::Attitude(Double(from.heading_rad()), Double(from.pitch_rad()), Double(from.roll_rad()));
    agent.speed_mps = from.speed_mps();
    agent.steer_rad = Double(from.steer_rad());
    agent.wheel_spin_rad = Double(from.wheel_spin_rad());
    agent.kind =
        static_cast<scene::AgentKind>(std::min(from.kind(), static_cast<std::uint32_t>(scene::AgentKind::kPedestrian)));
    agent.lights = LightsOf(from.lights());
    if (from.length_m() > 0.0F) agent.length_m = Double(from.length_m());
    if (from.width_m() > 0.0F) agent.width_m = Double(from.width_m());
    if (from.height_m() > 0.0F) agent.height_m = Double(from.height_m());
    if (from.wheelbase_m() > 0.0F) agent.wheelbase_m = Double(from.wheelbase_m());
    if (from.wheel_radius_m() > 0.0F) agent.wheel_radius_m = Double(from.wheel_radius_m());
    agents.push_back(agent);
  }
  std::sort(agents.begin() + first, agents.end(),
            [](const scene::AgentPose& a, const scene::AgentPose& b) { return a.id < b.id; });
}

void AddLights(const msg::SignalsState& message, std::vector<scene::LightShown>& lights) {
  const auto colour_of = [](std::uint32_t colour) {
    return static_cast<network::LightColour>(
        std::min(colour, static_cast<std::uint32_t>(network::LightColour::kAmber)));
  };
  for (const msg::SignalGroup& group : message.groups())
    lights.push_back({group.controller(), colour_of(group.colour())});
  std::stable_sort(lights.begin(), lights.end(),
                   [](const scene::LightShown& a, const scene::LightShown& b) { return a.controller < b.controller; });
}

bool SaysSomething(std::string_view topic, const base::Bytes& payload) {
  if (topic != idl::topics::kTrafficDetails) return true;
  const auto message = idl::Decode<msg::TrafficDetails>(payload);
  return !message || !message.value().agents().empty();  // what cannot be read is said where it is used
}

base::Result<scene::SceneSnapshot> MakeMoment(const lockstep::Roster& roster, lockstep::Step step,
                                              const NewestSamples& newest) {
  scene::SceneSnapshot moment;
  moment.time_ns = step * roster.base_step_ns();
  std::vector<std::pair<lockstep::NodeIndex, msg::TrafficDetails>> details;
  for (const auto& [source, payload] : newest) {
    if (roster.source(source).topic == idl::topics::kVehicleState) {
      const auto message = idl::Decode<msg::VehicleState>(*payload);
      if (!message) return message.error();
      moment.cars.push_back(CarPoseOf(message.value(), source, moment.cars.size()));
    } else if (roster.source(source).topic == idl::topics::kSignalsState) {
      const auto message = idl::Decode<msg::SignalsState>(*payload);
      if (!message) return message.error();
      AddLights(message.value(), moment.lights);
    } else if (roster.source(source).topic == idl::topics::kWeatherState) {
      const auto message = idl::Decode<msg::WeatherState>(*payload);
      if (!message) return message.error();
      moment.weather = WeatherOf(message.value());
    } else if (roster.source(source).topic == idl::topics::kTrafficDetails) {
      auto message = idl::Decode<msg::TrafficDetails>(*payload);
      if (!message) return message.error();
      details.emplace_back(roster.source(source).node, std::move(message).value());
    } else {
      const auto message = idl::Decode<msg::TrafficState>(*payload);
      if (!message) return message.error();
      AppendAgents(message.value(), source, moment.agents);
    }
  }
  for (const auto& [node, said] : details)
    AddDetails(roster, node, said, static_cast<double>(moment.time_ns - said.header().time_ns()) * 1e-9, moment.agents);
  return moment;
}

}  // namespace rodeira::nodes
