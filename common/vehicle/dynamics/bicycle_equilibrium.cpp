// SPDX-License-Identifier: Apache-2.0
// INI of the bicycle: height, pitch, roll, travels and loads that balance weight on the ground under the four wheels.
#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "common/core/base/constants.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/vehicle/dynamics/bicycle_model.hpp"
#include "common/vehicle/dynamics/cruise.hpp"
#include "common/vehicle/dynamics/equilibrium.hpp"

namespace rodeira::dynamics {
namespace {

constexpr int kMaxBicycleNewtonIterations = 40;
constexpr int kBarTurns = 12;  // an anti-roll bar ties two wheels; each turn gains a factor of twenty or more

}  // namespace

// Works on a model that is being initialised. The unknowns are height of B, pitch and roll.
class BicycleEquilibrium {
 public:
  BicycleEquilibrium(BicycleModel& model, const InitialCondition& initial) : model_(model), initial_(initial) {}

  base::Status Find(ground::Ground& ground);
  void SetInMotion();

 private:
  using Unknowns = Eigen::Vector3d;  // height, pitch, roll

  void Place(const Unknowns& unknowns);
  Unknowns OnThePlane() const;
  void SettleCorners();
  BicycleContacts FindContacts() const;
  Eigen::Vector3d Along(const Eigen::Vector3d& normal) const;
  Eigen::Vector3d Drag(const Eigen::Vector3d& normal) const;
  Eigen::Vector3d HoldingForce(const Eigen::Vector3d& normal) const;
  CruiseForces Cruise(const Eigen::Vector3d& normal) const;
  struct Holding {
    std::array<Eigen::Vector3d, kWheels> forces;
    std::array<double, kWheels> aligning_Nm{};
  };
  Holding HoldingForces(const BicycleContacts& contacts, const Eigen::Vector3d& normal) const;
  std::array<double, kWheels> AligningMoments(const BicycleContacts& contacts,
                                              const std::array<Eigen::Vector3d, kWheels>& forces) const;
  Eigen::Vector3d Residual(const Unknowns& unknowns);
  Unknowns Balance(Unknowns unknowns);

