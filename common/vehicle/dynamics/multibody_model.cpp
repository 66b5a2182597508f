// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/multibody_model.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/assert.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/vehicle/dynamics/edge_contact.hpp"
#include "common/vehicle/dynamics/enveloping.hpp"
#include "common/vehicle/dynamics/parts_file.hpp"
#include "common/vehicle/dynamics/tyre_pressure.hpp"

namespace rodeira::dynamics {
namespace {

constexpr int kMaxHalvings = 3;

TyreMotion Halfway(const TyreMotion& a, const TyreMotion& b) {
  return {0.5 * (a.vx_mps + b.vx_mps), 0.5 * (a.vsx_mps + b.vsx_mps), 0.5 * (a.vsy_mps + b.vsy_mps),
          0.5 * (a.camber_rad + b.camber_rad), 0.5 * (a.turn_radps + b.turn_radps)};
}

}  // namespace

base::Status MultibodyModel::Build() {
  for (TyreSettings& tyre : tyres_) LimitDamping(settings_.wheel, settings_.longest_substep_s, tyre);
  multibody::Drawing drawing = settings_.mechanism;
  const multibody::Frame& chassis = drawing.bodies[static_cast<std::size_t>(settings_.chassis)].frame;
  origin_ = chassis.PointAt(Eigen::Vector3d::Zero());
  for (std::size_t i = 0; i < kWheels; ++i) {
    const MultibodyWheelSettings& hung = settings_.wheels[i];
    WheelLoad::Settings load;
    load.carrier = drawing.bodies[static_cast<std::size_t>(hung.carrier)].frame;
    load.centre = hung.centre;
    load.axle = hung.axle;
    load.radius_m = settings_.wheel.radius_m;
    load.vertical_Npm = settings_.wheel.vertical_Npm;
    load.damping_Nspm = settings_.tyre_damping_Nspm;
    load.bottom_m = kMaxTyreDeflection * settings_.wheel.radius_m;
    load.spin_inertia_kgm2 = settings_.wheel.inertia_kgm2;
    wheels_[i].load = std::make_shared<WheelLoad>(load);
    drawing.loads.push_back({"wheel", wheels_[i].load});
  }
  chassis_load_ = std::make_shared<ChassisLoad>(chassis, chassis.PointAt(settings_.drag_point_m),
                                                0.5 * settings_.air_density_kgpm3 * settings_.drag_area_m2);
  column_load_ = std::make_shared<ColumnLoad>(settings_.steering.angle, settings_.steering.column_Nmprad,
                                              settings_.steering.column_Nmsprad);
  body_load_ = std::make_shared<BodyLoad>(chassis, CollisionSettings{});
  drawing.loads.push_back({"chassis", chassis_load_});
  drawing.loads.push_back({"body", body_load_});
  drawing.loads.push_back({"column", column_load_});
  auto system = multibody::System::Make(drawing);
  if (!system) return system.error();
  system_ = std::move(system).value();
  ahead_q_.assign(system_->q().size(), 0.0);
  ahead_qd_ = ahead_q_;
  if (auto status = system_->Start(); !status) return status;
  // Where the car stands level on z = 0 is the published frame.
  ground::PlaneGround level;
  if (auto status = Initialise({}, level); !status) return status;
  const Eigen::Isometry3d X_WC = X_WB();  // X_CB is the identity as yet
  X_CB_ = X_WC.inverse();
  body_load_->SetBody(X_CB_, settings_.dimensions);
  for (std::size_t i = 0; i < kWheels; ++i) hub_rest_B_[i] = Hub_W(i);
  FillAssistCar();
  return Initialise({}, level);
}

// As the car stands.
void MultibodyModel::FillAssistCar() {
  assist_car_.rolling_radius_m = settings_.wheel.rolling_radius_m;
  assist_car_.wheel_inertia_kgm2 = settings_.wheel.inertia_kgm2;
  assist_car_.wheelbase_m = settings_.dimensions.wheelbase_m;
  assist_car_.track_m = {settings_.dimensions.track_front_m, settings_.dimensions.track_rear_m};
  assist_car_.mass_kg = settings_.mass_kg;
  double height_kgm = 0.0;
  for (const auto& body : system_->drawing().bodies)
    height_kgm += body.mass_kg * multibody::Evaluate(body.centre, system_->q().data()).z();
  assist_car_.cg_height_m = height_kgm / settings_.mass_kg;
  const Contacts contacts = FindContacts(system_->motion());
  for (std::size_t i = 0; i < kWheels; ++i) {
    assist_car_.static_load_N[i] = contacts[i].load_N;
    assist_car_.driven[i] = Drives(settings_.powertrain.driven, AxleOf(i));
  }
}

Eigen::Vector3d MultibodyModel::Hub_W(std::size_t wheel) const {
  return system_->motion().At(settings_.wheels[wheel].centre);
}

Eigen::Isometry3d MultibodyModel::X_WB() const {
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
  X_WC.linear() =
      system_->drawing().bodies[static_cast<std::size_t>(settings_.chassis)].frame.Rotation(system_->q().data());
  X_WC.translation() = multibody::Evaluate(origin_, system_->q().data());
  return X_WC * X_CB_;
}

Eigen::Vector3d MultibodyModel::Forward_W() const {
  return multibody::Evaluate(system_->drawing().bodies[static_cast<std::size_t>(settings_.chassis)].frame.axes[0],
                             system_->q().data());
}

// ½ Σ e × ė.
Eigen::Vector3d MultibodyModel::Turning_W(const multibody::Frame& frame, const multibody::Motion& motion) const {
  Eigen::Vector3d turning = Eigen::Vector3d::Zero();
  for (const multibody::Form& axis : frame.axes)
    turning += 0.5 * multibody::Evaluate(axis, motion.q).cross(multibody::Evaluate(axis, motion.qd));
  return turning;
}

void MultibodyModel::GiveGround(std::size_t wheel) {
  wheels_[wheel].load->SetPlane(wheels_[wheel].plane_W, wheels_[wheel].normal_W);
}

void MultibodyModel::QueryGround(ground::Ground& ground) {
  WheelPlaces places;
  std::array<WheelGround*, kWheels> wheels{};
  for (std::size_t i = 0; i < kWheels; ++i) {
    places.hubs_W[i] = Hub_W(i);
    places.axles_W[i] = system_->motion().At(settings_.wheels[i].axle);
    wheels[i] = &wheels_[i];
  }
  dynamics::QueryGround(ground, settings_.wheel.enveloping, settings_.wheel.radius_m, places, wheels);
}

void MultibodyModel::Step(const Controls& controls, ground::Ground& ground, double dt_s) {
  RODEIRA_ASSERT(dt_s > 0.0 && dt_s <= kMaxStep_s);
  const Controls clamped = Clamp(controls);
  std::array<WheelGround, kWheels> before;
  for (std::size_t i = 0; i < kWheels; ++i) before[i] = wheels_[i];
  const Plane was = GroundPlane({&before[0], &before[1], &before[2], &before[3]});
  QueryGround(ground);
  for (std::size_t i = 0; i < kWheels; ++i)
    RollOn(before[i], {Hub_W(i), system_->motion().At(settings_.wheels[i].axle), settings_.wheel.radius_m}, wheels_[i]);
  const Plane under = GroundPlane({&wheels_[0], &wheels_[1], &wheels_[2], &wheels_[3]});
  lowered_m_ = LoweredBy(was, lowered_m_, under, X_WB(), BoxOf(settings_.dimensions, CollisionSettings{}));
  body_load_->SetGround(under.point_W - lowered_m_ * under.normal_W, under.normal_W);
  body_load_->SetPush(push_);
  const int substeps = std::max(1, static_cast<int>(std::ceil(dt_s / settings_.longest_substep_s - 1e-6)));
  for (int i = 0; i < substeps; ++i) Substep(clamped, dt_s / substeps);
  push_ = {};
  Publish(clamped, dt_s);
}

MultibodyModel::Contacts MultibodyModel::FindContacts(const multibody::Motion& motion) const {
  Contacts contacts;
  for (std::size_t i = 0; i < kWheels; ++i) contacts[i] = wheels_[i].load->ContactAt(motion);
  return contacts;
}

// Sideways the contact moves with the carrier (camber and steer rates count); along, the hub's speed and the spin do.
TyreMotion MultibodyModel::MotionOf(std::size_t wheel, const multibody::Motion& motion,
                                    const WheelLoad::Contact& contact) const {
  const MultibodyWheelSettings& hung = settings_.wheels[wheel];
  const Eigen::Vector3d hub_v = motion.RateOf(hung.centre);
  const Eigen::Vector3d turning =
      Turning_W(system_->drawing().bodies[static_cast<std::size_t>(hung.carrier)].frame, motion);
  const Eigen::Vector3d v = hub_v + turning.cross(contact.point_W - motion.At(hung.centre));
  TyreMotion rolling;
  rolling.vx_mps = hub_v.dot(contact.along_W);
  rolling.vsx_mps = rolling.vx_mps - wheels_[wheel].spin_radps * settings_.wheel.rolling_radius_m;
  rolling.vsy_mps = v.dot(contact.across_W);
  rolling.camber_rad = contact.camber_rad;
  rolling.turn_radps = turning.dot(wheels_[wheel].normal_W);
  return rolling;
}

MultibodyModel::Rolling MultibodyModel::FindRolling(const multibody::Motion& motion, const Contacts& contacts) const {
  Rolling rolling;
  for (std::size_t i = 0; i < kWheels; ++i) rolling[i] = MotionOf(i, motion, contacts[i]);
  return rolling;
}

WheelTorques MultibodyModel::TurnWheels(const Controls& controls, const std::array<double, kWheels>& loads_N,
                                        const std::array<TyreForces, kWheels>& forces, double dt_s) {
  WheelDriveInput input;
  input.load_N = loads_N;
  input.speed_mps = multibody::Evaluate(origin_, system_->qd().data()).dot(Forward_W());
  input.forward_mps2 = forward_mps2_;
  std::array<double, kWheels> spin_radps{};
  for (std::size_t i = 0; i < kWheels; ++i) {
    input.longitudinal_N[i] = forces[i].longitudinal_N;
    input.resistance_share[i] = tyres_[i].resistance_share;
    spin_radps[i] = wheels_[i].spin_radps;
  }
  if (settings_.assists.any()) {
    const multibody::Frame& frame = system_->drawing().bodies[static_cast<std::size_t>(settings_.chassis)].frame;
    const Eigen::Vector3d up = multibody::Evaluate(frame.axes[2], system_->q().data());
    input.lateral_mps2 = lateral_mps2_;
    input.yaw_rate_radps = Turning_W(frame, system_->motion()).dot(up);
    input.front_wheel_rad = hands_rad_ / settings_.steering.ratio;
  }
  const WheelDriveSettings drive{settings_.wheel, settings_.brakes, settings_.powertrain, settings_.assists,
                                 assist_car_};
  WheelTorques torques = dynamics::TurnWheels(drive, controls, input, dt_s, powertrain_, assists_, spin_radps);
  // The brake's share of the friction that acted: the rest is rolling resistance.
  for (std::size_t i = 0; i < kWheels; ++i) {
    const double rolling_Nm =
        settings_.wheel.rolling_resistance * tyres_[i].resistance_share * loads_N[i] * settings_.wheel.rolling_radius_m;
    const double most_Nm = torques.brake_Nm[i] + rolling_Nm;
    torques.friction_Nm[i] *= most_Nm > 0.0 ? torques.brake_Nm[i] / most_Nm : 0.0;
    wheels_[i].spin_radps = spin_radps[i];
  }
  return torques;
}

void MultibodyModel::SetTyrePressures(const std::array<double, kWheels>& shares) {
  for (std::size_t i = 0; i < kWheels; ++i) {
    SetPressure(tyres_[i], shares[i]);
    wheels_[i].load->SetStiffness(tyres_[i].vertical_share * settings_.wheel.vertical_Npm);
  }
}

// The wheels turn under the forces of the step's middle; the mechanism, with a rule that takes the mean of both ends,
// gets those of its end. Both are found from where the present accelerations lead, so that all of it is of second
// order.
void MultibodyModel::Substep(const Controls& controls, double dt_s) {
  for (std::size_t i = 0; i < kWheels; ++i) GiveGround(i);
  system_->Foresee(dt_s, ahead_q_, ahead_qd_);
  const multibody::Motion ahead{ahead_q_.data(), ahead_qd_.data(), system_->time_s() + dt_s};
  const Contacts before = FindContacts(system_->motion()), foreseen = FindContacts(ahead);
  const Rolling began = FindRolling(system_->motion(), before);
  const Rolling goes_on = FindRolling(ahead, foreseen);
  std::array<double, kWheels> loads_N{};
  for (std::size_t i = 0; i < kWheels; ++i) {
    loads_N[i] = 0.5 * (before[i].load_N + foreseen[i].load_N);
    forces_[i] = wheels_[i].tyre.ForcesAfter(tyres_[i], began[i], Halfway(began[i], goes_on[i]), loads_N[i],
                                             wheels_[i].friction, 0.5 * dt_s);
  }
  torques_ = TurnWheels(controls, loads_N, forces_, dt_s);
  const Rolling ends = FindRolling(ahead, foreseen);  // with the new spins
  for (std::size_t i = 0; i < kWheels; ++i)
    forces_[i] =
        wheels_[i].tyre.ForcesAfter(tyres_[i], began[i], ends[i], foreseen[i].load_N, wheels_[i].friction, dt_s);
  double drive_Nm = 0.0;
  for (std::size_t i = 0; i < kWheels; ++i) {
    wheels_[i].load->SetStep(forces_[i], torques_.friction_Nm[i], wheels_[i].spin_radps);
    drive_Nm += torques_.drive_Nm[i];
  }
  chassis_load_->SetDrive(drive_Nm);
  const double limit = settings_.steering.limit_rad;
  const double hands = std::clamp(controls.steering_wheel_rad, -limit, limit);
  column_load_->SetHands(hands, 0.0);
  hands_rad_ = hands;
  const Eigen::Vector3d before_W = multibody::Evaluate(origin_, system_->qd().data());
  Advance(dt_s, 0);
  const Eigen::Vector3d gained_W = multibody::Evaluate(origin_, system_->qd().data()) - before_W;
  forward_mps2_ = gained_W.dot(Forward_W()) / dt_s;
  lateral_mps2_ =
      gained_W.dot(multibody::Evaluate(
          system_->drawing().bodies[static_cast<std::size_t>(settings_.chassis)].frame.axes[1], system_->q().data())) /
      dt_s;
  const Contacts after = FindContacts(system_->motion());
  const Rolling ended = FindRolling(system_->motion(), after);
  for (std::size_t i = 0; i < kWheels; ++i) {
    Wheel& wheel = wheels_[i];
    wheel.tyre.Advance(tyres_[i], began[i], ended[i], after[i].load_N, wheel.friction, dt_s);
    wheel.spin_rad = geometry::WrapAngle(wheel.spin_rad + dt_s * wheel.spin_radps);
  }
}

// A step that does not converge (a blow, a wall) is divided; at last the car is brought to rest where it was.
void MultibodyModel::Advance(double dt_s, int depth) {
  report_ = system_->Step(dt_s);
  if (report_.converged) return;
  system_->Undo();
  if (depth < kMaxHalvings) {
    for (int half = 0; half < 2; ++half) Advance(0.5 * dt_s, depth + 1);
    return;
  }
  std::fill(system_->qd().begin(), system_->qd().end(), 0.0);
  (void)system_->FindAccelerations();
}

}  // namespace rodeira::dynamics
