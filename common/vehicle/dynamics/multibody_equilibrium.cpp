// SPDX-License-Identifier: Apache-2.0
// INI of the multibody car: the position at which it stands on the ground under its wheels, and its motion.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "common/core/base/assert.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/vehicle/dynamics/cruise.hpp"
#include "common/vehicle/dynamics/multibody_model.hpp"

namespace rodeira::dynamics {
namespace {

// The wheels move a little as the car settles, and the ground under them with that: how often the ground is asked.
constexpr int kMaxMultibodyGroundIterations = 40;
constexpr double kMultibodySettled_m = 1e-10;
constexpr double kResidual_mps2 = 1e-9;
constexpr double kAnchor_Npm =
    3e5;  // as a tyre: what a stiffer one does to the carrier by its lever is not in Newton's matrix
constexpr double kHeld_N = 1e-6;       // what anchors may still hold of a car at a speed
constexpr double kMomentArm_m = 0.01;  // a change of a wheel's moment counts as one of its forces by this arm

Eigen::Isometry3d PoseOnGround(const InitialCondition& initial, double z_m, const Eigen::Vector3d& up) {
  const Eigen::Vector3d ahead(std::cos(initial.heading_rad), std::sin(initial.heading_rad), 0.0);
  const Eigen::Vector3d forward = (ahead - ahead.dot(up) / up.z() * Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear().col(0) = forward;
  pose.linear().col(1) = up.cross(forward);
  pose.linear().col(2) = up;
  pose.translation() = Eigen::Vector3d(initial.x_m, initial.y_m, z_m);
  return pose;
}

base::Error Refusal(const InitialCondition& initial, const std::string& what) {
  return base::WrongInput("vehicle.cannot_be_placed",
                          fmt::format("the car cannot be placed at x {:.3f} m, y {:.3f} m, heading {:.4f} rad: {}",
                                      initial.x_m, initial.y_m, initial.heading_rad, what));
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

// How a car that keeps its speed is driven, and how its tyres hold it: found turn by turn beside the position.
struct MultibodyModel::Cruise {
  bool found = false;
  Eigen::Vector3d v_W = Eigen::Vector3d::Zero();
  CruiseForces push;
  std::array<TyreForces, kWheels> forces;
  std::array<double, kWheels> slip{};
  std::array<double, 2> axle_N{};  // across, beside what the slip angles give
};

void MultibodyModel::FillTranslation(const Eigen::Vector3d& v_W, std::span<double> rates) const {
  const auto& entities = system_->drawing().entities;
  for (std::size_t i = 0; i < entities.size(); ++i) {
    const multibody::EntityDrawing& entity = entities[i];
    const bool moves =
        entity.kind == multibody::EntityKind::kPoint && !(entity.fixed[0] && entity.fixed[1] && entity.fixed[2]);
    Eigen::Map<Eigen::Vector3d>(rates.data() + 3 * i) = moves ? v_W : Eigen::Vector3d(Eigen::Vector3d::Zero());
  }
}

// The forces that the tyres have at this speed in the present position, in the place of those that they and their
// anchors have had: across by toe and camber and, where that does not hold the car (on a slope across), by load; along
// what is missing, by the driven wheels. Returns what the anchors still had to hold, in N.
double MultibodyModel::UpdateCruise(const InitialCondition& initial, Cruise& cruise) {
  const Plane under = GroundPlane({&wheels_[0], &wheels_[1], &wheels_[2], &wheels_[3]});
  // The chassis' axes have unit length only within the tolerance of its constraints; a speed is measured along a unit.
  const Eigen::Vector3d forward = X_WB().linear().col(0).normalized();
  const Eigen::Vector3d along = (forward - forward.dot(under.normal_W) * under.normal_W).normalized(),
                        across = under.normal_W.cross(along);
  cruise.v_W = initial.speed_mps / along.dot(forward) * along;
  FillTranslation(cruise.v_W, ahead_qd_);
  const multibody::Motion motion{system_->q().data(), ahead_qd_.data(), 0.0};
  const Contacts contacts = FindContacts(system_->motion());
  // What a force of a wheel does to the car along, across, and about the normal.
  const auto acts = [&](std::size_t wheel, const Eigen::Vector3d& force) {
    return Eigen::Vector3d(force.dot(along), force.dot(across),
                           (contacts[wheel].point_W - under.point_W).cross(force).dot(under.normal_W));
  };
  std::array<double, kWheels> loads_N{};
  std::array<double, 2> axle_N{};
  Eigen::Vector3d missing = Eigen::Vector3d::Zero();
  double held_N = 0.0;
  for (std::size_t i = 0; i < kWheels; ++i) {
    const Eigen::Vector2d bears = wheels_[i].load->Tangential(system_->motion(), contacts[i]);
    held_N = std::max({held_N, std::fabs(bears[0] - cruise.forces[i].longitudinal_N),
                       std::fabs(bears[1] - cruise.forces[i].lateral_N)});
    missing += acts(i, bears[0] * contacts[i].along_W + bears[1] * contacts[i].across_W);
    // The present forces' moment in the place of that of the turn before: what is missing falls to some hundredths.
    const double before_Nm = cruise.forces[i].aligning_Nm;
    missing[2] += before_Nm;
    cruise.forces[i].aligning_Nm =
        CruiseMoment(tyres_[i], {bears[0], bears[1]}, MotionOf(i, motion, contacts[i]).vx_mps, contacts[i].load_N,
                     wheels_[i].friction, contacts[i].camber_rad);
    missing[2] -= cruise.forces[i].aligning_Nm;
    held_N = std::max(held_N, std::fabs(cruise.forces[i].aligning_Nm - before_Nm) / kMomentArm_m);
    loads_N[i] = contacts[i].load_N;
    axle_N[i / 2] += loads_N[i];
  }
  // Of each axle: by one newton across, shared by load.
  std::array<Eigen::Vector3d, 2> by_axle{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  std::array<double, kWheels> share{};
  for (std::size_t i = 0; i < kWheels; ++i) {
    share[i] = axle_N[i / 2] > 0.0 ? loads_N[i] / axle_N[i / 2] : 0.5;
    by_axle[i / 2] += share[i] * acts(i, contacts[i].across_W);
    if (!(loads_N[i] > 0.0)) continue;
    TyreSlip slip = SteadySlip(tyres_[i], MotionOf(i, motion, contacts[i]), loads_N[i]);
    slip.kappa = cruise.slip[i];
    const TyreForces now = SteadyForces(tyres_[i], slip, loads_N[i], wheels_[i].friction);
    cruise.slip[i] +=
        (cruise.forces[i].longitudinal_N - now.longitudinal_N) / LongitudinalStiffness(tyres_[i], loads_N[i]);
    cruise.forces[i].lateral_N = now.lateral_N;
    missing -= acts(i, now.lateral_N * contacts[i].across_W);
  }
  // Wheels with toe do not push quite along, and what the axles bear across has a part along: both are made up for.
  const double wanted_N = missing[0] - cruise.axle_N[0] * by_axle[0][0] - cruise.axle_N[1] * by_axle[1][0];
  const auto pushed = [&](double total_N) {
    cruise.push = PushAlong(total_N, loads_N, settings_.wheel, settings_.powertrain, tyres_, initial.speed_mps);
    Eigen::Vector3d all = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < kWheels; ++i) all += acts(i, cruise.push.longitudinal_N[i] * contacts[i].along_W);
    return all;
  };
  missing -= pushed(2.0 * wanted_N - pushed(wanted_N)[0]);
  const double apart_m = by_axle[0][2] * by_axle[1][1] - by_axle[1][2] * by_axle[0][1];
  cruise.axle_N = {(missing[2] * by_axle[1][1] - by_axle[1][2] * missing[1]) / apart_m,
                   (by_axle[0][2] * missing[1] - missing[2] * by_axle[0][1]) / apart_m};
  for (std::size_t i = 0; i < kWheels; ++i) {
    cruise.forces[i].longitudinal_N = cruise.push.longitudinal_N[i];
    cruise.forces[i].lateral_N += share[i] * cruise.axle_N[i / 2];
    wheels_[i].load->SetStep(cruise.forces[i], 0.0, 0.0);
    wheels_[i].load->Anchor(Hub_W(i), kAnchor_Npm, false);
  }
  chassis_load_->SetDrive(cruise.push.drive_sum_Nm());
  chassis_load_->SetHeadway(cruise.v_W);
  return held_N;
}

// Turned about the vertical and shifted, so that it stands over the wanted place as it stands. Returns that movement;
// it is small at last.
Eigen::Isometry3d MultibodyModel::MoveTo(const InitialCondition& initial, double& by) {
  const Eigen::Isometry3d now = X_WB();
  const Eigen::Vector3d off(initial.x_m - now.translation().x(), initial.y_m - now.translation().y(), 0.0);
  const double heading = std::atan2(now.linear()(1, 0), now.linear()(0, 0));
  const double turn_rad = std::remainder(initial.heading_rad - heading, 2.0 * geometry::kPi);
  by = std::max(off.norm(), std::fabs(turn_rad));
  Eigen::Isometry3d way = Eigen::Isometry3d::Identity();
  if (by < kMultibodySettled_m) return way;
  way.linear() = Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  way.translation() = now.translation() + off - way.linear() * now.translation();
  const auto& entities = system_->drawing().entities;
  for (std::size_t i = 0; i < entities.size(); ++i) {
    const multibody::EntityDrawing& entity = entities[i];
    if (entity.is_scalar() || (entity.fixed[0] && entity.fixed[1] && entity.fixed[2])) continue;
    Eigen::Map<Eigen::Vector3d> at(system_->q().data() + 3 * i);
    at = entity.kind == multibody::EntityKind::kVector ? (way.linear() * at).eval() : (way * at.eval()).eval();
  }
  return way;
}

base::Status MultibodyModel::Settle(const InitialCondition& initial, ground::Ground& ground, Cruise& cruise) {
  const ground::GroundPoint start = ground.At(initial.x_m, initial.y_m, initial.z_hint_m);
  if (!start.inside) return Refusal(initial, "that is outside of the world");
  Place(PoseOnGround(initial, start.z_m, start.normal_W) * X_CB_.inverse());
  column_load_->SetHands(0.0, 0.0);
  chassis_load_->SetDrive(0.0);
  chassis_load_->SetHeadway(Eigen::Vector3d::Zero());
  body_load_->LeaveGround();
  body_load_->SetPush({});
  for (Wheel& wheel : wheels_) wheel.load->SetStep({}, 0.0, 0.0);
  if (auto status = Balance(initial, ground, nullptr); !status || !IsCruise(initial)) return status;
  const std::vector<double> stands(system_->q().begin(), system_->q().end());
  (void)UpdateCruise(initial, cruise);
  cruise.found = Balance(initial, ground, &cruise).ok();
  chassis_load_->SetHeadway(Eigen::Vector3d::Zero());
  if (cruise.found) return {};
  // On rough ground nothing goes on steadily: it begins to roll from where it would stand.
  std::copy(stands.begin(), stands.end(), system_->q().begin());
  chassis_load_->SetDrive(0.0);
  QueryGround(ground);
  for (std::size_t i = 0; i < kWheels; ++i) GiveGround(i);
  return {};
}

// At rest the wheels are locked, and what holds them is not asked; at a speed (cruise) they roll, and at last the tyres
// hold all.
base::Status MultibodyModel::Balance(const InitialCondition& initial, ground::Ground& ground, Cruise* cruise) {
  // The springs that hold the hubs are stretched on a slope: they go with the car when it is moved.
  std::array<Eigen::Vector3d, kWheels> anchors;
  for (std::size_t i = 0; i < kWheels; ++i) anchors[i] = Hub_W(i);
  for (int turn = 0; turn < kMaxMultibodyGroundIterations; ++turn) {
    QueryGround(ground);
    for (std::size_t i = 0; i < kWheels; ++i) {
      if (!wheels_[i].inside) return Refusal(initial, "a wheel would stand outside of the world");
      GiveGround(i);
      wheels_[i].load->Anchor(anchors[i], kAnchor_Npm, cruise == nullptr);
    }
    if (!system_->FindEquilibrium(kResidual_mps2)) return Refusal(initial, "it finds no equilibrium there");
    const double held_N = cruise != nullptr ? UpdateCruise(initial, *cruise) : 0.0;
    double by = 0.0;
    const Eigen::Isometry3d way = MoveTo(initial, by);
    if (by < kMultibodySettled_m && held_N < kHeld_N) return {};
    for (std::size_t i = 0; i < kWheels; ++i) anchors[i] = cruise != nullptr ? Hub_W(i) : way * anchors[i];
  }
  return Refusal(initial, "the ground under its wheels is too uneven to stand on");
}

void MultibodyModel::SetInMotion(const InitialCondition& initial, const Cruise& cruise) {
  const Contacts contacts = FindContacts(system_->motion());
  const Eigen::Isometry3d pose = X_WB();
  const Eigen::Vector3d forward = pose.linear().col(0).normalized();
  const Eigen::Vector3d up = pose.linear().col(2);
  const bool cruises = cruise.found;
  const Eigen::Vector3d v =
      cruises ? cruise.v_W
              : Eigen::Vector3d(initial.speed_mps * forward + initial.lateral_speed_mps * pose.linear().col(1));
  const Eigen::Vector3d w = initial.yaw_rate_radps * up;
  const bool rests = v.norm() < kStandstill_mps && std::fabs(initial.yaw_rate_radps) < kStandstill_mps;
  FillTranslation(rests ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : v, system_->qd());
  if (!rests && !cruises) Turn(pose.translation(), w);
  std::array<double, kWheels> spin_radps{};
  for (std::size_t i = 0; i < kWheels; ++i) {
    Wheel& wheel = wheels_[i];
    const TyreSettings& tyre = tyres_[i];
    const double load_N = contacts[i].load_N;
    const Eigen::Vector2d bears = wheel.load->Tangential(system_->motion(), contacts[i]);
    wheel.spin_rad = 0.0;
    wheel.spin_radps = 0.0;
    TyreMotion motion = MotionOf(i, system_->motion(), contacts[i]);
    if (rests) {
      wheel.tyre.SetToBear(tyre, {bears[0], bears[1]}, load_N, wheel.friction, contacts[i].camber_rad);
    } else if (cruises) {
      motion = wheel.tyre.SetToRollAndBear(tyre, cruise.forces[i], motion.vx_mps, load_N, wheel.friction,
                                           contacts[i].camber_rad);
      wheel.spin_radps = (motion.vx_mps - motion.vsx_mps) / settings_.wheel.rolling_radius_m;
    } else {
      wheel.spin_radps = motion.vx_mps / settings_.wheel.rolling_radius_m;
      motion = MotionOf(i, system_->motion(), contacts[i]);
      wheel.tyre.SetToRoll(tyre, motion, load_N, wheel.friction);
    }
    forces_[i] = wheel.tyre.Forces(tyre, motion, load_N, wheel.friction);
    spin_radps[i] = wheel.spin_radps;
  }
  torques_ = {};
  for (std::size_t i = 0; i < kWheels; ++i) {
    // At rest the brakes hold what the tyres bear about the axles; rolling wheels bear nothing.
    const Eigen::Vector3d bears = forces_[i].longitudinal_N * contacts[i].along_W +
                                  forces_[i].lateral_N * contacts[i].across_W +
                                  contacts[i].load_N * wheels_[i].normal_W;
    const Eigen::Vector3d axle = system_->motion().At(settings_.wheels[i].axle);
    torques_.friction_Nm[i] = rests ? -(contacts[i].point_W - Hub_W(i)).cross(bears).dot(axle) : 0.0;
    wheels_[i].load->SetStep(forces_[i], torques_.friction_Nm[i], wheels_[i].spin_radps);
  }
  hands_rad_ = 0.0;
  lowered_m_ = 0.0;
  forward_mps2_ = 0.0;
  lateral_mps2_ = 0.0;
  assists_ = {};
  const double turning_radps = TurningOf(settings_.powertrain, spin_radps);
  if (cruises)
    powertrain_.StartSteadily(settings_.powertrain, turning_radps, cruise.push.at_wheel_Nm);
  else
    powertrain_.Start(settings_.powertrain, rests ? 0.0 : turning_radps);
  for (std::size_t i = 0; i < kWheels; ++i) {
    const AxleMotion* axle = powertrain_.AxleOf(settings_.powertrain, AxleOf(i));
    if (axle != nullptr) torques_.drive_Nm[i] = axle->wheel_torque_Nm()[i % 2];
  }
  (void)system_->FindAccelerations();
}

// Adds a turn about a point to the velocities.
void MultibodyModel::Turn(const Eigen::Vector3d& about_W, const Eigen::Vector3d& w_W) {
  const auto& entities = system_->drawing().entities;
  for (std::size_t i = 0; i < entities.size(); ++i) {
    const multibody::EntityDrawing& entity = entities[i];
    if (entity.is_scalar() || (entity.fixed[0] && entity.fixed[1] && entity.fixed[2])) continue;
    const Eigen::Vector3d at = Eigen::Map<const Eigen::Vector3d>(system_->q().data() + 3 * i);
    Eigen::Map<Eigen::Vector3d>(system_->qd().data() + 3 * i) +=
        w_W.cross(entity.kind == multibody::EntityKind::kVector ? at : Eigen::Vector3d(at - about_W));
  }
}

base::Status MultibodyModel::Initialise(const InitialCondition& initial, ground::Ground& ground) {
  if (!IsFinite(initial))
    return base::WrongInput("vehicle.wrong_start", "the car's initial place or speed is not a finite number");
  base::StateWriter before;
  Save(before);
  system_->set_time_s(0.0);
  Cruise cruise;
  if (const base::Status status = Settle(initial, ground, cruise); !status) {
    base::StateReader reader(before.bytes());
    Restore(reader);
    return status;
  }
  SetInMotion(initial, cruise);
  state_ = VehicleState();
  Publish(Controls{}, 0.0);
  return {};
}

}  // namespace rodeira::dynamics