  BicycleModel& model_;
  const InitialCondition& initial_;
};

void BicycleEquilibrium::Place(const Unknowns& unknowns) {
  model_.car_.body.q_WG = Eigen::AngleAxisd(initial_.heading_rad, Eigen::Vector3d::UnitZ()) *
                          Eigen::AngleAxisd(unknowns[1], Eigen::Vector3d::UnitY()) *
                          Eigen::AngleAxisd(unknowns[2], Eigen::Vector3d::UnitX());
  model_.car_.body.p_WG_W =
      Eigen::Vector3d(initial_.x_m, initial_.y_m, unknowns[0]) + model_.car_.body.q_WG * model_.chassis_.p_BG_B;
}

// Parallel to the plane of the ground's four points, as if springs were rigid: where the search begins.
BicycleEquilibrium::Unknowns BicycleEquilibrium::OnThePlane() const {
  BicycleContacts contacts;
  double height = 0.0;
  for (std::size_t i = 0; i < kWheels; ++i) {
    contacts[i].point_W = model_.car_.wheels[i].plane_W;
    height += 0.25 * model_.car_.wheels[i].plane_W.z();
  }
  const Eigen::Vector3d up = RoadNormal(contacts);
  const Eigen::Vector3d ahead(std::cos(initial_.heading_rad), std::sin(initial_.heading_rad), 0.0);
  const double pitch = std::atan(ahead.dot(up) / up.z());  // falling ahead: nose down, positive
  const Eigen::Vector3d forward = std::cos(pitch) * ahead - std::sin(pitch) * Eigen::Vector3d::UnitZ();
  return {height, pitch, std::atan2(up.cross(forward).z(), up.z())};
}

void BicycleEquilibrium::SettleCorners() {
  const BicyclePose pose = model_.car_.PoseOf(model_.chassis_, 0.0);
  for (int turn = 0; turn < kBarTurns; ++turn) {
    for (std::size_t i = 0; i < kWheels; ++i) {
      model_.car_.wheels[i].corner.Settle(model_.chassis_.settings.suspension[i / 2],
                                          model_.car_.CornerInputOf(model_.chassis_, pose, i));
    }
  }
}

BicycleContacts BicycleEquilibrium::FindContacts() const {
  const BicyclePose pose = model_.car_.PoseOf(model_.chassis_, 0.0);
  BicycleContacts contacts;
  for (std::size_t i = 0; i < kWheels; ++i) contacts[i] = model_.car_.ContactOf(pose, i);
  return contacts;
}

// The way ahead in the road's plane.
Eigen::Vector3d BicycleEquilibrium::Along(const Eigen::Vector3d& normal) const {
  const Eigen::Vector3d forward = model_.car_.body.q_WG * Eigen::Vector3d::UnitX();
  return (forward - forward.dot(normal) * normal).normalized();
}

// Of the air on a car that keeps its speed, at its centre of gravity.
Eigen::Vector3d BicycleEquilibrium::Drag(const Eigen::Vector3d& normal) const {
  if (!IsCruise(initial_)) return Eigen::Vector3d::Zero();
  const BodySettings& body = model_.chassis_.settings.body;
  return -std::copysign(AirDrag(body.air_density_kgpm3, body.drag_area_m2, initial_.speed_mps), initial_.speed_mps) *
         Along(normal);
}

// What the tyres must give along the road, all together, so that nothing accelerates.
Eigen::Vector3d BicycleEquilibrium::HoldingForce(const Eigen::Vector3d& normal) const {
  Eigen::Vector3d force = Drag(normal);
  force.z() -= model_.chassis_.settings.body.mass_kg * base::kGravity_mps2;
  for (const auto& wheel : model_.car_.wheels) force += wheel.corner.load_N() * wheel.normal_W;
  return force.dot(normal) * normal - force;
}

CruiseForces BicycleEquilibrium::Cruise(const Eigen::Vector3d& normal) const {
  std::array<double, kWheels> loads_N{};
  for (std::size_t i = 0; i < kWheels; ++i) loads_N[i] = model_.car_.wheels[i].corner.load_N();
  return PushAlong(HoldingForce(normal).dot(Along(normal)), loads_N, model_.chassis_.settings.wheel,
                   model_.chassis_.settings.powertrain, model_.chassis_.tyres, initial_.speed_mps);
}

// Of wheels that roll at the car's speed; at rest there are none.
std::array<double, kWheels> BicycleEquilibrium::AligningMoments(
    const BicycleContacts& contacts, const std::array<Eigen::Vector3d, kWheels>& forces) const {
  std::array<double, kWheels> moments{};
  for (std::size_t i = 0; i < kWheels; ++i) {
    const TyreForces wanted{forces[i].dot(contacts[i].along_W), forces[i].dot(contacts[i].across_W)};
    const auto& wheel = model_.car_.wheels[i];
    moments[i] =
        CruiseMoment(model_.chassis_.tyres[i], wanted, initial_.speed_mps, wheel.corner.load_N(), wheel.friction);
  }
  return moments;
}

// Of each wheel. Along the car by load, or as rolling wheels drive it; across it the axles share so that nothing yaws
// (both forces of an axle act at its middle), and an axle's wheels by load.
BicycleEquilibrium::Holding BicycleEquilibrium::HoldingForces(const BicycleContacts& contacts,
                                                              const Eigen::Vector3d& normal) const {
  Holding found;
  found.forces.fill(Eigen::Vector3d::Zero());
  std::array<double, 2> load{};
  for (std::size_t i = 0; i < kWheels; ++i) load[i / 2] += model_.car_.wheels[i].corner.load_N();
  if (!(load[0] > 0.0 && load[1] > 0.0)) return found;
  const Eigen::Vector3d holding = HoldingForce(normal);
  const Eigen::Vector3d along = Along(normal);
  const Eigen::Vector3d lengthwise = holding.dot(along) * along, across = holding - lengthwise;
  const auto yaws = [&](std::size_t axle, const Eigen::Vector3d& force) {
    return (0.5 * (contacts[2 * axle].point_W + contacts[2 * axle + 1].point_W) - model_.car_.body.p_WG_W)
        .cross(force)
        .dot(normal);
  };
  const double by_load = load[0] / (load[0] + load[1]);
  std::array<double, kWheels> along_N{};
  for (std::size_t i = 0; i < kWheels; ++i)
    along_N[i] =
        model_.car_.wheels[i].corner.load_N() / load[i / 2] * (i < 2 ? by_load : 1.0 - by_load) * lengthwise.dot(along);
  const bool cruises = IsCruise(initial_);
  if (cruises) along_N = Cruise(normal).longitudinal_N;
  double lengthwise_yaws = 0.0;
  for (std::size_t i = 0; i < kWheels; ++i)
    lengthwise_yaws += along_N[i] * (contacts[i].point_W - model_.car_.body.p_WG_W).cross(along).dot(normal);
  const double apart = yaws(0, across) - yaws(1, across);
  // The aligning moments follow the side forces, which make up for them: what is missing falls to some hundredths each
  // turn.
  for (int turn = 0; turn < kMomentTurns; ++turn) {
    const double aligning = found.aligning_Nm[0] + found.aligning_Nm[1] + found.aligning_Nm[2] + found.aligning_Nm[3];
    const double front = std::fabs(apart) > 1e-9
                             ? std::clamp(-(lengthwise_yaws + aligning + yaws(1, across)) / apart, 0.0, 1.0)
                             : by_load;
    for (std::size_t i = 0; i < kWheels; ++i) {
      const double of_axle = model_.car_.wheels[i].corner.load_N() / load[i / 2];
      found.forces[i] = along_N[i] * along + of_axle * (i < 2 ? front : 1.0 - front) * across;
    }
    if (!cruises) break;
    const std::array<double, kWheels> moments = AligningMoments(contacts, found.forces);
    double change_Nm = 0.0;
    for (std::size_t i = 0; i < kWheels; ++i)
      change_Nm = std::max(change_Nm, std::fabs(moments[i] - found.aligning_Nm[i]));
    found.aligning_Nm = moments;
    if (change_Nm < kSameMoment_Nm) break;
  }
  return found;
}

// Force along the road's normal, pitching and rolling moment about the centre of gravity.
Eigen::Vector3d BicycleEquilibrium::Residual(const Unknowns& unknowns) {
  Place(unknowns);
  SettleCorners();
  const BicycleContacts contacts = FindContacts();
  const Eigen::Vector3d normal = RoadNormal(contacts);
  const Holding holding = HoldingForces(contacts, normal);
  const Eigen::Vector3d along = Along(normal);
  Eigen::Vector3d force = HoldingForce(normal) + Drag(normal);
  force.z() -= model_.chassis_.settings.body.mass_kg * base::kGravity_mps2;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < kWheels; ++i) {
    const Eigen::Vector3d bearing = model_.car_.wheels[i].corner.load_N() * model_.car_.wheels[i].normal_W;
    const Eigen::Vector3d middle = 0.5 * (contacts[i & 2u].point_W + contacts[(i & 2u) + 1].point_W);
    force += bearing;
    moment += (contacts[i].point_W - model_.car_.body.p_WG_W).cross(bearing);
    const Eigen::Vector3d lengthwise = holding.forces[i].dot(along) * along;
    moment += (contacts[i].point_W - model_.car_.body.p_WG_W).cross(lengthwise) +
              (middle - model_.car_.body.p_WG_W).cross(holding.forces[i] - lengthwise) +
              holding.aligning_Nm[i] * model_.car_.wheels[i].normal_W;
  }
  const Eigen::Vector3d moment_B = model_.car_.body.q_WG.conjugate() * moment;
  return {force.dot(normal), moment_B.y(), moment_B.x()};
}

