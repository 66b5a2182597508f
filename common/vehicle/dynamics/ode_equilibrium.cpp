// SPDX-License-Identifier: Apache-2.0
// INI of the ODE car: height, pitch, roll and four travels that balance weight on the ground under the wheels.
#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/base/constants.hpp"
#include "common/vehicle/dynamics/cruise.hpp"
#include "common/vehicle/dynamics/equilibrium.hpp"
#include "common/vehicle/dynamics/ode_model.hpp"

namespace rodeira::dynamics {
namespace {

constexpr int kMaxOdeNewtonIterations = 60;

}  // namespace

// Works on a model with a motion that is to be found. Unknowns: height of B, pitch, roll, travel of each wheel.
class OdeEquilibrium {
 public:
  OdeEquilibrium(OdeModel& model, const InitialCondition& initial) : model_(model), initial_(initial) {}

  base::Status Find(ground::Ground& ground);
  void SetInMotion();

 private:
  static constexpr int kUnknowns = 7;
  using Vector = Eigen::Matrix<double, kUnknowns, 1>;

  const BicycleSettings& car() const { return model_.settings_.car; }
  void Place(const Vector& unknowns);
  Vector OnThePlane() const;
  void Load();
  void ShareAcross();
  Eigen::Vector3d Along() const;
  Eigen::Vector3d Drag() const;
  Eigen::Vector3d Holding(std::size_t wheel) const;
  Vector Residual(const Vector& unknowns);
  Vector Balance(Vector unknowns);

