// SPDX-License-Identifier: Apache-2.0
#include "common/driving/driver/autopilot.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/assert.hpp"
#include "common/core/geometry/angle.hpp"

namespace rodeira::driver {
namespace {

constexpr double kStopHere_mps2 = -4.0;  // with nothing to drive on

}  // namespace

Autopilot::Autopilot(const AutopilotSettings& settings, std::unique_ptr<const Way> way)
    : settings_(settings), path_(std::move(way)), plan_(*path_, settings.speed) {}

SpeedPlan::Allowed Autopilot::AllowedTo(const Way::Place& place, double limit_mps, double speed_mps,
                                        double heading_rad) const {
  SpeedPlan::Allowed allowed = plan_.At(place.d_m + settings_.anticipation_s * std::max(0.0, speed_mps));
  if (allowed.speed_mps > limit_mps) allowed = {limit_mps, 0.0};
  const double turned = std::fabs(geometry::WrapAngle(heading_rad - place.heading_rad));
  if (std::fabs(place.offset_m) > settings_.far_off_m || turned > 0.5 * geometry::kPi)
    allowed = {std::min(allowed.speed_mps, settings_.slowly_mps), 0.0};
  return allowed;
}

double Autopilot::WantedAcceleration(const DriverView& view, const Way::Place& place) {
  const double speed = view.own.speed_mps();
  const double limit = settings_.speed_factor * path_->SpeedLimit_mps(place.d_m);
  const SpeedPlan::Allowed allowed = AllowedTo(place, limit, speed, view.own.heading_rad());
  allowed_mps_ = allowed.speed_mps;
  double wanted = std::min(settings_.idm.acceleration_mps2,
                           allowed.slope_1ps * speed + (allowed_mps_ - speed) / settings_.tracking_s);

  const double front = place.d_m + view.dimensions.front_m;
  const double middle = 0.5 * (view.dimensions.front_m - view.dimensions.rear_m);
  const double half_width = 0.5 * view.dimensions.width_m + settings_.side_margin_m;
  leader_ = FindLeader(*path_, view.others, place.d_m + middle, front, half_width, settings_.range_m, leader_hints_);
  if (leader_)
    wanted = std::min(wanted, IdmAcceleration(settings_.idm, speed, limit, leader_->gap_m, leader_->speed_mps));
  if (const auto stop = light_stops_.Step(settings_.lights, view.lights, front, speed, settings_.anticipation_s))
    wanted = std::min(wanted, *stop);
  return std::max(wanted, -settings_.idm.max_deceleration_mps2);
}

// Beyond the road's end the lane is taken to go straight on.
Eigen::Vector2d Autopilot::TargetFrom(const Way::Place& place, double half_base_m, double speed_mps) const {
  const double target_m = place.d_m - half_base_m + PreviewDistance(settings_.steering, speed_mps);
  Eigen::Vector2d target = path_->Position(std::min(target_m, path_->length_m()), 0.0).head<2>();
  if (target_m > path_->length_m()) {
    const double end = path_->HeadingAt(path_->length_m());
    target += (target_m - path_->length_m()) * Eigen::Vector2d(std::cos(end), std::sin(end));
  }
  return target;
}

std::optional<Aim> Autopilot::AimOf(const CarMotion& car) const {
  const auto place = path_->Locate(car.p_WB_W.x(), car.p_WB_W.y(), car.p_WB_W.z());
  if (!place) return std::nullopt;
  const double sees_m = std::min(place->d_m + car.front_m + settings_.range_m, path_->length_m());
  const double limit = settings_.speed_factor * path_->SpeedLimit_mps(place->d_m);
  return Aim{AllowedTo(*place, limit, car.speed_mps, car.heading_rad).speed_mps,
             TargetFrom(*place, 0.5 * car.wheelbase_m, car.speed_mps), place->heading_rad,
             path_->Position(sees_m, 0.0).head<2>()};
}

double Autopilot::SteeringWheel(const DriverView& view, const Way::Place& place, double dt_s) {
  const double speed = view.own.speed_mps();
  const double half_base = 0.5 * view.dimensions.wheelbase_m;
  const double heading = view.own.heading_rad();
  const Eigen::Vector2d ahead(std::cos(heading), std::sin(heading));
  const Eigen::Vector2d rear_axle = view.own.p_WB_W.head<2>() - half_base * ahead;
  const Eigen::Vector2d target = TargetFrom(place, half_base, speed);
  const double wheels =
      PursuitAngle(settings_.steering, rear_axle, heading, target, view.dimensions.wheelbase_m, speed);
  const double limit = view.dimensions.steering_wheel_limit_rad;
  const double wanted = std::clamp(wheels * view.dimensions.steering_ratio, -limit, limit);
  const double most = settings_.steering.rate_radps * dt_s;
  const double move = (wanted - steering_wheel_rad_) * dt_s / (settings_.steering.smoothing_s + dt_s);
  return steering_wheel_rad_ + std::clamp(move, -most, most);
}

dynamics::Controls Autopilot::Step(const DriverView& view, double dt_s) {
  RODEIRA_ASSERT(dt_s > 0.0);
  const auto place = path_->Near(place_hint_, view.own.p_WB_W.x(), view.own.p_WB_W.y(), view.own.p_WB_W.z(), {});
  leader_.reset();
  double wanted = kStopHere_mps2;
  if (place) {
    wanted = WantedAcceleration(view, *place);
    steering_wheel_rad_ = SteeringWheel(view, *place, dt_s);
  } else {
    allowed_mps_ = 0.0;
  }
  pedals_.Step(settings_.pedals, wanted, view.own.speed_mps(), -std::tan(view.own.pitch_rad()), dt_s);
  dynamics::Controls controls;
  controls.steering_wheel_rad = steering_wheel_rad_;
  controls.throttle = pedals_.throttle();
  controls.brake = pedals_.brake();
  controls.gear = 1;
  controls.gearbox = dynamics::GearboxMode::kAutomatic;
  return controls;
}

// Allowed speed and leader are for displays and found anew each step, but they are published: kept too.
void Autopilot::InitialiseFrom(const dynamics::Controls& last) {
  pedals_.InitialiseFrom(last.throttle, last.brake);
  steering_wheel_rad_ = last.steering_wheel_rad;
  allowed_mps_ = 0.0;
  leader_.reset();
  light_stops_ = LightStops();
}

void Autopilot::Save(base::StateWriter& writer) const {
  writer.Put("pedals", pedals_);
  writer.Put("light_stops", light_stops_);
  writer.Put("steering_wheel_rad", steering_wheel_rad_);
  writer.Put("allowed_mps", allowed_mps_);
  writer.Put("has_leader", leader_.has_value());
  writer.Put("leader_gap_m", leader_ ? leader_->gap_m : 0.0);
  writer.Put("leader_speed_mps", leader_ ? leader_->speed_mps : 0.0);
}

void Autopilot::Restore(base::StateReader& reader) {
  reader.Get("pedals", pedals_);
  reader.Get("light_stops", light_stops_);
  reader.Get("steering_wheel_rad", steering_wheel_rad_);
  reader.Get("allowed_mps", allowed_mps_);
  bool has_leader = false;
  Leader leader;
  reader.Get("has_leader", has_leader);
  reader.Get("leader_gap_m", leader.gap_m);
  reader.Get("leader_speed_mps", leader.speed_mps);
  leader_ = has_leader ? std::optional<Leader>(leader) : std::nullopt;
}

}  // namespace rodeira::driver
