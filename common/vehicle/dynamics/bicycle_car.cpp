// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/bicycle_car.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/constants.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/vehicle/dynamics/edge_contact.hpp"
#include "common/vehicle/dynamics/parts_file.hpp"

namespace rodeira::dynamics {
namespace {

constexpr double kMinLean = 0.0;         // cosine between strut and normal: at a wall the strut bears nothing
constexpr double kMaxTilt_rad = 0.45;    // of the body against the ground under it
constexpr double kSurelyUpright = 0.95;  // a cosine over that of the most tilt
constexpr double kMinHeight = 0.4;       // of the centre of gravity over that ground, share of its height at rest
constexpr double kMinNormalZ = 0.6;      // of the steepest ground that the body follows
constexpr double kMaxBodyRate_radps = 20.0;

bool IsFront(std::size_t wheel) { return wheel == kFrontLeft || wheel == kFrontRight; }
bool IsLeft(std::size_t wheel) { return wheel == kFrontLeft || wheel == kRearLeft; }
std::size_t PartnerOf(std::size_t wheel) { return wheel ^ 1u; }

}  // namespace

BicycleChassis::BicycleChassis(const BicycleSettings& of) : settings(of) {
  for (TyreSettings& tyre : settings.tyre) LimitDamping(settings.wheel, kLongestSubstep_s, tyre);
  tyres = OnWheels(settings.tyre);
  assist_car = AssistCarOf(settings);
  const BodySettings& body = settings.body;
  p_BG_B = {0.5 * body.wheelbase_m - body.cg_to_front_axle_m, 0.0, body.cg_height_m};
  const double weight = body.mass_kg * base::kGravity_mps2;
  const double front_share = 1.0 - body.cg_to_front_axle_m / body.wheelbase_m;
  for (std::size_t i = 0; i < kWheels; ++i)
    static_load_N[i] = 0.5 * weight * (IsFront(i) ? front_share : 1.0 - front_share);
  for (std::size_t i = 0; i < kWheels; ++i) p_GH_B[i] = HubAtRest_B(i) - p_BG_B;
}

double BicycleChassis::SteerAngle(std::size_t wheel, double steering_wheel_rad) const {
  const double limit = settings.steering.limit_rad;
  return IsFront(wheel) ? std::clamp(steering_wheel_rad, -limit, limit) / settings.steering.ratio : 0.0;
}

Eigen::Vector3d BicycleChassis::HubAtRest_B(std::size_t wheel) const {
  const VehicleDimensions& d = settings.dimensions;
  const double half_track = 0.5 * (IsFront(wheel) ? d.track_front_m : d.track_rear_m);
  const double sunk = static_load_N[wheel] / settings.wheel.vertical_Npm;
  return {(IsFront(wheel) ? 0.5 : -0.5) * d.wheelbase_m, IsLeft(wheel) ? half_track : -half_track,
          settings.wheel.radius_m - sunk};
}

BicyclePose BicycleCar::PoseOf(const BicycleChassis& chassis, double steering_wheel_rad) const {
  BicyclePose pose;
  pose.up_W = body.q_WG * Eigen::Vector3d::UnitZ();
  const double steer = chassis.SteerAngle(kFrontLeft, steering_wheel_rad);
  pose.heading_W = {body.q_WG * Eigen::Vector3d(std::cos(steer), std::sin(steer), 0.0),
                    body.q_WG * Eigen::Vector3d::UnitX()};
  for (std::size_t i = 0; i < kWheels; ++i) pose.hub_W[i] = HubAtRest_W(chassis, i);
  return pose;
}

CornerInput BicycleCar::CornerInputOf(const BicycleChassis& chassis, const BicyclePose& pose, std::size_t wheel) const {
  const Wheel& w = wheels[wheel];
  const WheelSettings& tyre = chassis.settings.wheel;
  CornerInput input;
  input.static_load_N = chassis.static_load_N[wheel];
  input.tyre_Npm = chassis.tyres[wheel].vertical_share * tyre.vertical_Npm;
  input.free_gap_m = tyre.radius_m - (pose.hub_W[wheel] - w.plane_W).dot(w.normal_W);
  input.lean = std::clamp(pose.up_W.dot(w.normal_W), kMinLean, 1.0);
  input.other_travel_m = wheels[PartnerOf(wheel)].corner.travel_m();
  input.bottom_m = kMaxTyreDeflection * tyre.radius_m;
  return input;
}

BicycleContact BicycleCar::ContactOf(const BicyclePose& pose, std::size_t wheel) const {
  const Wheel& w = wheels[wheel];
  const Eigen::Vector3d hub = pose.hub_W[wheel] + w.corner.travel_m() * pose.up_W;
  BicycleContact contact;
  contact.point_W = hub - (hub - w.plane_W).dot(w.normal_W) * w.normal_W;
  const Eigen::Vector3d& heading = pose.heading_W[AxleOf(wheel)];
  const Eigen::Vector3d along = heading - heading.dot(w.normal_W) * w.normal_W;
  const double size = along.norm();
  contact.along_W = size > 1e-3 ? Eigen::Vector3d(along / size) : heading;  // a wall straight ahead
  contact.across_W = w.normal_W.cross(contact.along_W);
  return contact;
}

std::array<TyreMotion, kWheels> BicycleCar::MotionOf(const BicycleChassis& chassis, const BicycleContacts& contacts,
                                                     double steer_radps) const {
  std::array<TyreMotion, kWheels> motion;
  const Eigen::Vector3d w_WG_W = body.w_WG_W();
  for (const std::size_t left : {0u, 2u}) {
    const Eigen::Vector3d middle = 0.5 * (contacts[left].point_W + contacts[left + 1].point_W);
    const Eigen::Vector3d v = body.v_WG_W + w_WG_W.cross(middle - body.p_WG_W);
    for (const std::size_t i : {left, left + 1}) {
      const Eigen::Vector3d own = body.v_WG_W + w_WG_W.cross(contacts[i].point_W - body.p_WG_W);
      const double vx = own.dot(contacts[i].along_W);
      motion[i] = {vx, vx - wheels[i].spin_radps * chassis.settings.wheel.rolling_radius_m, v.dot(contacts[i].across_W),
                   0.0, w_WG_W.dot(wheels[i].normal_W) + (IsFront(i) ? steer_radps : 0.0)};
    }
  }
  return motion;
}

// The tyre is pressed in along the normal, whatever the camber.
void BicycleCar::RollOn(const BicycleChassis& chassis, const std::array<WheelGround, kWheels>& before) {
  const Eigen::Vector3d up_W = body.q_WG * Eigen::Vector3d::UnitZ();
  for (std::size_t i = 0; i < kWheels; ++i) {
    const WheelDisc disc{HubAtRest_W(chassis, i) + wheels[i].corner.travel_m() * up_W, Eigen::Vector3d::Zero(),
                         chassis.settings.wheel.radius_m};
    dynamics::RollOn(before[i], disc, wheels[i]);
  }
}

void BicycleCar::Step(const BicycleChassis& chassis, const Controls& controls, const Wrench& push, double dt_s,
                      BicycleFindings& findings) {
  const int substeps = std::max(1, static_cast<int>(std::ceil(dt_s / kLongestSubstep_s - 1e-6)));
  for (int i = 0; i < substeps; ++i) Substep(chassis, controls, push, dt_s / substeps, findings);
}

void BicycleCar::Substep(const BicycleChassis& chassis, const Controls& controls, const Wrench& push, double dt_s,
                         BicycleFindings& findings) {
  BicycleContacts& contacts = findings.contacts;
  const BicyclePose pose = PoseOf(chassis, controls.steering_wheel_rad);
  std::array<CornerInput, kWheels> inputs;
  for (std::size_t i = 0; i < kWheels; ++i) inputs[i] = CornerInputOf(chassis, pose, i);
  for (std::size_t i = 0; i < kWheels; ++i) {
    wheels[i].corner.Step(chassis.settings.suspension[AxleOf(i)], inputs[i], dt_s);
    contacts[i] = ContactOf(pose, i);
  }
  const std::array<TyreMotion, kWheels> before = MotionOf(chassis, contacts);
  for (std::size_t i = 0; i < kWheels; ++i) {
    Wheel& wheel = wheels[i];
    contacts[i].forces = wheel.tyre.Forces(chassis.tyres[i], before[i], wheel.corner.load_N(), wheel.friction);
  }
  TurnWheels(chassis, controls, dt_s, findings);
  PushBody(chassis, push, dt_s, findings);
  const double steer = chassis.SteerAngle(kFrontLeft, controls.steering_wheel_rad);
  const std::array<TyreMotion, kWheels> after = MotionOf(chassis, contacts, (steer - steer_rad) / dt_s);
  steer_rad = steer;
  for (std::size_t i = 0; i < kWheels; ++i) {
    Wheel& wheel = wheels[i];
    wheel.tyre.Advance(chassis.tyres[i], after[i], wheel.corner.load_N(), wheel.friction, dt_s);
    wheel.spin_rad = geometry::WrapAngle(wheel.spin_rad + dt_s * wheel.spin_radps);
  }
  body.Move(dt_s);
  KeepUpright(chassis, contacts, dt_s);
}

void BicycleCar::TurnWheels(const BicycleChassis& chassis, const Controls& controls, double dt_s,
                            BicycleFindings& findings) {
  WheelDriveInput input;
  input.speed_mps = (body.q_WG.conjugate() * body.v_WG_W).x();
  input.forward_mps2 = forward_mps2;
  input.lateral_mps2 = lateral_mps2;
  input.yaw_rate_radps = body.w_WG_G.z();
  input.front_wheel_rad = chassis.SteerAngle(kFrontLeft, controls.steering_wheel_rad);
  std::array<double, kWheels> spin_radps{};
  for (std::size_t i = 0; i < kWheels; ++i) {
    input.load_N[i] = wheels[i].corner.load_N();
    input.longitudinal_N[i] = findings.contacts[i].forces.longitudinal_N;
    input.resistance_share[i] = chassis.tyres[i].resistance_share;
    spin_radps[i] = wheels[i].spin_radps;
  }
  findings.torques = dynamics::TurnWheels(chassis.drive(), controls, input, dt_s, powertrain, assists, spin_radps);
  for (std::size_t i = 0; i < kWheels; ++i) wheels[i].spin_radps = spin_radps[i];
}

void BicycleCar::PushBody(const BicycleChassis& chassis, const Wrench& push, double dt_s, BicycleFindings& findings) {
  const BicycleContacts& contacts = findings.contacts;
  const BodySettings& of = chassis.settings.body;
  const double speed = body.v_WG_W.norm();
  findings.drag_N = AirDrag(of.air_density_kgpm3, of.drag_area_m2, speed);
  Eigen::Vector3d force(0.0, 0.0, -of.mass_kg * base::kGravity_mps2);
  if (speed > 0.0) force -= findings.drag_N / speed * body.v_WG_W;
  force += push.force_W;
  Eigen::Vector3d moment = push.moment_WB_W + (p_WB_W(chassis) - body.p_WG_W).cross(push.force_W);
  for (std::size_t axle = 0; axle < 2; ++axle) {
    const BicycleContact& left = contacts[2 * axle];
    const BicycleContact& right = contacts[2 * axle + 1];
    Eigen::Vector3d lateral = Eigen::Vector3d::Zero();
    for (std::size_t i = 2 * axle; i < 2 * axle + 2; ++i) {
      const Eigen::Vector3d normal = wheels[i].corner.load_N() * wheels[i].normal_W;
      force += normal;
      moment += (contacts[i].point_W - body.p_WG_W).cross(normal) + contacts[i].forces.aligning_Nm * wheels[i].normal_W;
      const Eigen::Vector3d along = contacts[i].forces.longitudinal_N * contacts[i].along_W;
      force += along;
      moment += (contacts[i].point_W - body.p_WG_W).cross(along);
      lateral += contacts[i].forces.lateral_N * contacts[i].across_W;
    }
    force += lateral;
    moment += (0.5 * (left.point_W + right.point_W) - body.p_WG_W).cross(lateral);
  }
  const Eigen::Vector3d before = body.v_WG_W;
  body.Push(force, moment, of.mass_kg, {of.roll_inertia_kgm2, of.pitch_inertia_kgm2, of.yaw_inertia_kgm2}, dt_s);
  forward_mps2 = (body.v_WG_W - before).dot(body.q_WG * Eigen::Vector3d::UnitX()) / dt_s;
  lateral_mps2 = (body.v_WG_W - before).dot(body.q_WG * Eigen::Vector3d::UnitY()) / dt_s;
}

Eigen::Vector3d RoadNormal(const BicycleContacts& contacts) {
  const Eigen::Vector3d rising = contacts[kFrontLeft].point_W - contacts[kRearRight].point_W;
  const Eigen::Vector3d falling = contacts[kFrontRight].point_W - contacts[kRearLeft].point_W;
  const Eigen::Vector3d cross = falling.cross(rising);
  const double size = cross.norm();
  if (!(size > 1e-3) || cross.z() < kMinNormalZ * size) return Eigen::Vector3d::UnitZ();
  return cross / size;
}

// Bounds that a car meets only in flight, on walls and on cliffs, where a single-track model means nothing any more.
// They take back what the last step has moved beyond them, and no more: where the ground under the car has changed,
// they do not lift it.
void BicycleCar::KeepUpright(const BicycleChassis& chassis, const BicycleContacts& contacts, double dt_s) {
  const Eigen::Vector3d normal = RoadNormal(contacts);
  const Eigen::Vector3d up = body.q_WG * Eigen::Vector3d::UnitZ();
  const double upright = up.dot(normal);
  const double tilt = upright > kSurelyUpright ? 0.0 : std::acos(std::clamp(upright, -1.0, 1.0));
  if (tilt > kMaxTilt_rad) {
    const Eigen::Vector3d cross = up.cross(normal);
    const Eigen::Vector3d axis =
        cross.norm() > 1e-9 ? Eigen::Vector3d(cross.normalized()) : body.q_WG * Eigen::Vector3d::UnitX();
    const Eigen::Vector3d turning = body.q_WG.conjugate() * axis;
    const double away_radps = std::min(0.0, body.w_WG_G.dot(turning));
    const double back_rad = std::min(tilt - kMaxTilt_rad, -away_radps * dt_s);
    body.q_WG = (Eigen::Quaterniond(Eigen::AngleAxisd(back_rad, axis)) * body.q_WG).normalized();
    body.w_WG_G -= away_radps * turning;
  }
  const double turn = body.w_WG_G.norm();
  if (turn > kMaxBodyRate_radps) body.w_WG_G *= kMaxBodyRate_radps / turn;

  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const BicycleContact& contact : contacts) middle += 0.25 * contact.point_W;
  const double missing = kMinHeight * chassis.settings.body.cg_height_m - (body.p_WG_W - middle).dot(normal);
  if (missing > 0.0) {
    const double down_mps = std::min(0.0, body.v_WG_W.dot(normal));
    body.p_WG_W += std::min(missing, -down_mps * dt_s) * normal;
    body.v_WG_W -= down_mps * normal;
  }
}

