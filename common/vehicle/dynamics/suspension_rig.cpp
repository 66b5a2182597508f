// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/suspension_rig.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace rodeira::dynamics {
namespace {

constexpr std::array<const char*, kWheels> kNames = {"front_left", "front_right", "rear_left", "rear_right"};
constexpr double kPart_m = 0.01;   // a way is divided into parts of at most this travel …
constexpr double kPart_rad = 0.5;  // … and this turn of the steering wheel
constexpr double kReached_m = 1e-11;
constexpr int kMaxTurns = 40;
constexpr double kProbe_m = 1e-6;  // of a spring's length
constexpr double kTravelStep_m = 1e-3;
constexpr double kSteeringStep_rad = 0.05;
constexpr double kTurned_rad = 1e-7;  // a carrier that turns less with the steering is not steered

std::array<double, kWheels> AllWheelsAt(double travel_m) {
  std::array<double, kWheels> travels{};
  travels.fill(travel_m);
  return travels;
}

double SideOf(std::size_t wheel) { return wheel % 2 == 0 ? 1.0 : -1.0; }  // left positive

}  // namespace

SuspensionRig::SuspensionRig(const MultibodySettings& car, std::unique_ptr<multibody::System> system)
    : wheels_(car.wheels),
      steering_(car.steering.angle),
      column_Nmprad_(car.steering.column_Nmprad),
      radius_m_(car.wheel.radius_m),
      system_(std::move(system)) {}

base::Result<SuspensionRig> SuspensionRig::Make(const MultibodySettings& car) {
  multibody::Drawing drawing = car.mechanism;
  const auto entity = [&drawing](int index) -> multibody::EntityDrawing& {
    return drawing.entities[static_cast<std::size_t>(index)];
  };
  for (const int held : drawing.bodies[static_cast<std::size_t>(car.chassis)].entities)
    entity(held).fixed = {true, true, true};
  entity(car.steering.angle).fixed[0] = true;
  for (const MultibodyWheelSettings& wheel : car.wheels) entity(wheel.travel).fixed[0] = true;
  auto system = multibody::System::Make(drawing);
  if (!system) return system.error();
  SuspensionRig rig(car, std::move(system).value());
  if (auto status = rig.system_->Assemble(); !status) return status.error();
  if (const int loose = rig.system_->degrees_of_freedom(); loose > 0)
    return base::WrongInput(
        "vehicle.loose_suspension",
        fmt::format("with the chassis, the steering angle and the 'travel' of each wheel held, the mechanism can still "
                    "move in {} way{}; none was expected",
                    loose, loose == 1 ? "" : "s"),
        drawing.place);
  for (std::size_t i = 0; i < kWheels; ++i) {
    rig.drawn_z_m_[i] = entity(car.wheels[i].centre).at.z();
    rig.lengths_m_[i] = entity(car.wheels[i].travel).at.x();
    rig.travel_m_[i] = rig.TravelNow(i);
  }
  rig.steering_rad_ = entity(car.steering.angle).at.x();
  return rig;
}

Eigen::Vector3d SuspensionRig::At(int entity) const { return system_->motion().At(entity); }

base::Status SuspensionRig::Hold(const std::array<double, kWheels>& lengths_m, double steering_rad) {
  const auto q = system_->q();
  q[static_cast<std::size_t>(3 * steering_)] = steering_rad;
  for (std::size_t i = 0; i < kWheels; ++i) q[static_cast<std::size_t>(3 * wheels_[i].travel)] = lengths_m[i];
  return system_->Assemble();
}

// Newton's method for the four lengths together: a wheel's height depends on its own spring alone, and on the steering.
base::Status SuspensionRig::Reach(const std::array<double, kWheels>& travel_m, double steering_rad) {
  std::array<double, kWheels> lengths = lengths_m_, slope{}, height{};
  if (auto status = Hold(lengths, steering_rad); !status) return status;
  for (std::size_t i = 0; i < kWheels; ++i) height[i] = TravelNow(i);
  std::array<double, kWheels> probed = lengths;
  for (double& length : probed) length -= kProbe_m;
  if (auto status = Hold(probed, steering_rad); !status) return status;
  for (std::size_t i = 0; i < kWheels; ++i) slope[i] = (TravelNow(i) - height[i]) / -kProbe_m;
  for (int turn = 0; turn < kMaxTurns; ++turn) {
    double off = 0.0;
    for (std::size_t i = 0; i < kWheels; ++i) {
      const double missing = travel_m[i] - height[i];
      off = std::max(off, std::fabs(missing));
      lengths[i] += missing / slope[i];
    }
    if (!std::isfinite(off)) break;
    if (off < kReached_m) {
      lengths_m_ = lengths;
      travel_m_ = travel_m;
      steering_rad_ = steering_rad;
      return Hold(lengths, steering_rad);
    }
    if (auto status = Hold(lengths, steering_rad); !status) return status;
    for (std::size_t i = 0; i < kWheels; ++i) height[i] = TravelNow(i);
  }
  return base::WrongInput("vehicle.travel_out_of_reach", "no position was found");
}

