#include "common/vehicle/bicycle_model.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/assert.hpp"
#include "common/geometry/angle.hpp"

namespace rodeira::vehicle {
namespace {

constexpr double kGravity_mps2 = 9.81;
constexpr double kLongestSubstep_s = 0.001;
constexpr double kMostStep_s = 0.1;
constexpr double kLeastLean = 0.3;          // cosine between strut and normal, for walls
constexpr double kBottom = 0.5;             // share of the radius that a tyre can be pressed in
constexpr double kMostTilt_rad = 0.45;      // of the body against the ground under it
constexpr double kLeastHeight = 0.4;        // of the centre of gravity over that ground, share of its height at rest
constexpr double kSteepest = 0.6;           // vertical part of the steepest ground that the body follows
constexpr double kMostTurn_radps = 20.0;

bool IsFront(std::size_t wheel) { return wheel == kFrontLeft || wheel == kFrontRight; }
bool IsLeft(std::size_t wheel) { return wheel == kFrontLeft || wheel == kRearLeft; }
std::size_t AxleOf(std::size_t wheel) { return IsFront(wheel) ? 0 : 1; }
std::size_t PartnerOf(std::size_t wheel) { return wheel ^ 1u; }

}  // namespace

BicycleModel::BicycleModel(const BicycleSettings& settings) : settings_(settings), tyres_(OnWheels(settings.tyre)) {
  const BodySettings& body = settings_.body;
  p_BG_B_ = {0.5 * body.wheelbase_m - body.cg_to_front_axle_m, 0.0, body.cg_height_m};
  const double weight = body.mass_kg * kGravity_mps2;
  const double front_share = 1.0 - body.cg_to_front_axle_m / body.wheelbase_m;
  for (std::size_t i = 0; i < kWheels; ++i) static_load_N_[i] = 0.5 * weight * (IsFront(i) ? front_share : 1.0 - front_share);
}

double BicycleModel::SteerAngle(std::size_t wheel, double steering_wheel_rad) const {
  const double limit = settings_.steering.limit_rad;
  return IsFront(wheel) ? std::clamp(steering_wheel_rad, -limit, limit) / settings_.steering.ratio : 0.0;
}

Eigen::Vector3d BicycleModel::HubAtRest_B(std::size_t wheel) const {
  const VehicleDimensions& d = settings_.dimensions;
  const double half_track = 0.5 * (IsFront(wheel) ? d.track_front_m : d.track_rear_m);
  const double sunk = static_load_N_[wheel] / settings_.wheel.vertical_Npm;
  return {(IsFront(wheel) ? 0.5 : -0.5) * d.wheelbase_m, IsLeft(wheel) ? half_track : -half_track, settings_.wheel.radius_m - sunk};
}

Eigen::Vector3d BicycleModel::p_WB_W() const { return body_.p_WG_W - body_.q_WG * p_BG_B_; }
Eigen::Vector3d BicycleModel::v_WB_W() const { return body_.VelocityAt(p_WB_W()); }
Eigen::Vector3d BicycleModel::HubAtRest_W(std::size_t wheel) const { return body_.p_WG_W + body_.q_WG * (HubAtRest_B(wheel) - p_BG_B_); }

void BicycleModel::AskGround(terrain::Ground& ground) {
  std::array<Eigen::Vector3d, kWheels> hubs_W;
  std::array<WheelGround*, kWheels> wheels{};
  for (std::size_t i = 0; i < kWheels; ++i) {
    hubs_W[i] = HubAtRest_W(i);
    wheels[i] = &wheels_[i];
  }
  vehicle::AskGround(ground, hubs_W, wheels);
}

CornerInput BicycleModel::CornerInputOf(std::size_t wheel) const {
  const Wheel& w = wheels_[wheel];
  CornerInput input;
  input.static_load_N = static_load_N_[wheel];
  input.tyre_Npm = settings_.wheel.vertical_Npm;
  input.free_gap_m = settings_.wheel.radius_m - (HubAtRest_W(wheel) - w.plane_W).dot(w.normal_W);
  input.lean = std::clamp((body_.q_WG * Eigen::Vector3d::UnitZ()).dot(w.normal_W), kLeastLean, 1.0);
  input.other_travel_m = wheels_[PartnerOf(wheel)].corner.travel_m();
  input.bottom_m = kBottom * settings_.wheel.radius_m;
  return input;
}

BicycleModel::Contact BicycleModel::ContactOf(std::size_t wheel, double steering_wheel_rad) const {
  const Wheel& w = wheels_[wheel];
  const Eigen::Vector3d hub = HubAtRest_W(wheel) + w.corner.travel_m() * (body_.q_WG * Eigen::Vector3d::UnitZ());
  Contact contact;
  contact.point_W = hub - (hub - w.plane_W).dot(w.normal_W) * w.normal_W;
  const double steer = SteerAngle(wheel, steering_wheel_rad);
  const Eigen::Vector3d heading = body_.q_WG * Eigen::Vector3d(std::cos(steer), std::sin(steer), 0.0);
  const Eigen::Vector3d along = heading - heading.dot(w.normal_W) * w.normal_W;
  const double size = along.norm();
  contact.along_W = size > 1e-3 ? Eigen::Vector3d(along / size) : heading;  // a wall straight ahead
  contact.across_W = w.normal_W.cross(contact.along_W);
  return contact;
}

TyreMotion BicycleModel::MotionOf(const Contacts& contacts, std::size_t wheel) const {
  const Eigen::Vector3d middle = 0.5 * (contacts[wheel].point_W + contacts[PartnerOf(wheel)].point_W);
  const Eigen::Vector3d v = body_.VelocityAt(middle);
  const double vx = v.dot(contacts[wheel].along_W);
  return {vx, vx - wheels_[wheel].spin_radps * settings_.wheel.rolling_radius_m, v.dot(contacts[wheel].across_W)};
}

void BicycleModel::Step(const Controls& controls, terrain::Ground& ground, double dt_s) {
  RODEIRA_ASSERT(dt_s > 0.0 && dt_s <= kMostStep_s);
  const Controls cut = Cut(controls);
  AskGround(ground);
  const int substeps = std::max(1, static_cast<int>(std::ceil(dt_s / kLongestSubstep_s - 1e-6)));
  for (int i = 0; i < substeps; ++i) Substep(cut, dt_s / substeps);
  push_ = {};
  Publish(cut, dt_s);
}

void BicycleModel::Substep(const Controls& controls, double dt_s) {
  std::array<CornerInput, kWheels> inputs;
  for (std::size_t i = 0; i < kWheels; ++i) inputs[i] = CornerInputOf(i);
  for (std::size_t i = 0; i < kWheels; ++i) {
    wheels_[i].corner.Step(settings_.suspension[AxleOf(i)], inputs[i], dt_s);
    contacts_[i] = ContactOf(i, controls.steering_wheel_rad);
  }
  for (std::size_t i = 0; i < kWheels; ++i) {
    Wheel& wheel = wheels_[i];
    contacts_[i].forces = wheel.tyre.Forces(tyres_[i], MotionOf(contacts_, i), wheel.corner.load_N(), wheel.friction);
  }
  torques_ = TurnWheels(controls, contacts_, dt_s);
  PushBody(contacts_, dt_s);
  for (std::size_t i = 0; i < kWheels; ++i) {
    Wheel& wheel = wheels_[i];
    wheel.tyre.Advance(tyres_[i], MotionOf(contacts_, i), wheel.corner.load_N(), wheel.friction, dt_s);
    wheel.spin_rad = geometry::WrapAngle(wheel.spin_rad + dt_s * wheel.spin_radps);
  }
  body_.Move(dt_s);
  KeepUpright(contacts_);
}

BicycleModel::WheelTorques BicycleModel::TurnWheels(const Controls& controls, const Contacts& contacts, double dt_s) {
  WheelTorques torques;
  const double radius = settings_.wheel.rolling_radius_m;
  std::array<double, kWheels> road{};
  std::array<double, kWheels> friction{};
  for (std::size_t i = 0; i < kWheels; ++i) {
    road[i] = -radius * contacts[i].forces.longitudinal_N;
    torques.brake_Nm[i] = BrakeTorque(settings_.brakes, i, controls.brake, controls.handbrake);
    friction[i] = torques.brake_Nm[i] + settings_.wheel.rolling_resistance * wheels_[i].corner.load_N() * radius;
  }
  const std::size_t driven = settings_.front_driven ? kFrontLeft : kRearLeft;
  const std::size_t free = settings_.front_driven ? kRearLeft : kFrontLeft;
  PowertrainInput input;
  input.wheel_inertia_kgm2 = settings_.wheel.inertia_kgm2;
  input.speed_mps = (body_.q_WG.conjugate() * body_.v_WG_W).x();
  input.inertia_torque_Nm = settings_.body.mass_kg * radius * forward_mps2_;
  for (std::size_t i = 0; i < 2; ++i) {
    input.wheel_radps[i] = wheels_[driven + i].spin_radps;
    input.road_torque_Nm[i] = road[driven + i];
    input.friction_torque_Nm[i] = friction[driven + i];
  }
  const DrivelineMotion& motion = powertrain_.Step(settings_.powertrain, controls, input, dt_s);
  for (std::size_t i = 0; i < 2; ++i) {
    wheels_[driven + i].spin_radps = motion.wheel_radps[i];
    torques.drive_Nm[driven + i] = motion.shaft_torque_Nm()[i];
    Wheel& rolling = wheels_[free + i];
    rolling.spin_radps = StepFreeWheel(rolling.spin_radps, settings_.wheel.inertia_kgm2, road[free + i], friction[free + i], dt_s);
  }
  return torques;
}

void BicycleModel::PushBody(const Contacts& contacts, double dt_s) {
  const BodySettings& body = settings_.body;
  const double speed = body_.v_WG_W.norm();
  drag_N_ = AirDrag(body.air_density_kgpm3, body.drag_area_m2, speed);
  Eigen::Vector3d force(0.0, 0.0, -body.mass_kg * kGravity_mps2);
  if (speed > 0.0) force -= drag_N_ / speed * body_.v_WG_W;
  force += push_.force_W;
  Eigen::Vector3d moment = push_.moment_WB_W + (p_WB_W() - body_.p_WG_W).cross(push_.force_W);
  for (std::size_t axle = 0; axle < 2; ++axle) {
    const Contact& left = contacts[2 * axle];
    const Contact& right = contacts[2 * axle + 1];
    Eigen::Vector3d tangential = Eigen::Vector3d::Zero();
    for (std::size_t i = 2 * axle; i < 2 * axle + 2; ++i) {
      const Eigen::Vector3d normal = wheels_[i].corner.load_N() * wheels_[i].normal_W;
      force += normal;
      moment += (contacts[i].point_W - body_.p_WG_W).cross(normal);
      tangential += contacts[i].forces.longitudinal_N * contacts[i].along_W + contacts[i].forces.lateral_N * contacts[i].across_W;
    }
    force += tangential;
    moment += (0.5 * (left.point_W + right.point_W) - body_.p_WG_W).cross(tangential);
  }
  const Eigen::Vector3d before = body_.v_WG_W;
  body_.Push(force, moment, body.mass_kg, {body.roll_inertia_kgm2, body.pitch_inertia_kgm2, body.yaw_inertia_kgm2}, dt_s);
  forward_mps2_ = (body_.v_WG_W - before).dot(body_.q_WG * Eigen::Vector3d::UnitX()) / dt_s;
}

// The plane under the car: parallel to both diagonals of the contact points, which for four points of a plane is theirs.
Eigen::Vector3d BicycleModel::RoadNormal(const Contacts& contacts) const {
  const Eigen::Vector3d rising = contacts[kFrontLeft].point_W - contacts[kRearRight].point_W;
  const Eigen::Vector3d falling = contacts[kFrontRight].point_W - contacts[kRearLeft].point_W;
  const Eigen::Vector3d cross = falling.cross(rising);
  const double size = cross.norm();
  if (!(size > 1e-3) || cross.z() < kSteepest * size) return Eigen::Vector3d::UnitZ();
  return cross / size;
}

// Bounds that a car meets only in flight, on walls and on cliffs, where a single-track model means nothing any more.
void BicycleModel::KeepUpright(const Contacts& contacts) {
  const Eigen::Vector3d normal = RoadNormal(contacts);
  const Eigen::Vector3d up = body_.q_WG * Eigen::Vector3d::UnitZ();
  const double tilt = std::acos(std::clamp(up.dot(normal), -1.0, 1.0));
  if (tilt > kMostTilt_rad) {
    const Eigen::Vector3d cross = up.cross(normal);
    const Eigen::Vector3d axis = cross.norm() > 1e-9 ? Eigen::Vector3d(cross.normalized()) : body_.q_WG * Eigen::Vector3d::UnitX();
    body_.q_WG = (Eigen::Quaterniond(Eigen::AngleAxisd(tilt - kMostTilt_rad, axis)) * body_.q_WG).normalized();
    const Eigen::Vector3d turning = body_.q_WG.conjugate() * axis;
    body_.w_WG_G -= std::min(0.0, body_.w_WG_G.dot(turning)) * turning;
  }
  const double turn = body_.w_WG_G.norm();
  if (turn > kMostTurn_radps) body_.w_WG_G *= kMostTurn_radps / turn;

  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Contact& contact : contacts) middle += 0.25 * contact.point_W;
  const double missing = kLeastHeight * settings_.body.cg_height_m - (body_.p_WG_W - middle).dot(normal);
  if (missing > 0.0) {
    body_.p_WG_W += missing * normal;
    body_.v_WG_W -= std::min(0.0, body_.v_WG_W.dot(normal)) * normal;
  }
}

}  // namespace rodeira::vehicle
