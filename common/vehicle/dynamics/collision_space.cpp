// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/collision_space.hpp"

#include <ode/ode.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/vehicle/dynamics/ode_library.hpp"

namespace rodeira::dynamics {
namespace {

void Put(dGeomID box, const Eigen::Vector3d& p, const Eigen::Quaterniond& q) {
  const dQuaternion turned = {q.w(), q.x(), q.y(), q.z()};
  dGeomSetPosition(box, p.x(), p.y(), p.z());
  dGeomSetQuaternion(box, turned);
}

Eigen::Vector3d Vector(const dVector3 v) { return {v[0], v[1], v[2]}; }

}  // namespace

struct CollisionSpace::Boxes {
  explicit Boxes(const Eigen::Vector3d& size)
      : car(dCreateBox(nullptr, size.x(), size.y(), size.z())), other(dCreateBox(nullptr, 1.0, 1.0, 1.0)) {}
  ~Boxes() {
    dGeomDestroy(car);
    dGeomDestroy(other);
  }
  Boxes(const Boxes&) = delete;
  Boxes& operator=(const Boxes&) = delete;
  dGeomID car;
  dGeomID other;
};

CollisionSpace::CollisionSpace(const VehicleDimensions& dimensions, const CollisionSettings& settings)
    : settings_(settings), box_(BoxOf(dimensions, settings)) {
  PrepareOde();
  boxes_ = std::make_unique<Boxes>(2.0 * box_.half_m);
}

CollisionSpace::~CollisionSpace() = default;
CollisionSpace::CollisionSpace(CollisionSpace&&) noexcept = default;

std::vector<Impact> CollisionSpace::Touch(const VehicleState& car, std::span<const Obstacle> obstacles) const {
  PrepareOde();
  std::vector<Impact> impacts;
  Put(boxes_->car, car.p_WB_W + car.q_WB * box_.centre_B, car.q_WB);
  const Eigen::Vector3d w_WB_W = car.q_WB * car.w_WB_B;
  for (const Obstacle& obstacle : obstacles) {
    if ((obstacle.centre_W - car.p_WB_W).norm() > box_.reach_m() + obstacle.half_m.norm()) continue;
    dGeomBoxSetLengths(boxes_->other, 2.0 * obstacle.half_m.x(), 2.0 * obstacle.half_m.y(), 2.0 * obstacle.half_m.z());
    Put(boxes_->other, obstacle.centre_W, obstacle.q_WO);
    std::array<dContactGeom, kMaxContacts> contacts;
    const int count = dCollide(boxes_->car, boxes_->other, kMaxContacts, contacts.data(), sizeof(dContactGeom));
    if (count == 0) continue;
    Impact impact;
    impact.id = obstacle.id;
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // of pressed contacts, weighted by their normal forces
    double pressed = 0.0;
    for (int i = 0; i < count; ++i) {
      const dContactGeom& contact = contacts[static_cast<std::size_t>(i)];
      const Eigen::Vector3d at = Vector(contact.pos), normal = Vector(contact.normal);
      const Eigen::Vector3d v =
          car.v_WB_W + w_WB_W.cross(at - car.p_WB_W) - obstacle.v_WO_W - obstacle.w_WO_W.cross(at - obstacle.centre_W);
      const Eigen::Vector3d force = ContactForce(settings_, normal, contact.depth, v, 1.0 / count);
      const double bears = force.dot(normal);
      impact.force_W += force;
      impact.moment_WB_W += (at - car.p_WB_W).cross(force);
      moment += bears * at;
      pressed += bears;
      if (contact.depth > impact.depth_m || i == 0) {
        impact.depth_m = contact.depth;
        impact.normal_W = normal;
        impact.closing_mps = -v.dot(normal);
        impact.point_W = at;
      }
    }
    if (pressed > 0.0) impact.point_W = moment / pressed;
    impacts.push_back(impact);
  }
  return impacts;
}

Wrench WrenchOf(std::span<const Impact> impacts) {
  Wrench sum;
  for (const Impact& impact : impacts) {
    sum.force_W += impact.force_W;
    sum.moment_WB_W += impact.moment_WB_W;
  }
  return sum;
}

}  // namespace rodeira::dynamics
