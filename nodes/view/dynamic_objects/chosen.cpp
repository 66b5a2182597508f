// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/dynamic_objects/chosen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/core/base/constants.hpp"
#include "nodes/view/overlays/gear_name.hpp"

namespace rodeira::nodes {
namespace {

constexpr double kMoving_mps = 1.0, kDriven_m = 10.0;  // less says nothing of litres for 100 km

// Consumption at the moment.
std::string Now(double fuel_lph, double speed_mps) {
  return std::fabs(speed_mps) > kMoving_mps
             ? fmt::format("{:.1f} l/100 km", fuel_lph / (3.6 * std::fabs(speed_mps)) * 100.0)
             : fmt::format("{:.1f} l/h", fuel_lph);
}

std::string Mean(double fuel_l, double driven_m) {
  return driven_m > kDriven_m ? fmt::format("{:.1f} l/100 km over {:.2f} km", fuel_l / driven_m * 1e5, driven_m * 1e-3)
                              : "-";
}

template <class Pose>
std::optional<std::size_t> Find(const std::vector<Pose>& poses, std::uint64_t id) {
  const auto found = std::find_if(poses.begin(), poses.end(), [id](const Pose& pose) { return pose.id == id; });
  return found == poses.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - poses.begin()));
}

}  // namespace

void Chosen::Choose(const scene::SceneSnapshot& moment, std::optional<std::size_t> number) {
  vehicle_.reset();
  if (!number) return;
  const std::size_t cars = moment.cars.size();
  if (*number < cars) {
    const scene::CarPose& car = moment.cars[*number];
    vehicle_ = Vehicle{true, car.id};
    since_ns_ = moment.time_ns;
    since_l_ = car.fuel_used_l;
    since_m_ = car.odometer_m;
  } else if (*number - cars < moment.agents.size()) {
    const scene::AgentPose& agent = moment.agents[*number - cars];
    vehicle_ = Vehicle{false, agent.id};
    since_ns_ = seen_ns_ = moment.time_ns;
    since_l_ = agent.detail ? agent.detail->fuel_used_l : 0.0;
    seen_W_ = agent.p_WB_W;
    seen_m_ = 0.0;
  }
}

std::optional<std::size_t> Chosen::In(const scene::SceneSnapshot& moment) const {
  if (!vehicle_) return std::nullopt;
  if (vehicle_->is_car) return Find(moment.cars, vehicle_->id);
  const auto found = Find(moment.agents, vehicle_->id);
  return found ? std::optional(moment.cars.size() + *found) : std::nullopt;
}

std::string Chosen::Panel(const scene::SceneSnapshot& moment) {
  const auto at = In(moment);
  if (!at) return "";
  if (!vehicle_->is_car) return AgentPanel(moment, moment.agents[*at - moment.cars.size()]);
  const scene::CarPose& car = moment.cars[*at];
  if (moment.time_ns < since_ns_ || car.odometer_m < since_m_) Choose(moment, at);  // a person went back in a recording
  const double driven_m = car.odometer_m - since_m_;
  return fmt::format(
      "{:.1f} km/h   gear {}   {:.0f} 1/min\nthrottle {:.0f} %   brake {:.0f} %\nsteering wheel {:.0f} deg\nnow "
      "{}\nmean {}",
      3.6 * std::fabs(car.speed_mps), GearName(car.gear), car.engine_rpm, 100.0 * car.throttle, 100.0 * car.brake,
      car.steering_wheel_rad * 180.0 / base::kPi, Now(car.fuel_lph, car.speed_mps),
      Mean(car.fuel_used_l - since_l_, driven_m));
}

std::string Chosen::AgentPanel(const scene::SceneSnapshot& moment, const scene::AgentPose& agent) {
  if (moment.time_ns < seen_ns_ || (agent.detail && agent.detail->fuel_used_l < since_l_))
    Choose(moment, In(moment));  // a person went back in a recording
  seen_m_ += (agent.p_WB_W - seen_W_).norm();
  seen_W_ = agent.p_WB_W;
  seen_ns_ = moment.time_ns;
  const std::string name = fmt::format("traffic {}", agent.id >> 24 & 0xffffffU);
  if (agent.kind == scene::AgentKind::kPedestrian)
    return fmt::format("{}\non foot, {:.1f} km/h", name, 3.6 * agent.speed_mps);
  const double wheels_deg = agent.steer_rad * 180.0 / base::kPi;
  if (!agent.detail)
    return fmt::format("{}\n{:.1f} km/h{}\nwheels {:.1f} deg", name, 3.6 * agent.speed_mps,
                       agent.lights.brake ? "   brakes" : "", wheels_deg);
  const scene::AgentDetail& detail = *agent.detail;
  return fmt::format(
      "{}   {:.1f} km/h of {:.0f}\ngear {}   {:.0f} 1/min\nthrottle {:.0f} %   brake {:.0f} %\nclutch {:.0f} %   "
      "wheels {:.1f} deg\nnow {}\nmean {}",
      name, 3.6 * agent.speed_mps, 3.6 * detail.target_speed_mps, GearName(detail.gear), detail.engine_rpm,
      100.0 * detail.throttle, 100.0 * detail.brake, 100.0 * detail.clutch, wheels_deg,
      Now(detail.fuel_lph, agent.speed_mps), Mean(detail.fuel_used_l - since_l_, seen_m_));
}

}  // namespace rodeira::nodes
