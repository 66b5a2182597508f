// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "common/core/base/constants.hpp"
#include "common/vehicle/multibody/body.hpp"
#include "common/vehicle/multibody/load.hpp"
#include "common/vehicle/multibody/row.hpp"

namespace rodeira::multibody {

enum class EntityKind {
  kPoint,
  kVector,    // of unit length
  kAngle,     // its first number is the angle in rad; it does not wrap
  kDistance,  // its first number is a length or way in m
};

// A triple of coordinates.
struct EntityDrawing {
  std::string name;
  std::string place;  // file:line
  EntityKind kind = EntityKind::kPoint;
  Vector3d at = Vector3d::Zero();  // as drawn
  std::array<bool, 3> fixed{};     // coordinates that never move
  double inertia = 0.0;            // a coordinate's own: kg m² of an angle, kg of a distance

  bool is_scalar() const { return kind == EntityKind::kAngle || kind == EntityKind::kDistance; }
};

// A velocity that the initial motion shall have.
struct GivenVelocity {
  int entity = 0;
  int component = 0;
  double rate = 0.0;
  std::string place;
};

// A force element by its name in the file.
struct NamedLoad {
  std::string name;
  std::shared_ptr<Load> load;
};

// A mechanism before it is compiled. Entities are counted from 0 in the order of `entities`.
struct Drawing {
  std::string name;
  std::string place;
  Vector3d gravity_mps2{0.0, 0.0, -base::kGravity_mps2};
  std::vector<EntityDrawing> entities;
  std::vector<std::string> body_names;
  std::vector<BodyParts> bodies;
  std::vector<RowDrawing> rows;  // joints and coordinates beyond those of vectors and bodies
  std::vector<NamedLoad> loads;
  std::vector<GivenVelocity> velocities;
  bool redundant = false;  // constraints that say the same are allowed (closed loops such as Bricard's)
};

}  // namespace rodeira::multibody
