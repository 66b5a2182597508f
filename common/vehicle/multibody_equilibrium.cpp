// INI of the multibody car: the position at which it stands on the ground under its wheels, and its motion.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "common/base/assert.hpp"
#include "common/vehicle/multibody_model.hpp"

namespace rodeira::vehicle {
namespace {

constexpr int kGroundTurns = 40;  // the wheels move a little as the car settles, and with them the ground's answers
constexpr double kSettled_m = 1e-10;
constexpr double kResidual_mps2 = 1e-9;
constexpr double kAnchor_Npm = 3e5;  // as a tyre: what a stiffer one does to the carrier by its lever is not in Newton's matrix
constexpr double kStandstill_mps = 1e-6;

Eigen::Isometry3d Standing(const InitialCondition& initial, double z_m, const Eigen::Vector3d& up) {
  const Eigen::Vector3d ahead(std::cos(initial.heading_rad), std::sin(initial.heading_rad), 0.0);
  const Eigen::Vector3d forward = (ahead - ahead.dot(up) / up.z() * Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear().col(0) = forward;
  pose.linear().col(1) = up.cross(forward);
  pose.linear().col(2) = up;
  pose.translation() = Eigen::Vector3d(initial.x_m, initial.y_m, z_m);
  return pose;
}

}  // namespace

// The mechanism as drawn, its drawing's frame at X_WC.
void MultibodyModel::Place(const Eigen::Isometry3d& X_WC) {
  const auto& entities = system_->drawing().entities;
  for (std::size_t i = 0; i < entities.size(); ++i) {
    const multibody::EntityDrawing& entity = entities[i];
    if (entity.fixed[0] && entity.fixed[1] && entity.fixed[2]) continue;
    Eigen::Vector3d at = entity.at;
    if (entity.kind == multibody::EntityKind::kPoint) at = X_WC * at;
    if (entity.kind == multibody::EntityKind::kVector) at = X_WC.linear() * at;
    for (int c = 0; c < 3; ++c) system_->q()[3 * i + static_cast<std::size_t>(c)] = at[c];
  }
  std::fill(system_->qd().begin(), system_->qd().end(), 0.0);
}

base::Status MultibodyModel::Settle(const InitialCondition& initial, terrain::Ground& ground) {
  const terrain::GroundPoint start = ground.At(initial.x_m, initial.y_m, initial.z_hint_m);
  const auto refusal = [&](const std::string& what) {
    return base::WrongInput(fmt::format("the car cannot be placed at x {:.3f} m, y {:.3f} m, heading {:.4f} rad: {}", initial.x_m,
                                        initial.y_m, initial.heading_rad, what));
  };
  if (!start.inside) return refusal("that is outside of the world");
  Eigen::Isometry3d wanted = Standing(initial, start.z_m, start.normal_W);
  Place(wanted * X_CB_.inverse());
  column_load_->SetHands(0.0, 0.0);
  chassis_load_->SetDrive(0.0);
  body_load_->LeaveGround();
  body_load_->SetPush({});
  // The springs that hold the hubs are stretched on a slope: they go with the car when it is moved.
  std::array<Eigen::Vector3d, kWheels> anchors;
  for (std::size_t i = 0; i < kWheels; ++i) anchors[i] = Hub_W(i);
  for (int turn = 0; turn < kGroundTurns; ++turn) {
    AskGround(ground);
    for (std::size_t i = 0; i < kWheels; ++i) {
      if (!wheels_[i].inside) return refusal("a wheel would stand outside of the world");
      GiveGround(i);
      wheels_[i].load->Anchor(anchors[i], kAnchor_Npm);
    }
    if (!system_->FindEquilibrium(kResidual_mps2)) return refusal("it finds no equilibrium there");
    const Eigen::Isometry3d now = X_WB();
    const Eigen::Vector3d off(initial.x_m - now.translation().x(), initial.y_m - now.translation().y(), 0.0);
    const double heading = std::atan2(now.linear()(1, 0), now.linear()(0, 0));
    const double turn_rad = std::remainder(initial.heading_rad - heading, 2.0 * 3.14159265358979323846);
    if (off.norm() < kSettled_m && std::fabs(turn_rad) < kSettled_m) return {};
    // Brought over the wanted place as it stands: turned about the vertical and shifted.
    const Eigen::Matrix3d turned = Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    const auto& entities = system_->drawing().entities;
    for (std::size_t i = 0; i < entities.size(); ++i) {
      const multibody::EntityDrawing& entity = entities[i];
      if (entity.is_scalar() || (entity.fixed[0] && entity.fixed[1] && entity.fixed[2])) continue;
      Eigen::Map<Eigen::Vector3d> at(system_->q().data() + 3 * i);
      if (entity.kind == multibody::EntityKind::kVector)
        at = (turned * at).eval();
      else
        at = (now.translation() + off + turned * (at - now.translation())).eval();
    }
    for (Eigen::Vector3d& anchor : anchors) anchor = (now.translation() + off + turned * (anchor - now.translation())).eval();
  }
  return refusal("the ground under its wheels is too uneven to stand on");
}

void MultibodyModel::SetInMotion(const InitialCondition& initial) {
  const Contacts contacts = FindContacts();
  const Eigen::Isometry3d pose = X_WB();
  const Eigen::Vector3d forward = pose.linear().col(0);
  const Eigen::Vector3d up = pose.linear().col(2);
  const Eigen::Vector3d v = initial.speed_mps * forward + initial.lateral_speed_mps * pose.linear().col(1);
  const Eigen::Vector3d w = initial.yaw_rate_radps * up;
  const bool rests = v.norm() < kStandstill_mps && std::fabs(initial.yaw_rate_radps) < kStandstill_mps;
  const auto& entities = system_->drawing().entities;
  for (std::size_t i = 0; i < entities.size(); ++i) {
    const multibody::EntityDrawing& entity = entities[i];
    Eigen::Map<Eigen::Vector3d> rate(system_->qd().data() + 3 * i);
    rate.setZero();
    if (rests || entity.is_scalar() || (entity.fixed[0] && entity.fixed[1] && entity.fixed[2])) continue;
    const Eigen::Vector3d at = Eigen::Map<const Eigen::Vector3d>(system_->q().data() + 3 * i);
    rate = entity.kind == multibody::EntityKind::kVector ? w.cross(at) : v + w.cross(at - pose.translation());
  }
  for (std::size_t i = 0; i < kWheels; ++i) {
    Wheel& wheel = wheels_[i];
    const TyreSettings& tyre = tyres_[i];
    const Eigen::Vector2d bears = wheel.load->Tangential(system_->motion(), contacts[i]);
    wheel.spin_rad = 0.0;
    wheel.spin_radps = 0.0;
    TyreMotion motion = MotionOf(i, contacts[i]);
    if (rests) {
      wheel.tyre.SetToBear(tyre, {bears[0], bears[1]}, contacts[i].load_N, wheel.friction, contacts[i].camber_rad);
    } else {
      wheel.spin_radps = motion.vx_mps / settings_.wheel.rolling_radius_m;
      motion = MotionOf(i, contacts[i]);
      wheel.tyre.SetToRoll(tyre, motion, contacts[i].load_N, wheel.friction);
    }
    forces_[i] = wheel.tyre.Forces(tyre, motion, contacts[i].load_N, wheel.friction);
  }
  torques_ = {};
  for (std::size_t i = 0; i < kWheels; ++i) {
    // At rest the brakes hold what the tyres bear about the axles; rolling wheels bear nothing.
    const Eigen::Vector3d bears = forces_[i].longitudinal_N * contacts[i].along_W + forces_[i].lateral_N * contacts[i].across_W +
                                  contacts[i].load_N * wheels_[i].normal_W;
    const Eigen::Vector3d axle = system_->motion().At(settings_.wheels[i].axle);
    torques_.friction_Nm[i] = rests ? -(contacts[i].point_W - Hub_W(i)).cross(bears).dot(axle) : 0.0;
    wheels_[i].load->SetStep(forces_[i].longitudinal_N, forces_[i].lateral_N, torques_.friction_Nm[i], wheels_[i].spin_radps);
  }
  hands_rad_ = 0.0;
  forward_mps2_ = 0.0;
  const std::size_t driven = settings_.front_driven ? kFrontLeft : kRearLeft;
  const double turning = 0.5 * (wheels_[driven].spin_radps + wheels_[driven + 1].spin_radps);
  powertrain_.Start(settings_.powertrain, rests ? 0.0 : turning);
  (void)system_->FindAccelerations();
}

base::Status MultibodyModel::Initialise(const InitialCondition& initial, terrain::Ground& ground) {
  if (!IsFinite(initial)) return base::WrongInput("the car's initial place or speed is not a finite number");
  base::StateWriter before;
  Save(before);
  system_->set_time_s(0.0);
  if (const base::Status status = Settle(initial, ground); !status) {
    base::StateReader reader(before.bytes());
    Restore(reader);
    return status;
  }
  SetInMotion(initial);
  state_ = VehicleState();
  Publish(Controls{}, 0.0);
  return {};
}

}  // namespace rodeira::vehicle
