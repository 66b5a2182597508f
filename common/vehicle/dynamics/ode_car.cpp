// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/ode_car.hpp"

#include <ode/ode.h>

#include <algorithm>
#include <cmath>

#include "common/core/base/constants.hpp"
#include "common/vehicle/dynamics/ode_library.hpp"

namespace rodeira::dynamics {
namespace {

constexpr double kStopErp = 0.8;  // share of a steer angle's error that a step takes away
constexpr double kMaxSpeed_mps = 120.0;
constexpr double kMaxChassisRate_radps = 20.0;  // of the chassis
constexpr double kMaxSpin_radps = 1000.0;
constexpr double kSoft =
    1e-6;  // speed at which a contact gives way, m/s a newton: four contacts of a box are more than it needs

void Limit(Eigen::Vector3d& v, double most) {
  const double size = v.norm();
  if (size > most) v *= most / size;
}

}  // namespace

double PreloadOf(const OdeSettings& settings, std::size_t wheel) {
  return LoadAtRest(settings.car, wheel) - settings.wheel_mass_kg * base::kGravity_mps2;
}

struct OdeCar::World {
  explicit World(const OdeSettings& of);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;
  void Touch();

  OdeSettings settings;
  dWorldID world = nullptr;
  std::array<dBodyID, kWheels + 1> bodies{};
  std::array<dJointID, kWheels> hinges{};
  dGeomID box = nullptr;
  dGeomID ground = nullptr;
  dJointGroupID contacts = nullptr;
};

// Made at the origin as the car rests: the joints' own frames are then the same for every car of the file. ODE lets a
// joint's reaction act on the chassis where the wheel was when it was made, so that place is the middle of the travel.
OdeCar::World::World(const OdeSettings& of) : settings(of) {
  PrepareOde();
  world = dWorldCreate();
  contacts = dJointGroupCreate(0);
  dWorldSetGravity(world, 0.0, 0.0, -base::kGravity_mps2);
  dWorldSetCFM(world, 0.0);
  dWorldSetAutoDisableFlag(world, 0);
  const OdeChassis chassis = ChassisOf(settings);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i] = dBodyCreate(world);
    dMass mass;
    dMassSetZero(&mass);
    if (i == kChassis) {
      const Eigen::Vector3d& inertia = chassis.inertia_kgm2;
      dMassSetParameters(&mass, chassis.mass_kg, 0.0, 0.0, 0.0, inertia.x(), inertia.y(), inertia.z(), 0.0, 0.0, 0.0);
    } else {
      const double across = settings.wheel_across_kgm2;
      dMassSetParameters(&mass, settings.wheel_mass_kg, 0.0, 0.0, 0.0, across, settings.car.wheel.inertia_kgm2, across,
                         0.0, 0.0, 0.0);
      const Eigen::Vector3d at = HubAtRest_B(settings.car, i) - chassis.p_BG_B;
      dBodySetPosition(bodies[i], at.x(), at.y(), at.z());
    }
    dBodySetFiniteRotationMode(bodies[i], 1);  // turned by the whole angle of a step: wheels spin fast
    dBodySetMass(bodies[i], &mass);
  }
  const dReal up[4] = {0.0, 0.0, 1.0, 0.0};
  const dReal left[4] = {0.0, 1.0, 0.0, 0.0};
  for (std::size_t i = 0; i < kWheels; ++i) {
    hinges[i] = dJointCreateHinge2(world, nullptr);
    dJointAttach(hinges[i], bodies[kChassis], bodies[i]);
    const dReal* at = dBodyGetPosition(bodies[i]);
    dJointSetHinge2Anchor(hinges[i], at[0], at[1], at[2]);
    dJointSetHinge2Axes(hinges[i], up, left);
    dJointSetHinge2Param(hinges[i], dParamStopERP, kStopErp);
    dJointSetHinge2Param(hinges[i], dParamStopCFM, 0.0);
    dJointSetHinge2Param(hinges[i], dParamFMax2, dInfinity);
    dJointSetHinge2Param(hinges[i], dParamCFM2, 0.0);
  }
  const VehicleDimensions& d = settings.car.dimensions;
  box = dCreateBox(nullptr, d.front_m + d.rear_m, d.width_m, d.height_m - settings.clearance_m);
  dGeomSetBody(box, bodies[kChassis]);
  dGeomSetOffsetPosition(box, 0.5 * (d.front_m - d.rear_m) - chassis.p_BG_B.x(), 0.0,
                         0.5 * (d.height_m + settings.clearance_m) - chassis.p_BG_B.z());
  ground = dCreatePlane(nullptr, 0.0, 0.0, 1.0, -1e9);
}

OdeCar::World::~World() {
  dJointGroupDestroy(contacts);
  dGeomDestroy(box);
  dGeomDestroy(ground);
  dWorldDestroy(world);
}

