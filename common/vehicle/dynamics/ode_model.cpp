// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/ode_model.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/assert.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/vehicle/dynamics/edge_contact.hpp"
#include "common/vehicle/dynamics/enveloping.hpp"

namespace rodeira::dynamics {
base::Status OdeModel::Build() {
  measures_ = ChassisOf(settings_);
  assist_car_ = AssistCarOf(settings_.car);
  car_ = std::make_unique<OdeCar>(settings_);
  ground::PlaneGround level;
  return Initialise({}, level);
}

Eigen::Vector3d OdeModel::p_WB_W() const { return chassis().p_WG_W - chassis().q_WG * measures_.p_BG_B; }

double OdeModel::SteerAngle(std::size_t wheel, double steering_wheel_rad) const {
  const SteeringSettings& steering = settings_.car.steering;
  return AxleOf(wheel) == 0 ? std::clamp(steering_wheel_rad, -steering.limit_rad, steering.limit_rad) / steering.ratio
                            : 0.0;
}

double OdeModel::Travel(std::size_t wheel) const {
  const Eigen::Vector3d hub_B = chassis().q_WG.conjugate() * (now_.bodies[wheel].p_WG_W - p_WB_W());
  return hub_B.z() - HubAtRest_B(settings_.car, wheel).z();
}

double OdeModel::TravelRate(std::size_t wheel) const {
  const RigidBody& hub = now_.bodies[wheel];
  return (chassis().q_WG.conjugate() * (hub.v_WG_W - chassis().VelocityAt(hub.p_WG_W))).z();
}

double OdeModel::StrutExtra(std::size_t wheel) const {
  const SuspensionSettings& suspension = settings_.car.suspension[AxleOf(wheel)];
  const double travel = Travel(wheel);
  const double beyond = travel - std::clamp(travel, -suspension.rebound_m, suspension.bump_m);
  return PreloadOf(settings_, wheel) + suspension.anti_roll_Npm * (travel - Travel(wheel ^ 1u)) +
         settings_.stop_Npm * beyond;
}

void OdeModel::QueryGround(ground::Ground& ground) {
  WheelPlaces places;
  std::array<WheelGround*, kWheels> wheels{};
  for (std::size_t i = 0; i < kWheels; ++i) {
    places.hubs_W[i] = now_.bodies[i].p_WG_W;
    places.axles_W[i] = now_.bodies[i].q_WG * Eigen::Vector3d::UnitY();
    wheels[i] = &now_.wheels[i];
  }
  dynamics::QueryGround(ground, settings_.car.wheel.enveloping, settings_.car.wheel.radius_m, places, wheels);
}

OdeModel::Contact OdeModel::ContactOf(std::size_t wheel) const {
  const WheelSettings& tyre = settings_.car.wheel;
  const Wheel& w = now_.wheels[wheel];
  const RigidBody& hub = now_.bodies[wheel];
  Contact contact;
  static_cast<DiscContact&>(contact) =
      MeetPlane(hub.p_WG_W, hub.q_WG * Eigen::Vector3d::UnitY(), tyre.radius_m, w.plane_W, w.normal_W);
  const double pressed = std::min(contact.deflection_m, kMaxTyreDeflection * tyre.radius_m);
  if (pressed > 0.0) {
    const double closing = -hub.v_WG_W.dot(w.normal_W) / contact.lean;
    const double vertical_Npm = tyres_[wheel].vertical_share * tyre.vertical_Npm;
    contact.load_N = std::clamp(vertical_Npm * pressed + settings_.tyre_damping_Nspm * closing, 0.0,
                                vertical_Npm * kMaxTyreDeflection * tyre.radius_m);
  }
  return contact;
}

// Sideways the contact moves with the hub's carrier, which turns as the wheel does but for its spin.
TyreMotion OdeModel::MotionOf(std::size_t wheel, const Contact& contact) const {
  const RigidBody& hub = now_.bodies[wheel];
  const Eigen::Vector3d axle = hub.q_WG * Eigen::Vector3d::UnitY();
  const Eigen::Vector3d turning = hub.w_WG_W() - hub.w_WG_W().dot(axle) * axle;
  TyreMotion motion;
  motion.vx_mps = hub.v_WG_W.dot(contact.along_W);
  motion.vsx_mps = motion.vx_mps - now_.wheels[wheel].spin_radps * settings_.car.wheel.rolling_radius_m;
  motion.vsy_mps = (hub.v_WG_W + turning.cross(contact.point_W - hub.p_WG_W)).dot(contact.across_W);
  motion.camber_rad = contact.camber_rad;
  motion.turn_radps = turning.dot(now_.wheels[wheel].normal_W);
  return motion;
}

void OdeModel::Step(const Controls& controls, ground::Ground& ground, double dt_s) {
  RODEIRA_ASSERT(dt_s > 0.0 && dt_s <= kMaxStep_s);
  const Controls clamped = Clamp(controls);
  car_->Give(now_.bodies);  // only what a snapshot holds
  now_.bodies = car_->bodies();
  std::array<WheelGround, kWheels> before;
  for (std::size_t i = 0; i < kWheels; ++i) before[i] = now_.wheels[i];
  const Plane was = GroundPlane({&before[0], &before[1], &before[2], &before[3]});
  QueryGround(ground);
  for (std::size_t i = 0; i < kWheels; ++i) {
    const RigidBody& hub = now_.bodies[i];
    RollOn(before[i], {hub.p_WG_W, hub.q_WG * Eigen::Vector3d::UnitY(), settings_.car.wheel.radius_m}, now_.wheels[i]);
  }
  const Plane under = GroundPlane({&now_.wheels[0], &now_.wheels[1], &now_.wheels[2], &now_.wheels[3]});
  Eigen::Isometry3d X_WB(chassis().q_WG);
  X_WB.translation() = p_WB_W();
  const CollisionSettings outline{.clearance_m = settings_.clearance_m};
  now_.lowered_m = LoweredBy(was, now_.lowered_m, under, X_WB, BoxOf(settings_.car.dimensions, outline));
  car_->SetGround(under.point_W - now_.lowered_m * under.normal_W, under.normal_W);
  const int substeps = std::max(1, static_cast<int>(std::ceil(dt_s / settings_.longest_substep_s - 1e-6)));
  for (int i = 0; i < substeps; ++i) Substep(clamped, dt_s / substeps);
  push_ = {};
  Publish(clamped, dt_s);
}

void OdeModel::Substep(const Controls& controls, double dt_s) {
  const BicycleSettings& car = settings_.car;
  for (std::size_t i = 0; i < kWheels; ++i) {
    contacts_[i] = ContactOf(i);
    contacts_[i].forces =
        now_.wheels[i].tyre.Forces(tyres_[i], MotionOf(i, contacts_[i]), contacts_[i].load_N, now_.wheels[i].friction);
  }
  torques_ = TurnWheels(controls, contacts_, dt_s);
  for (std::size_t i = 0; i < kWheels; ++i) {
    const Contact& contact = contacts_[i];
    car_->Push(i,
               contact.load_N * now_.wheels[i].normal_W + contact.forces.longitudinal_N * contact.along_W +
                   contact.forces.lateral_N * contact.across_W,
               contact.point_W);
    car_->Twist(i, contact.forces.aligning_Nm * now_.wheels[i].normal_W);
    car_->Strut(i, StrutExtra(i));
    car_->TurnWheel(i, SteerAngle(i, controls.steering_wheel_rad), now_.wheels[i].spin_radps);
  }
  const double speed = chassis().v_WG_W.norm();
  drag_N_ = AirDrag(car.body.air_density_kgpm3, car.body.drag_area_m2, speed);
  if (speed > 0.0) car_->Push(OdeCar::kChassis, -drag_N_ / speed * chassis().v_WG_W, chassis().p_WG_W);
  if (push_.any()) {
    car_->Push(OdeCar::kChassis, push_.force_W, p_WB_W());
    car_->Twist(OdeCar::kChassis, push_.moment_WB_W);
  }
  const Eigen::Vector3d before = chassis().v_WG_W;
  car_->Step(dt_s);
  now_.bodies = car_->bodies();
  now_.forward_mps2 = (chassis().v_WG_W - before).dot(chassis().q_WG * Eigen::Vector3d::UnitX()) / dt_s;
  now_.lateral_mps2 = (chassis().v_WG_W - before).dot(chassis().q_WG * Eigen::Vector3d::UnitY()) / dt_s;
  for (std::size_t i = 0; i < kWheels; ++i) {
    Wheel& wheel = now_.wheels[i];
    const Contact after = ContactOf(i);
    wheel.tyre.Advance(tyres_[i], MotionOf(i, after), after.load_N, wheel.friction, dt_s);
    wheel.spin_rad = geometry::WrapAngle(wheel.spin_rad + dt_s * wheel.spin_radps);
  }
}

WheelTorques OdeModel::TurnWheels(const Controls& controls, const Contacts& contacts, double dt_s) {
  const BicycleSettings& car = settings_.car;
  WheelDriveInput input;
  input.speed_mps = (chassis().q_WG.conjugate() * chassis().v_WG_W).x();
  input.forward_mps2 = now_.forward_mps2;
  input.lateral_mps2 = now_.lateral_mps2;
  input.yaw_rate_radps = chassis().w_WG_G.z();
  input.front_wheel_rad = SteerAngle(kFrontLeft, controls.steering_wheel_rad);
  std::array<double, kWheels> spin_radps{};
  for (std::size_t i = 0; i < kWheels; ++i) {
    input.load_N[i] = contacts[i].load_N;
    input.longitudinal_N[i] = contacts[i].forces.longitudinal_N;
    input.resistance_share[i] = tyres_[i].resistance_share;
    spin_radps[i] = now_.wheels[i].spin_radps;
  }
  const WheelDriveSettings drive{car.wheel, car.brakes, car.powertrain, car.assists, assist_car_};
  const WheelTorques torques =
      dynamics::TurnWheels(drive, controls, input, dt_s, now_.powertrain, now_.assists, spin_radps);
  for (std::size_t i = 0; i < kWheels; ++i) now_.wheels[i].spin_radps = spin_radps[i];
  return torques;
}

}  // namespace rodeira::dynamics
