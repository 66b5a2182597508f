// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "common/vehicle/multibody/block_ldlt.hpp"
#include "common/vehicle/multibody/form.hpp"
#include "common/vehicle/multibody/law.hpp"

namespace rodeira::multibody {

// The scalar constraints between directions u, v, w (forms) and a coordinate s (an angle or a distance):
enum class RowKind {
  kDot,     // (v·w - value) scale
  kSquare,  // (v·v - s²) scale                      s is the length of v
  kSlide,   // (v·w) scale - s                       s is the way of v along w
  kTriple,  // ((u×v)·w - value) scale               value 0: coplanar
  kAngle,   // ((u·w) cos s - (u·v) sin s) scale     s is the angle from v to u, towards w
  kSum,     // sum of given gradients - value - law(t)
};

// Scales are such that the row is in metres or radians; its multiplier is then the force or torque that it takes.
struct RowDrawing {
  std::string name;
  std::string place;  // file:line
  RowKind kind = RowKind::kDot;
  Form u, v, w;
  int coordinate = -1;  // the entity that is s
  double value = 0.0;
  double scale = 1.0;
  bool keeps_length = false;                  // kDot: v and w are one direction, its square `value`
  std::vector<std::pair<int, Vector3d>> sum;  // kSum: entity and gradient
  std::vector<Form::Part> sum_parts;          // kSum: of gradients the bodies' parts, along `sum_axis`
  Vector3d sum_axis = Vector3d::Zero();
  Law law;  // kSum: a driven coordinate
};

// One row compiled: values and gradients without an allocation.
class Row {
 public:
  // `free`: whether a coordinate of an entity may move (three flags an entity).
  Row(const RowDrawing& drawing, const std::vector<double>& free);

  // Entities that can move, in the order of the gradients.
  const std::vector<int>& entities() const { return entities_; }
  // The row's value; gradients with respect to the entities.
  double Evaluate(const double* q, double time_s, Triple* gradients) const;
  // d(gradient)/dt · qd + d(∂/∂t)/dt: what the second derivative has besides gradient · qdd.
  double Bias(const double* q, const double* qd, double time_s) const;
  // ∂/∂t at given coordinates.
  double TimeRate(double time_s) const { return kind_ == RowKind::kSum ? -law_.Rate(time_s) : 0.0; }

  const std::string& name() const { return name_; }
  const std::string& place() const { return place_; }

 private:
  struct Local {  // how an entity enters u, v and w
    int entity = 0;
    std::array<double, 3> a{};
    std::array<double, 3> b{};
    Vector3d sum = Vector3d::Zero();
    Vector3d free = Vector3d::Ones();
  };
  using Directions = std::array<Vector3d, 3>;
  static constexpr std::size_t kV = 1, kW = 2;  // of u, v, w

  Directions DirectionsAt(const double* q) const;
  Vector3d Way(const double* q) const;
  void WayGradients(const Vector3d& by, double by_coordinate, Triple* gradients) const;
  void Gradients(const Directions& by, double by_coordinate, Triple* gradients) const;

  std::string name_;
  std::string place_;
  RowKind kind_;
  int coordinate_;
  double value_;
  double scale_;
  Law law_;
  bool one_way_ = false;        // v and w are the same, or w is not there
  bool turned_ = false;         // some b is not 0
  std::size_t first_form_ = 0;  // 1 without u
  std::vector<Local> locals_;   // free ones first
  std::vector<int> entities_;
};

}  // namespace rodeira::multibody