void BicycleCar::Wheel::Save(base::StateWriter& writer) const {
  WheelGround::Save(writer);
  writer.Put("corner", corner);
  writer.Put("tyre", tyre);
  writer.Put("spin_rad", spin_rad);
  writer.Put("spin_radps", spin_radps);
}

void BicycleCar::Wheel::Restore(base::StateReader& reader) {
  WheelGround::Restore(reader);
  reader.Get("corner", corner);
  reader.Get("tyre", tyre);
  reader.Get("spin_rad", spin_rad);
  reader.Get("spin_radps", spin_radps);
}

void BicycleCar::Save(base::StateWriter& writer) const {
  writer.Put("body", body);
  for (const Wheel& wheel : wheels) writer.Put("wheel", wheel);
  writer.Put("powertrain", powertrain);
  writer.Put("assists", assists);
  writer.Put("forward_mps2", forward_mps2);
  writer.Put("lateral_mps2", lateral_mps2);
  writer.Put("steer_rad", steer_rad);
}

void BicycleCar::Restore(base::StateReader& reader) {
  reader.Get("body", body);
  for (Wheel& wheel : wheels) reader.Get("wheel", wheel);
  reader.Get("powertrain", powertrain);
  reader.Get("assists", assists);
  reader.Get("forward_mps2", forward_mps2);
  reader.Get("lateral_mps2", lateral_mps2);
  reader.Get("steer_rad", steer_rad);
}

}  // namespace rodeira::dynamics