  OdeModel& model_;
  const InitialCondition& initial_;
  CruiseForces cruise_;                    // at a speed
  std::array<double, 2> cruise_axle_N_{};  // then, across: front, rear
  std::array<double, 2> axle_load_N_{};
  std::array<double, kWheels> aligning_Nm_{};  // then
  Eigen::Vector3d holding_W_ =
      Eigen::Vector3d::Zero();  // of all tyres together along the road, so that nothing accelerates
  double load_N_ = 0.0;         // of all
  Eigen::Vector3d normal_W_ = Eigen::Vector3d::UnitZ();  // mean of the ground under the wheels
};

void OdeEquilibrium::Place(const Vector& unknowns) {
  const Eigen::Quaterniond q = Eigen::AngleAxisd(initial_.heading_rad, Eigen::Vector3d::UnitZ()) *
                               Eigen::AngleAxisd(unknowns[1], Eigen::Vector3d::UnitY()) *
                               Eigen::AngleAxisd(unknowns[2], Eigen::Vector3d::UnitX());
  const Eigen::Vector3d origin(initial_.x_m, initial_.y_m, unknowns[0]);
  for (RigidBody& body : model_.now_.bodies) {
    body = RigidBody();
    body.q_WG = q;
  }
  model_.now_.bodies[OdeCar::kChassis].p_WG_W = origin + q * model_.measures_.p_BG_B;
  for (std::size_t i = 0; i < kWheels; ++i) {
    const Eigen::Vector3d travelled(0.0, 0.0, unknowns[3 + static_cast<int>(i)]);
    model_.now_.bodies[i].p_WG_W = origin + q * (HubAtRest_B(car(), i) + travelled);
  }
}

// Parallel to the plane of the ground's four points, as if springs were rigid: where the search begins.
OdeEquilibrium::Vector OdeEquilibrium::OnThePlane() const {
  const auto& wheels = model_.now_.wheels;
  const Eigen::Vector3d rising = wheels[kFrontLeft].plane_W - wheels[kRearRight].plane_W;
  const Eigen::Vector3d falling = wheels[kFrontRight].plane_W - wheels[kRearLeft].plane_W;
  const Eigen::Vector3d cross = falling.cross(rising);
  const Eigen::Vector3d up = cross.norm() > 1e-3 && cross.z() > 0.5 * cross.norm() ? Eigen::Vector3d(cross.normalized())
                                                                                   : Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d ahead(std::cos(initial_.heading_rad), std::sin(initial_.heading_rad), 0.0);
  const double pitch = std::atan(ahead.dot(up) / up.z());
  const Eigen::Vector3d forward = std::cos(pitch) * ahead - std::sin(pitch) * Eigen::Vector3d::UnitZ();
  Vector unknowns = Vector::Zero();
  for (const auto& wheel : wheels) unknowns[0] += 0.25 * wheel.plane_W.z();
  unknowns[1] = pitch;
  unknowns[2] = std::atan2(up.cross(forward).z(), up.z());
  return unknowns;
}

// The way ahead in the road's plane: that of the wheels, which none is steered out of.
Eigen::Vector3d OdeEquilibrium::Along() const {
  return (model_.chassis().q_WG * Eigen::Vector3d::UnitY()).cross(normal_W_).normalized();
}

// Of the air on a car that keeps its speed, at the chassis's centre of gravity.
Eigen::Vector3d OdeEquilibrium::Drag() const {
  if (!IsCruise(initial_)) return Eigen::Vector3d::Zero();
  return -std::copysign(AirDrag(car().body.air_density_kgpm3, car().body.drag_area_m2, initial_.speed_mps),
                        initial_.speed_mps) *
         Along();
}

// Loads at the present place, and what the tyres must hold, shared by load.
void OdeEquilibrium::Load() {
  Eigen::Vector3d force(0.0, 0.0, -car().body.mass_kg * base::kGravity_mps2);
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  load_N_ = 0.0;
  for (std::size_t i = 0; i < kWheels; ++i) {
    model_.contacts_[i] = model_.ContactOf(i);
    const double load = model_.contacts_[i].load_N;
    force += load * model_.now_.wheels[i].normal_W;
    normal += model_.now_.wheels[i].normal_W;
    load_N_ += load;
  }
  normal_W_ = normal.normalized();
  force += Drag();
  holding_W_ = force.dot(normal_W_) * normal_W_ - force;
  std::array<double, kWheels> loads_N{};
  for (std::size_t i = 0; i < kWheels; ++i) loads_N[i] = model_.contacts_[i].load_N;
  cruise_ =
      PushAlong(holding_W_.dot(Along()), loads_N, car().wheel, car().powertrain, model_.tyres_, initial_.speed_mps);
  if (IsCruise(initial_)) ShareAcross();
}

// Of one tyre along the road: by load, but for what drives and brakes a rolling wheel.
Eigen::Vector3d OdeEquilibrium::Holding(std::size_t wheel) const {
  const OdeModel::Contact& contact = model_.contacts_[wheel];
  if (!IsCruise(initial_)) return (load_N_ > 0.0 ? contact.load_N / load_N_ : 0.25) * holding_W_;
  const double of_axle = axle_load_N_[wheel / 2] > 0.0 ? contact.load_N / axle_load_N_[wheel / 2] : 0.5;
  return cruise_.longitudinal_N[wheel] * contact.along_W + of_axle * cruise_axle_N_[wheel / 2] * contact.across_W;
}

// At a speed the axles share what acts across so that nothing yaws.
void OdeEquilibrium::ShareAcross() {
  const Eigen::Vector3d centre = model_.chassis().p_WG_W;
  const Eigen::Vector3d across = normal_W_.cross(Along()),
                        wheel_weight(0.0, 0.0, -model_.settings_.wheel_mass_kg * base::kGravity_mps2);
  axle_load_N_ = {};
  for (std::size_t i = 0; i < kWheels; ++i) axle_load_N_[i / 2] += model_.contacts_[i].load_N;
  double yaws_Nm = 0.0;
  aligning_Nm_ = {};
  std::array<double, 2> arm_m{};
  for (std::size_t i = 0; i < kWheels; ++i) {
    const OdeModel::Contact& contact = model_.contacts_[i];
    const Eigen::Vector3d road =
        contact.load_N * model_.now_.wheels[i].normal_W + cruise_.longitudinal_N[i] * contact.along_W;
    yaws_Nm += ((contact.point_W - centre).cross(road) + (model_.now_.bodies[i].p_WG_W - centre).cross(wheel_weight))
                   .dot(normal_W_);
    const double share = axle_load_N_[i / 2] > 0.0 ? contact.load_N / axle_load_N_[i / 2] : 0.5;
    arm_m[i / 2] += share * (contact.point_W - centre).cross(contact.across_W).dot(normal_W_);
  }
  const double all_N = holding_W_.dot(across);
  // The aligning moments follow the side forces, which make up for them: what is missing falls to some hundredths each
  // turn.
  for (int turn = 0; turn < kMomentTurns; ++turn) {
    const double aligning_Nm = aligning_Nm_[0] + aligning_Nm_[1] + aligning_Nm_[2] + aligning_Nm_[3];
    cruise_axle_N_[0] = (-yaws_Nm - aligning_Nm - all_N * arm_m[1]) / (arm_m[0] - arm_m[1]);
    cruise_axle_N_[1] = all_N - cruise_axle_N_[0];
    double change_Nm = 0.0;
    for (std::size_t i = 0; i < kWheels; ++i) {
      const OdeModel::Contact& contact = model_.contacts_[i];
      const double moment_Nm =
          CruiseMoment(model_.tyres_[i], {Holding(i).dot(contact.along_W), Holding(i).dot(contact.across_W)},
                       initial_.speed_mps, contact.load_N, model_.now_.wheels[i].friction, contact.camber_rad);
      change_Nm = std::max(change_Nm, std::fabs(moment_Nm - aligning_Nm_[i]));
      aligning_Nm_[i] = moment_Nm;
    }
    if (change_Nm < kSameMoment_Nm) break;
  }
}

OdeEquilibrium::Vector OdeEquilibrium::Residual(const Vector& unknowns) {
  Place(unknowns);
  Load();
  const OdeSettings& settings = model_.settings_;
  const RigidBody& chassis = model_.chassis();
  const Eigen::Vector3d up = chassis.q_WG * Eigen::Vector3d::UnitZ();
  Eigen::Vector3d force = Drag();
  force.z() -= model_.measures_.mass_kg * base::kGravity_mps2;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  Vector residual;
  for (std::size_t i = 0; i < kWheels; ++i) {
    const Eigen::Vector3d weight(0.0, 0.0, -settings.wheel_mass_kg * base::kGravity_mps2);
    const Eigen::Vector3d road = model_.contacts_[i].load_N * model_.now_.wheels[i].normal_W + Holding(i);
    const double strut = model_.StrutExtra(i) + car().suspension[i / 2].spring_Npm * model_.Travel(i);
    residual[3 + static_cast<int>(i)] = (road + weight).dot(up) - strut;
    // ODE lets a joint's reaction across the strut act on the chassis where the wheel is at rest, not where it has
    // travelled to.
    const Eigen::Vector3d across = (road + weight) - (road + weight).dot(up) * up;
    force += road + weight;
    moment -= model_.Travel(i) * up.cross(across);
    moment += (model_.contacts_[i].point_W - chassis.p_WG_W).cross(road) +
              (model_.now_.bodies[i].p_WG_W - chassis.p_WG_W).cross(weight) +
              aligning_Nm_[i] * model_.now_.wheels[i].normal_W;
  }
  const Eigen::Vector3d moment_B = chassis.q_WG.conjugate() * moment;
  residual.head<3>() = Eigen::Vector3d(force.dot(up), moment_B.y(), moment_B.x());
  return residual;
}

OdeEquilibrium::Vector OdeEquilibrium::Balance(Vector unknowns) {
  constexpr double kProbe = 1e-6;
  for (int turn = 0; turn < kMaxOdeNewtonIterations; ++turn) {
    const Vector residual = Residual(unknowns);
    Eigen::Matrix<double, kUnknowns, kUnknowns> slope;
    for (int k = 0; k < kUnknowns; ++k) {
      Vector probe = unknowns;
      probe[k] += kProbe;
      slope.col(k) = (Residual(probe) - residual) / kProbe;
    }
    Vector step = -slope.partialPivLu().solve(residual);
    if (!step.allFinite() || !(load_N_ > 0.0)) {  // no wheel touches: come down
      step.setZero();
      step[0] = -0.01;
    }
    step = step.cwiseMax(-0.05).cwiseMin(0.05);
    unknowns += step;
    unknowns[1] = std::clamp(unknowns[1], -0.8, 0.8);
    unknowns[2] = std::clamp(unknowns[2], -0.8, 0.8);
    if (step.cwiseAbs().maxCoeff() < kSettled_m) break;
  }
  return unknowns;
}

base::Status OdeEquilibrium::Find(ground::Ground& ground) {
  const ground::GroundPoint start = ground.At(initial_.x_m, initial_.y_m, initial_.z_hint_m);
  const auto refusal = [&](const std::string& what) {
    return base::WrongInput("vehicle.cannot_be_placed",
                            fmt::format("the car cannot be placed at x {:.3f} m, y {:.3f} m, heading {:.4f} rad: {}",
                                        initial_.x_m, initial_.y_m, initial_.heading_rad, what));
  };
  if (!start.inside) return refusal("that is outside of the world");
  Vector unknowns = Vector::Zero();
  unknowns[0] = start.z_m;
  for (int turn = 0; turn < kMaxGroundIterations; ++turn) {
    Place(unknowns);
    model_.QueryGround(ground);
    for (const auto& wheel : model_.now_.wheels) {
      if (!wheel.inside) return refusal("a wheel would stand outside of the world");
    }
    if (turn < 3) unknowns = OnThePlane();
    const Vector before = unknowns;
    unknowns = Balance(unknowns);
    if ((unknowns - before).cwiseAbs().maxCoeff() < 10.0 * kSettled_m) break;
  }
  Place(unknowns);
  Load();
  return {};
}

void OdeEquilibrium::SetInMotion() {
  const Eigen::Vector3d origin = model_.p_WB_W();
  const Eigen::Quaterniond q = model_.chassis().q_WG;
  const bool cruises = IsCruise(initial_);
  const Eigen::Vector3d along = Along(), forward = q * Eigen::Vector3d::UnitX();
  const Eigen::Vector3d v = cruises ? Eigen::Vector3d(initial_.speed_mps / along.dot(forward) * along)
                                    : q * Eigen::Vector3d(initial_.speed_mps, initial_.lateral_speed_mps, 0.0);
  const Eigen::Vector3d w_G(0.0, 0.0, initial_.yaw_rate_radps);
  const bool rests = v.norm() < kStandstill_mps && std::fabs(initial_.yaw_rate_radps) < kStandstill_mps;
  for (RigidBody& body : model_.now_.bodies) {
    body.w_WG_G = w_G;
    body.v_WG_W = v + (q * w_G).cross(body.p_WG_W - origin);
  }
  for (std::size_t i = 0; i < kWheels; ++i) {
    OdeModel::Wheel& wheel = model_.now_.wheels[i];
    OdeModel::Contact& contact = model_.contacts_[i];
    const TyreSettings& tyre = model_.tyres_[i];
    wheel.spin_rad = 0.0;
    wheel.spin_radps = 0.0;
    if (cruises && contact.load_N > 0.0) {
      const TyreForces wanted{Holding(i).dot(contact.along_W), Holding(i).dot(contact.across_W)};
      const TyreMotion motion = wheel.tyre.SetToRollAndBear(tyre, wanted, model_.MotionOf(i, contact).vx_mps,
                                                            contact.load_N, wheel.friction, contact.camber_rad);
      wheel.spin_radps = (motion.vx_mps - motion.vsx_mps) / car().wheel.rolling_radius_m;
      model_.now_.bodies[i].w_WG_G.y() += wheel.spin_radps;
    } else if (rests && load_N_ > 0.0) {
      wheel.tyre.SetToBear(tyre, {Holding(i).dot(contact.along_W), Holding(i).dot(contact.across_W)}, contact.load_N,
                           wheel.friction, contact.camber_rad);
    } else {
      wheel.spin_radps = model_.MotionOf(i, contact).vx_mps / car().wheel.rolling_radius_m;
      model_.now_.bodies[i].w_WG_G.y() += wheel.spin_radps;
      wheel.tyre.SetToRoll(tyre, model_.MotionOf(i, contact), contact.load_N, wheel.friction);
    }
    contact.forces = wheel.tyre.Forces(tyre, model_.MotionOf(i, contact), contact.load_N, wheel.friction);
  }
  std::array<double, kWheels> spin_radps{};
  for (std::size_t i = 0; i < kWheels; ++i) spin_radps[i] = model_.now_.wheels[i].spin_radps;
  const double turning = TurningOf(car().powertrain, spin_radps);
  if (cruises)
    model_.now_.powertrain.StartSteadily(car().powertrain, turning, cruise_.at_wheel_Nm);
  else
    model_.now_.powertrain.Start(car().powertrain, rests ? 0.0 : turning);
  model_.now_.forward_mps2 = 0.0;
}

base::Status OdeModel::Initialise(const InitialCondition& initial, ground::Ground& ground) {
  if (!IsFinite(initial))
    return base::WrongInput("vehicle.wrong_start", "the car's initial place or speed is not a finite number");
  const Motion before = now_;
  const Contacts contacts_before = contacts_;
  now_ = Motion();
  OdeEquilibrium equilibrium(*this, initial);
  if (const base::Status status = equilibrium.Find(ground); !status) {
    now_ = before;
    contacts_ = contacts_before;
    return status;
  }
  equilibrium.SetInMotion();
  torques_ = {};
  drag_N_ = 0.0;
  state_ = VehicleState();
  Publish(Controls{}, 0.0);
  return {};
}

}  // namespace rodeira::dynamics
