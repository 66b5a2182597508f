#include "nodes/view/chosen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rodeira::view {
namespace {

constexpr double kMoving_mps = 1.0, kDriven_m = 10.0;  // less says nothing of litres for 100 km

std::string GearName(std::int32_t gear) { return gear < 0 ? "R" : gear == 0 ? "N" : fmt::format("{}", gear); }

template <class Pose>
std::optional<std::size_t> Find(const std::vector<Pose>& poses, std::uint64_t id) {
  const auto found = std::find_if(poses.begin(), poses.end(), [id](const Pose& pose) { return pose.id == id; });
  return found == poses.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - poses.begin()));
}

}  // namespace

void Chosen::Choose(const scene::Moment& moment, std::optional<std::size_t> number) {
  who_.reset();
  if (!number) return;
  const std::size_t cars = moment.cars.size();
  if (*number < cars) {
    const scene::CarPose& car = moment.cars[*number];
    who_ = Who{true, car.id};
    since_ns_ = moment.time_ns;
    since_l_ = car.fuel_l;
    since_m_ = car.odometer_m;
  } else if (*number - cars < moment.agents.size()) {
    who_ = Who{false, moment.agents[*number - cars].id};
  }
}

std::optional<std::size_t> Chosen::In(const scene::Moment& moment) const {
  if (!who_) return std::nullopt;
  if (who_->is_car) return Find(moment.cars, who_->id);
  const auto found = Find(moment.agents, who_->id);
  return found ? std::optional(moment.cars.size() + *found) : std::nullopt;
}

std::string Chosen::Panel(const scene::Moment& moment) {
  const auto at = In(moment);
  if (!at) return "";
  if (!who_->is_car) {
    const scene::AgentPose& agent = moment.agents[*at - moment.cars.size()];
    return fmt::format("traffic {}\n{:.1f} km/h{}\nwheels {:.1f} deg", agent.id >> 24 & 0xffffffU, 3.6 * agent.speed_mps, agent.lights.brake ? "   brakes" : "",
                       agent.steer_rad * 180.0 / std::numbers::pi);
  }
  const scene::CarPose& car = moment.cars[*at];
  if (moment.time_ns < since_ns_ || car.odometer_m < since_m_) Choose(moment, at);  // somebody went back in a recording
  const double driven_m = car.odometer_m - since_m_;
  const std::string now = std::fabs(car.speed_mps) > kMoving_mps ? fmt::format("{:.1f} l/100 km", car.fuel_lph / (3.6 * std::fabs(car.speed_mps)) * 100.0)
                                                                  : fmt::format("{:.1f} l/h", car.fuel_lph);
  const std::string mean = driven_m > kDriven_m ? fmt::format("{:.1f} l/100 km over {:.2f} km", (since_l_ - car.fuel_l) / driven_m * 1e5, driven_m * 1e-3) : "-";
  return fmt::format("{:.1f} km/h   gear {}   {:.0f} 1/min\nthrottle {:.0f} %   brake {:.0f} %\nsteering wheel {:.0f} deg\nnow {}\nmean {}", 3.6 * std::fabs(car.speed_mps), GearName(car.gear),
                     car.engine_rpm, 100.0 * car.throttle, 100.0 * car.brake, car.steering_wheel_rad * 180.0 / std::numbers::pi, now, mean);
}

}  // namespace rodeira::view