// Contact joints for the body's box on the ground, for one step.
void OdeCar::World::Touch() {
  std::array<dContactGeom, kMaxContacts> touching;
  const int count = dCollide(box, ground, kMaxContacts, touching.data(), sizeof(dContactGeom));
  for (int i = 0; i < count; ++i) {
    dContact contact{};
    contact.surface.mode = dContactApprox1 | dContactSoftERP | dContactSoftCFM | dContactSlip1 | dContactSlip2;
    contact.surface.mu = settings.body_friction;
    contact.surface.soft_erp = 0.2;
    contact.surface.soft_cfm = kSoft;
    contact.surface.slip1 = contact.surface.slip2 = kSoft;
    contact.geom = touching[static_cast<std::size_t>(i)];
    dJointAttach(dJointCreateContact(world, contacts, &contact), dGeomGetBody(contact.geom.g1),
                 dGeomGetBody(contact.geom.g2));
  }
}

OdeCar::OdeCar(const OdeSettings& settings) : world_(std::make_unique<World>(settings)) { Read(); }
OdeCar::~OdeCar() = default;
OdeCar::OdeCar(OdeCar&&) noexcept = default;

void OdeCar::Give(const Bodies& bodies) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const dBodyID id = world_->bodies[i];
    Eigen::Vector3d v = bodies[i].v_WG_W;
    Eigen::Vector3d w = bodies[i].w_WG_W();
    Limit(v, kMaxSpeed_mps);
    Limit(w, i == kChassis ? kMaxChassisRate_radps : kMaxSpin_radps);
    const Eigen::Vector3d& p = bodies[i].p_WG_W;
    const Eigen::Quaterniond& q = bodies[i].q_WG;
    const dQuaternion turned = {q.w(), q.x(), q.y(), q.z()};
    dBodySetPosition(id, p.x(), p.y(), p.z());
    dBodySetQuaternion(id, turned);
    dBodySetLinearVel(id, v.x(), v.y(), v.z());
    dBodySetAngularVel(id, w.x(), w.y(), w.z());
    dBodySetForce(id, 0.0, 0.0, 0.0);
    dBodySetTorque(id, 0.0, 0.0, 0.0);
  }
  Read();
}

void OdeCar::Read() {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const dReal* p = dBodyGetPosition(world_->bodies[i]);
    const dReal* q = dBodyGetQuaternion(world_->bodies[i]);
    const dReal* v = dBodyGetLinearVel(world_->bodies[i]);
    const dReal* w = dBodyGetAngularVel(world_->bodies[i]);
    bodies_[i].p_WG_W = {p[0], p[1], p[2]};
    bodies_[i].q_WG = {q[0], q[1], q[2], q[3]};
    bodies_[i].v_WG_W = {v[0], v[1], v[2]};
    bodies_[i].w_WG_G = bodies_[i].q_WG.conjugate() * Eigen::Vector3d(w[0], w[1], w[2]);
  }
}

void OdeCar::Push(std::size_t body, const Eigen::Vector3d& f, const Eigen::Vector3d& at) {
  dBodyAddForceAtPos(world_->bodies[body], f.x(), f.y(), f.z(), at.x(), at.y(), at.z());
}

void OdeCar::Twist(std::size_t body, const Eigen::Vector3d& t) {
  dBodyAddTorque(world_->bodies[body], t.x(), t.y(), t.z());
}

void OdeCar::Strut(std::size_t wheel, double force_N) {
  const Eigen::Vector3d force = force_N * (bodies_[kChassis].q_WG * Eigen::Vector3d::UnitZ());
  Push(kChassis, force, bodies_[wheel].p_WG_W);
  Push(wheel, -force, bodies_[wheel].p_WG_W);
}

// ODE counts both angles of a hinge-2 the other way round: of the chassis against the wheel.
void OdeCar::TurnWheel(std::size_t wheel, double steer_rad, double spin_radps) {
  const dJointID hinge = world_->hinges[wheel];
  dJointSetHinge2Param(hinge, dParamLoStop, -steer_rad);
  dJointSetHinge2Param(hinge, dParamHiStop, -steer_rad);
  dJointSetHinge2Param(hinge, dParamLoStop, -steer_rad);  // again: a stop beyond the other one is refused
  dJointSetHinge2Param(hinge, dParamVel2, -spin_radps);
}

void OdeCar::SetGround(const Eigen::Vector3d& point_W, const Eigen::Vector3d& normal_W) {
  dGeomPlaneSetParams(world_->ground, normal_W.x(), normal_W.y(), normal_W.z(), normal_W.dot(point_W));
}

// Spring k and damper c of the hinges in ODE's terms: ERP = h k / (h k + c), CFM = 1 / (h k + c).
void OdeCar::Step(double dt_s) {
  for (std::size_t i = 0; i < kWheels; ++i) {
    const SuspensionSettings& suspension = world_->settings.car.suspension[i / 2];
    const double both = dt_s * suspension.spring_Npm + suspension.damper_Nspm;
    dJointSetHinge2Param(world_->hinges[i], dParamSuspensionERP, dt_s * suspension.spring_Npm / both);
    dJointSetHinge2Param(world_->hinges[i], dParamSuspensionCFM, 1.0 / both);
  }
  world_->Touch();
  (void)dWorldStep(world_->world, dt_s);
  dJointGroupEmpty(world_->contacts);
  Read();
}

}  // namespace rodeira::dynamics