BicycleEquilibrium::Unknowns BicycleEquilibrium::Balance(Unknowns unknowns) {
  constexpr double kProbe = 1e-6;
  for (int turn = 0; turn < kMaxBicycleNewtonIterations; ++turn) {
    const Eigen::Vector3d residual = Residual(unknowns);
    Eigen::Matrix3d slope;
    for (int k = 0; k < 3; ++k) {
      Unknowns probe = unknowns;
      probe[k] += kProbe;
      slope.col(k) = (Residual(probe) - residual) / kProbe;
    }
    Eigen::Vector3d step = -slope.partialPivLu().solve(residual);
    if (!step.allFinite()) step = {-0.01, 0.0, 0.0};  // no wheel touches: come down
    step = step.cwiseMax(Eigen::Vector3d(-0.1, -0.05, -0.05)).cwiseMin(Eigen::Vector3d(0.1, 0.05, 0.05));
    unknowns += step;
    unknowns[1] = std::clamp(unknowns[1], -0.8, 0.8);
    unknowns[2] = std::clamp(unknowns[2], -0.8, 0.8);
    if (step.cwiseAbs().maxCoeff() < kSettled_m) break;
  }
  Place(unknowns);
  SettleCorners();
  return unknowns;
}

base::Status BicycleEquilibrium::Find(ground::Ground& ground) {
  const ground::GroundPoint start = ground.At(initial_.x_m, initial_.y_m, initial_.z_hint_m);
  const auto refusal = [&](const std::string& what) {
    return base::WrongInput("vehicle.cannot_be_placed",
                            fmt::format("the car cannot be placed at x {:.3f} m, y {:.3f} m, heading {:.4f} rad: {}",
                                        initial_.x_m, initial_.y_m, initial_.heading_rad, what));
  };
  if (!start.inside) return refusal("that is outside of the world");
  Unknowns unknowns(start.z_m, 0.0, 0.0);
  for (int turn = 0; turn < kMaxGroundIterations; ++turn) {
    Place(unknowns);
    model_.QueryGround(ground, 0.0);
    for (std::size_t i = 0; i < kWheels; ++i) {
      if (!model_.car_.wheels[i].inside) return refusal("a wheel would stand outside of the world");
    }
    if (turn < 3) unknowns = OnThePlane();
    const Unknowns before = unknowns;
    unknowns = Balance(unknowns);
    if ((unknowns - before).cwiseAbs().maxCoeff() < 10.0 * kSettled_m) break;
  }
  return {};
}

