// SPDX-License-Identifier: Apache-2.0
// A car that follows its front wheels without slip and never leaves the ground. The rear axle drives circles of radius
// L / tan(steer). Symbols: B body frame, W world frame (common/vehicle/dynamics/vehicle_state.hpp).
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "common/vehicle/dynamics/vehicle_library.hpp"
#include "common/vehicle/dynamics/wheel_ground.hpp"

namespace {

using namespace rodeira;
using Eigen::Vector3d;

constexpr double kGravity_mps2 = 9.81;

struct Settings {
  dynamics::VehicleDimensions dimensions;
  double acceleration_mps2 = 0.0;
  double braking_mps2 = 0.0;
  double drag_per_m = 0.0;
};

// The keys of the vehicle file. A missing key, or a number out of its range, is told with its line.
Settings Read(const config::Map& root) {
  Settings settings;
  dynamics::VehicleDimensions& d = settings.dimensions;
  d.wheelbase_m = root.Number("wheelbase_m", {0.5, 20.0});
  d.track_front_m = d.track_rear_m = root.Number("track_m", {0.3, 5.0});
  d.wheel_radius_m = root.Number("wheel_radius_m", {0.05, 2.0});
  d.mass_kg = root.Number("mass_kg", {50.0, 100'000.0});
  d.steering_ratio = root.Number("steering_ratio", {1.0, 50.0});
  d.steering_wheel_limit_rad = root.Number("steering_wheel_limit_rad", {0.1, 50.0});
  settings.acceleration_mps2 = root.Number("acceleration_mps2", {0.0, 50.0});
  settings.braking_mps2 = root.Number("braking_mps2", {0.0, 50.0});
  settings.drag_per_m = root.Number("drag_per_m", {0.0, 1.0});
  d.front_m = d.rear_m = d.wheelbase_m / 2 + 0.8;
  d.width_m = d.track_front_m + 0.2;
  d.height_m = 1.4;
  d.wheel_width_m = 0.18;
  d.forward_gears = 1;
  return settings;
}

class KinematicCar final : public dynamics::VehicleModel {
 public:
  explicit KinematicCar(const Settings& settings) : settings_(settings) {}

  // A model that refuses stays as it was: the new car is made beside the old one.
  base::Status Initialise(const dynamics::InitialCondition& initial, ground::Ground& ground) override {
    if (!dynamics::IsFinite(initial))
      return base::WrongInput("vehicle.wrong_start", "the initial place or speed is not a finite number");
    KinematicCar car(settings_);
    car.heading_rad_ = initial.heading_rad;
    car.speed_mps_ = initial.speed_mps;
    car.rear_W_ = Vector3d(initial.x_m, initial.y_m, initial.z_hint_m) - half_base_m() * car.Forward();
    car.AskForGround(ground);
    for (const dynamics::WheelGround& wheel : car.grounds_) {
      if (!wheel.inside)
        return base::WrongInput("vehicle.cannot_be_placed", "a wheel would stand outside of the world");
    }
    car.SettleOnGround();
    car.Publish(dynamics::Controls(), 0.0, 0.0);
    *this = car;
    return {};
  }

  void Step(const dynamics::Controls& given, ground::Ground& ground, double dt_s) override {
    const dynamics::Controls controls = dynamics::Clamp(given);
    const double limit_rad = settings_.dimensions.steering_wheel_limit_rad;
    steering_wheel_rad_ = std::clamp(controls.steering_wheel_rad, -limit_rad, limit_rad);

    // Speed: drive, drag and slope first; the brake then slows down and cannot reverse.
    const double before_mps = speed_mps_;
    const double direction = controls.gear > 0 ? 1.0 : controls.gear < 0 ? -1.0 : 0.0;
    speed_mps_ += dt_s * (direction * controls.throttle * settings_.acceleration_mps2 -
                          settings_.drag_per_m * speed_mps_ * std::fabs(speed_mps_) - kGravity_mps2 * forward_W_.z());
    const double braked_mps = dt_s * settings_.braking_mps2 * std::max(controls.brake, controls.handbrake);
    speed_mps_ = std::copysign(std::max(0.0, std::fabs(speed_mps_) - braked_mps), speed_mps_);

    // The arc of the rear axle, seen from above.
    const double way_m = dt_s * 0.5 * (before_mps + speed_mps_);
    const double turned_rad = way_m * std::tan(steer_rad()) / settings_.dimensions.wheelbase_m;
    const double half_rad = 0.5 * turned_rad;
    const double shorter = std::fabs(half_rad) > 1e-9 ? std::sin(half_rad) / half_rad : 1.0;
    heading_rad_ += half_rad;
    rear_W_ += way_m * shorter * std::hypot(forward_W_.x(), forward_W_.y()) * Forward();
    heading_rad_ = std::remainder(heading_rad_ + half_rad, 2.0 * M_PI);

    AskForGround(ground);
    SettleOnGround();
    spin_rad_ = std::remainder(spin_rad_ + way_m / settings_.dimensions.wheel_radius_m, 2.0 * M_PI);
    Publish(controls, (speed_mps_ - before_mps) / dt_s, dt_s);
    state_.odometer_m += std::fabs(way_m);
  }

  const dynamics::VehicleState& state() const override { return state_; }
  const dynamics::VehicleDimensions& dimensions() const override { return settings_.dimensions; }

  // All that later steps depend on.
  void Save(base::StateWriter& out) const override {
    out.Put("rear_W", std::span<const double>(rear_W_.data(), 3));
    out.Put("forward_W", std::span<const double>(forward_W_.data(), 3));
    out.Put("heading_rad", heading_rad_);
    out.Put("speed_mps", speed_mps_);
    out.Put("spin_rad", spin_rad_);
    out.Put("steering_wheel_rad", steering_wheel_rad_);
    for (const dynamics::WheelGround& wheel : grounds_) out.Put("ground", wheel);
    out.Put("published", state_);
  }
  void Restore(base::StateReader& in) override {
    in.Get("rear_W", std::span<double>(rear_W_.data(), 3));
    in.Get("forward_W", std::span<double>(forward_W_.data(), 3));
    in.Get("heading_rad", heading_rad_);
    in.Get("speed_mps", speed_mps_);
    in.Get("spin_rad", spin_rad_);
    in.Get("steering_wheel_rad", steering_wheel_rad_);
    for (dynamics::WheelGround& wheel : grounds_) in.Get("ground", wheel);
    in.Get("published", state_);
  }

 private:
  double half_base_m() const { return 0.5 * settings_.dimensions.wheelbase_m; }
  double steer_rad() const { return steering_wheel_rad_ / settings_.dimensions.steering_ratio; }
  Vector3d Forward() const { return {std::cos(heading_rad_), std::sin(heading_rad_), 0.0}; }
  Vector3d Hub_B(std::size_t wheel) const {
    return {wheel < 2 ? half_base_m() : -half_base_m(),
            (wheel % 2 == 0 ? 0.5 : -0.5) * settings_.dimensions.track_front_m, settings_.dimensions.wheel_radius_m};
  }

  // One question for all four wheels.
  void AskForGround(ground::Ground& ground) {
    const Vector3d forward_W = Forward(), left_W = Vector3d::UnitZ().cross(forward_W);
    std::array<dynamics::WheelGround*, dynamics::kWheels> wheels;
    for (std::size_t i = 0; i < dynamics::kWheels; ++i) {
      const Vector3d hub_B = Hub_B(i);
      contacts_W_[i] = rear_W_ + (hub_B.x() + half_base_m()) * forward_W + hub_B.y() * left_W;
      wheels[i] = &grounds_[i];
    }
    dynamics::QueryGround(ground, contacts_W_, wheels);
  }
  // The wheels stand on the planes below them; the body is parallel to both diagonals of the contact points.
  void SettleOnGround() {
    for (std::size_t i = 0; i < dynamics::kWheels; ++i) {
      const dynamics::WheelGround& wheel = grounds_[i];
      const Vector3d off_W = contacts_W_[i] - wheel.plane_W;
      contacts_W_[i].z() =
          wheel.plane_W.z() - (wheel.normal_W.x() * off_W.x() + wheel.normal_W.y() * off_W.y()) / wheel.normal_W.z();
    }
    using dynamics::kFrontLeft, dynamics::kFrontRight, dynamics::kRearLeft, dynamics::kRearRight;
    rear_W_.z() = 0.5 * (contacts_W_[kRearLeft].z() + contacts_W_[kRearRight].z());
    up_W_ = (contacts_W_[kFrontRight] - contacts_W_[kRearLeft])
                .cross(contacts_W_[kFrontLeft] - contacts_W_[kRearRight])
                .normalized();
    forward_W_ = (Forward() - up_W_ * up_W_.dot(Forward())).normalized();
  }
  void Publish(const dynamics::Controls& controls, double acceleration_mps2, double dt_s) {
    dynamics::VehicleState& s = state_;
    const Eigen::Quaterniond q_before = s.q_WB;
    const Vector3d v_before_W = s.v_WB_W, w_before_B = s.w_WB_B;
    const double yaw_radps = speed_mps_ * std::tan(steer_rad()) / settings_.dimensions.wheelbase_m;
    const Vector3d left_W = up_W_.cross(forward_W_);
    Eigen::Matrix3d axes;
    axes << forward_W_, left_W, up_W_;
    s.q_WB = Eigen::Quaterniond(axes);
    s.p_WB_W = rear_W_ + half_base_m() * forward_W_;
    s.v_WB_W = speed_mps_ * forward_W_ + yaw_radps * half_base_m() * left_W;
    s.w_WB_B = {0.0, 0.0, yaw_radps};
    if (dt_s > 0.0) {
      const Eigen::AngleAxisd turn(q_before.conjugate() * s.q_WB);
      s.w_WB_B.head<2>() = (turn.angle() / dt_s * turn.axis()).head<2>();
      s.a_WB_W = (s.v_WB_W - v_before_W) / dt_s;
      s.alpha_WB_B = (s.w_WB_B - w_before_B) / dt_s;
    }
    const double mass_kg = settings_.dimensions.mass_kg;
    s.inside_world = true;
    for (std::size_t i = 0; i < dynamics::kWheels; ++i) {
      dynamics::WheelState& wheel = s.wheels[i];
      wheel.hub_B = Hub_B(i);
      wheel.steer_rad = i < 2 ? steer_rad() : 0.0;
      wheel.spin_rad = spin_rad_;
      wheel.spin_radps = speed_mps_ / settings_.dimensions.wheel_radius_m;
      wheel.longitudinal_N = 0.25 * mass_kg * acceleration_mps2;
      wheel.lateral_N = 0.25 * mass_kg * speed_mps_ * yaw_radps;
      wheel.load_N = 0.25 * mass_kg * kGravity_mps2 * up_W_.z();
      wheel.contact_W = contacts_W_[i];
      wheel.contact_normal_W = grounds_[i].normal_W;
      wheel.friction = grounds_[i].friction;
      wheel.surface = grounds_[i].surface;
      s.inside_world = s.inside_world && grounds_[i].inside;
    }
    s.engine_running = true;
    s.clutch = 0.0;
    s.gear = std::clamp(controls.gear, -1, 1);
    s.throttle = controls.throttle;
    s.brake = controls.brake;
    s.steering_wheel_rad = steering_wheel_rad_;
  }

  Settings settings_;
  Vector3d rear_W_ = Vector3d::Zero();                                 // middle of the rear axle, on the ground
  Vector3d forward_W_ = Vector3d::UnitX(), up_W_ = Vector3d::UnitZ();  // unit, of the body
  std::array<Vector3d, dynamics::kWheels> contacts_W_;
  std::array<dynamics::WheelGround, dynamics::kWheels> grounds_;
  double heading_rad_ = 0.0, speed_mps_ = 0.0, spin_rad_ = 0.0, steering_wheel_rad_ = 0.0;
  dynamics::VehicleState state_;
};

std::unique_ptr<dynamics::VehicleModel> MakeKinematicCar(const config::Map& root) {
  return std::make_unique<KinematicCar>(Read(root));
}

}  // namespace

RODEIRA_VEHICLE(MakeKinematicCar);