base::Status SuspensionRig::MoveTo(const std::array<double, kWheels>& travel_m, double steering_rad) {
  const auto begin = std::pair(travel_m_, steering_rad_);
  const std::vector<double> q(system_->q().begin(), system_->q().end());
  const auto lengths = lengths_m_;
  double parts = std::fabs(steering_rad - steering_rad_) / kPart_rad;
  for (std::size_t i = 0; i < kWheels; ++i) parts = std::max(parts, std::fabs(travel_m[i] - travel_m_[i]) / kPart_m);
  const int count = std::max(1, static_cast<int>(std::ceil(parts)));
  for (int part = 1; part <= count; ++part) {
    const double share = static_cast<double>(part) / count;
    std::array<double, kWheels> now = travel_m;
    for (std::size_t i = 0; i < kWheels; ++i) now[i] = std::lerp(begin.first[i], travel_m[i], share);
    if (auto status = Reach(now, std::lerp(begin.second, steering_rad, share)); !status) {
      std::copy(q.begin(), q.end(), system_->q().begin());
      lengths_m_ = lengths;
      std::tie(travel_m_, steering_rad_) = begin;
      const auto far = std::ranges::max_element(now, {}, [](double travel) { return std::fabs(travel); });
      return base::WrongInput(
          "vehicle.travel_out_of_reach",
          fmt::format("the suspension does not reach a travel of {:.1f} mm (wheel {}) at {:.0f} deg of the steering "
                      "wheel",
                      1000.0 * *far, kNames[static_cast<std::size_t>(far - now.begin())],
                      std::lerp(begin.second, steering_rad, share) * 180.0 / base::kPi));
    }
  }
  return {};
}

WheelPosition SuspensionRig::wheel(std::size_t wheel) const {
  const MultibodyWheelSettings& hung = wheels_[wheel];
  const Eigen::Vector3d axle = At(hung.axle).normalized();
  const double side = SideOf(wheel);
  WheelPosition position;
  position.centre_m = At(hung.centre);
  position.contact_m = position.centre_m - radius_m_ * (Eigen::Vector3d::UnitZ() - axle.z() * axle).normalized();
  position.steer_rad = std::atan2(-axle.x(), axle.y());
  position.toe_in_rad = -side * position.steer_rad;
  position.camber_rad = -side * std::asin(axle.z());
  position.spring_m = At(hung.travel).x();
  position.spring_N =
      system_->drawing().loads[static_cast<std::size_t>(hung.suspension)].load->ForceAtRest(system_->motion());
  return position;
}

double SuspensionRig::SpringEnergy(std::size_t wheel) const {
  return system_->drawing().loads[static_cast<std::size_t>(wheels_[wheel].suspension)].load->Energy(system_->motion());
}

Eigen::Isometry3d SuspensionRig::CarrierPose(std::size_t wheel) const {
  const multibody::Frame& frame = system_->drawing().bodies[static_cast<std::size_t>(wheels_[wheel].carrier)].frame;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = frame.Rotation(system_->q().data());
  pose.translation() = multibody::Evaluate(frame.origin, system_->q().data());
  return pose;
}