void BicycleEquilibrium::SetInMotion() {
  model_.findings_.contacts = FindContacts();
  RigidBody& body = model_.car_.body;
  const Eigen::Vector3d normal = RoadNormal(model_.findings_.contacts);
  const Eigen::Vector3d along = Along(normal);
  const bool cruises = IsCruise(initial_);
  const double speed_mps =
      cruises ? initial_.speed_mps / along.dot(body.q_WG * Eigen::Vector3d::UnitX()) : initial_.speed_mps;
  const Eigen::Vector3d v_WB_W = speed_mps * along + initial_.lateral_speed_mps * normal.cross(along);
  body.w_WG_G = body.q_WG.conjugate() * (initial_.yaw_rate_radps * normal);
  body.v_WG_W = v_WB_W + body.w_WG_W().cross(body.q_WG * model_.chassis_.p_BG_B);

  const bool rests = v_WB_W.norm() < kStandstill_mps && std::fabs(initial_.yaw_rate_radps) < kStandstill_mps;
  const std::array<Eigen::Vector3d, kWheels> holding = HoldingForces(model_.findings_.contacts, normal).forces;
  for (std::size_t i = 0; i < kWheels; ++i) {
    BicycleCar::Wheel& wheel = model_.car_.wheels[i];
    BicycleContact& contact = model_.findings_.contacts[i];
    const TyreSettings& tyre = model_.chassis_.tyres[i];
    const double bears = wheel.corner.load_N();
    wheel.spin_radps = rests ? 0.0
                             : model_.car_.MotionOf(model_.chassis_, model_.findings_.contacts)[i].vx_mps /
                                   model_.chassis_.settings.wheel.rolling_radius_m;
    TyreMotion motion = model_.car_.MotionOf(model_.chassis_, model_.findings_.contacts)[i];
    if (cruises && bears > 0.0) {
      const TyreForces wanted{holding[i].dot(contact.along_W), holding[i].dot(contact.across_W)};
      motion = wheel.tyre.SetToRollAndBear(tyre, wanted, motion.vx_mps, bears, wheel.friction);
      wheel.spin_radps = (motion.vx_mps - motion.vsx_mps) / model_.chassis_.settings.wheel.rolling_radius_m;
    } else if (rests && bears > 0.0) {
      wheel.tyre.SetToBear(tyre, {holding[i].dot(contact.along_W), holding[i].dot(contact.across_W)}, bears,
                           wheel.friction);
    } else {
      wheel.tyre.SetToRoll(tyre, motion, bears, wheel.friction);
    }
    contact.forces = wheel.tyre.Forces(tyre, motion, bears, wheel.friction);
  }
  const PowertrainSettings& powertrain = model_.chassis_.settings.powertrain;
  std::array<double, kWheels> spin_radps{};
  for (std::size_t i = 0; i < kWheels; ++i) spin_radps[i] = model_.car_.wheels[i].spin_radps;
  const double turning = TurningOf(powertrain, spin_radps);
  if (cruises)
    model_.car_.powertrain.StartSteadily(powertrain, turning, Cruise(normal).at_wheel_Nm);
  else
    model_.car_.powertrain.Start(powertrain, rests ? 0.0 : turning);
}

base::Status BicycleModel::Initialise(const InitialCondition& initial, ground::Ground& ground) {
  if (!IsFinite(initial))
    return base::WrongInput("vehicle.wrong_start", "the car's initial place or speed is not a finite number");
  BicycleModel trial(settings());
  BicycleEquilibrium equilibrium(trial, initial);
  if (const base::Status status = equilibrium.Find(ground); !status) return status;
  equilibrium.SetInMotion();
  trial.Publish(Controls{}, 0.0);
  *this = trial;
  return {};
}

}  // namespace rodeira::dynamics
