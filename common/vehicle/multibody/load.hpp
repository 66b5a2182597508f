// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "common/vehicle/multibody/block_ldlt.hpp"
#include "common/vehicle/multibody/body.hpp"
#include "common/vehicle/multibody/form.hpp"

namespace rodeira::multibody {

// Coordinates and velocities, three numbers an entity, at a time.
struct Motion {
  const double* q = nullptr;
  const double* qd = nullptr;
  double time_s = 0.0;

  // The entity's triple, and its velocity.
  Vector3d At(int entity) const { return Eigen::Map<const Vector3d>(q + 3 * entity); }
  Vector3d RateOf(int entity) const { return Eigen::Map<const Vector3d>(qd + 3 * entity); }
};

// Takes what loads do: generalised forces Q and, where the matrix is being made, their stiffness and damping.
class Sink {
 public:
  // `forces`: three numbers an entity, which are added to. `matrix`: null where it is not made. The factors weigh
  // stiffness and damping in it.
  Sink(double* forces, Block* matrix, double stiffness_factor, double damping_factor)
      : forces_(forces), matrix_(matrix), stiffness_factor_(stiffness_factor), damping_factor_(damping_factor) {}

  // Takes only what acts on this body at none of its points: at markers, and torques.
  static Sink OfBody(int body, double* forces) {
    Sink sink(forces, nullptr, 0.0, 0.0);
    sink.body_ = body;
    return sink;
  }

  // A force in the world's axes at a point or, for a direction's form, on that direction.
  void Push(const Form& form, const Vector3d& force) {
    if (body_ < 0) return multibody::Push(form, force, forces_);
    for (const Form::Part& part : form.parts) {
      if (part.body == body_) PushTerm(part.term, force, forces_);
    }
  }
  // A generalised force on a scalar: N on a distance, N m on an angle.
  void Push(int coordinate, double force) {
    if (body_ < 0) forces_[3 * coordinate] += force;
  }
  // A torque in the world's axes on the frame's body.
  void PushTorque(const Frame& frame, const Vector3d& torque_W, const double* q) {
    if (body_ < 0 || frame.body == body_) multibody::PushTorque(frame, torque_W, q, forces_);
  }
  bool wants_matrix() const { return matrix_ != nullptr; }
  // K += stiffness g gᵀ and C += damping g gᵀ, with a gradient for each of the load's entities that can move.
  void Stiffen(std::span<const OuterPair> pairs, const Triple* gradients, double stiffness, double damping) {
    AddOuter(pairs, gradients, stiffness_factor_ * stiffness + damping_factor_ * damping, matrix_);
  }

 private:
  double* forces_;
  Block* matrix_;
  int body_ = -1;  // all bodies
  double stiffness_factor_;
  double damping_factor_;
};

inline constexpr std::size_t kMaxLoadEntities = 24;  // that a load stiffens against each other

// Something that acts: a function of motion and time. It names the entities with coordinates that it stiffens against
// each other (a pattern that never changes), and gets their places in the matrix. Add may not allocate.
class Load {
 public:
  virtual ~Load() = default;
  // Entities, at most kMaxLoadEntities; empty: forces alone.
  virtual std::vector<int> Stiffens() const { return {}; }
  // Adds its forces and, if the sink wants the matrix, its stiffness and damping.
  virtual void Add(const Motion& motion, Sink& sink) const = 0;
  // Potential energy, where it has one.
  virtual double Energy(const Motion&) const { return 0.0; }
  // The force (or torque) that it passes, tension or along its direction positive: an output.
  virtual double Force(const Motion&) const { return 0.0; }

  // The same at zero velocity.
  virtual double ForceAtRest(const Motion& motion) const { return Force(motion); }

  // Called once: which of the entities can move, in order, and where their blocks stand.
  void Bind(std::vector<int> entities, std::vector<OuterPair> pairs, std::vector<Vector3d> free) {
    entities_ = std::move(entities);
    pairs_ = std::move(pairs);
    free_ = std::move(free);
  }

 protected:
  // Gradients of a form along n for the load's entities that can move.
  void AlongForm(const Form& form, const Vector3d& n, Triple* gradients) const;

  std::vector<int> entities_;
  std::vector<OuterPair> pairs_;
  std::vector<Vector3d> free_;  // 1 for a coordinate that can move, 0 for a fixed one
};

}  // namespace rodeira::multibody