// The axis about which the carrier turns with the springs held: that of the rotation between two positions beside it.
std::optional<SuspensionFigures::SteeringAxis> SuspensionRig::FindSteeringAxis(std::size_t wheel) {
  const Eigen::Vector3d contact = this->wheel(wheel).contact_m;
  const double straight = steering_rad_;
  std::array<Eigen::Isometry3d, 2> beside;
  for (const std::size_t which : {0u, 1u}) {
    if (!Hold(lengths_m_, straight + (which == 0 ? -kSteeringStep_rad : kSteeringStep_rad))) return std::nullopt;
    beside[which] = CarrierPose(wheel);
  }
  if (!Hold(lengths_m_, straight)) return std::nullopt;
  const Eigen::Isometry3d turn = beside[1] * beside[0].inverse();
  const Eigen::AngleAxisd rotation(turn.linear());
  if (!(std::fabs(rotation.angle()) > kTurned_rad)) return std::nullopt;
  const Eigen::Vector3d axis = rotation.axis().z() < 0.0 ? (-rotation.axis()).eval() : rotation.axis();
  // A point that stays, up to the way along the axis.
  const Eigen::Vector3d across = turn.translation() - axis.dot(turn.translation()) * axis;
  const Eigen::Matrix3d moved = Eigen::Matrix3d::Identity() - turn.linear();
  const Eigen::Vector3d point = moved.completeOrthogonalDecomposition().solve(across);
  const Eigen::Vector3d ground = point + (contact.z() - point.z()) / axis.z() * axis;
  const double side = SideOf(wheel);
  SuspensionFigures::SteeringAxis found;
  found.caster_rad = std::atan2(-axis.x(), axis.z());
  found.inclination_rad = std::atan2(-side * axis.y(), axis.z());
  found.scrub_radius_m = side * (contact.y() - ground.y());
  found.trail_m = ground.x() - contact.x();
  return found;
}

base::Result<SuspensionFigures> SuspensionRig::Figures(std::size_t wheel, double travel_m) {
  std::array<WheelPosition, 3> at;
  std::array<double, 3> energy_J{};
  for (const std::size_t which : {0u, 2u, 1u}) {
    if (auto status = MoveTo(AllWheelsAt(travel_m + (static_cast<double>(which) - 1.0) * kTravelStep_m), 0.0); !status)
      return status.error();
    at[which] = this->wheel(wheel);
    energy_J[which] = SpringEnergy(wheel);
  }
  const double span = 2.0 * kTravelStep_m, side = SideOf(wheel);
  const Eigen::Vector3d way = at[2].contact_m - at[0].contact_m;
  SuspensionFigures figures;
  figures.bump_steer_radpm = (at[2].toe_in_rad - at[0].toe_in_rad) / span;
  figures.camber_gain_radpm = (at[2].camber_rad - at[0].camber_rad) / span;
  figures.lateral_share = side * way.y() / span;
  figures.forward_share = way.x() / span;
  figures.roll_centre_m = at[1].contact_m.y() * way.y() / way.z();
  figures.spring_share = (at[0].spring_m - at[2].spring_m) / span;
  figures.wheel_rate_Npm = (energy_J[0] - 2.0 * energy_J[1] + energy_J[2]) / (kTravelStep_m * kTravelStep_m);
  figures.steering_axis = FindSteeringAxis(wheel);
  return figures;
}

// The column bears torque = force · d(way of the force) / d(angle), and is turned by it over its stiffness.
base::Result<WheelCompliance> SuspensionRig::Compliance(std::size_t wheel, double travel_m) {
  const std::array<double, kWheels> travels = AllWheelsAt(travel_m);
  if (auto status = MoveTo(travels, 0.0); !status) return status.error();
  const Eigen::Vector3d contact = CarrierPose(wheel).inverse() * this->wheel(wheel).contact_m;
  std::array<WheelPosition, 2> at;
  std::array<Eigen::Isometry3d, 2> carrier;
  for (const std::size_t which : {0u, 1u}) {
    if (auto status = MoveTo(travels, which == 0 ? -kSteeringStep_rad : kSteeringStep_rad); !status)
      return status.error();
    at[which] = this->wheel(wheel);
    carrier[which] = CarrierPose(wheel);
  }
  if (auto status = MoveTo(travels, 0.0); !status) return status.error();
  const double span = 2.0 * kSteeringStep_rad, side = SideOf(wheel);
  const Eigen::AngleAxisd rotation((carrier[1] * carrier[0].inverse()).linear());
  const Eigen::Vector3d way = (carrier[1] * contact - carrier[0] * contact) / span;
  const double toe_in = (at[1].toe_in_rad - at[0].toe_in_rad) / span,
               camber = (at[1].camber_rad - at[0].camber_rad) / span;
  const auto by = [&](double arm_m) {
    return WheelCompliance::Change{toe_in * arm_m / column_Nmprad_, camber * arm_m / column_Nmprad_};
  };
  return WheelCompliance{by(side * way.y()), by(way.x()), by(-side * rotation.angle() * rotation.axis().z() / span)};
}

}  // namespace rodeira::dynamics
