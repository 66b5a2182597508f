// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/vehicle/multibody/form.hpp"
#include "common/vehicle/multibody/row.hpp"

namespace rodeira::multibody {

enum class BodyKind {
  kGeneral,   // a point and three independent directions, from points and unit vectors
  kPlate,     // all of it in the plane of its points: a point and two independent directions
  kPlanar,    // two or more points in a plane z = constant
  kRod,       // thin and uniform between two points (or with its mass anywhere on their line)
  kParticle,  // all of its mass in one point
};

// A rigid body as it is drawn: its entities and its mass in the world's axes at the mechanism's drawn position.
struct BodyDrawing {
  std::string name;
  std::string place;
  BodyKind kind = BodyKind::kGeneral;
  std::vector<int> points;
  std::vector<int> vectors;
  double mass_kg = 0.0;
  Vector3d centre_m = Vector3d::Zero();
  Eigen::Matrix3d inertia_kgm2 = Eigen::Matrix3d::Zero();  // about the centre; planar: the (z, z) element counts
};

// The body's frame as forms of the coordinates. It lies where the world's axes are while the mechanism stands as drawn,
// with its origin in the body's first point.
struct Frame {
  Vector3d drawn_origin = Vector3d::Zero();
  Form origin;
  std::array<Form, 3> axes;
  int body = -1;  // of the drawing, once it has the body

  Form PointAt(const Vector3d& drawn) const;        // the body's material point that was drawn there, as its part
  Form DirectionOf(const Vector3d& drawn) const;    // the body's direction that was drawn so
  Eigen::Matrix3d Rotation(const double* q) const;  // from drawn to now
};

// A term of the mass matrix between two entities: a I + b (z ×).
struct MassTerm {
  int row = 0;
  int column = 0;
  double a = 0.0;
  double b = 0.0;
};

// Constant relation between entities of one body: Σ (a + b z×) e = 0, three components.
struct Tie {
  std::string name;
  std::string place;
  std::vector<Term> terms;
  int vector = -1;  // the vector that is tied: its length follows
};

// What a body means for the equations.
struct BodyParts {
  Frame frame;
  std::vector<MassTerm> mass;  // row >= column entity
  Form centre;                 // where its weight acts
  double mass_kg = 0.0;
  std::vector<int> entities;
  bool turns = false;            // has a frame that torques can act on
  std::vector<RowDrawing> rows;  // keep its directions' lengths and angles
  std::vector<Tie> ties;         // points and vectors beyond the four that make its frame
};

// `at`: the drawn coordinates. Refused where the entities do not make a frame or the mass is no mass.
base::Result<BodyParts> MakeBody(const BodyDrawing& drawing, const std::vector<double>& at,
                                 const std::vector<std::string>& names);

// Q of a torque (in the world's axes) on the body: every axis e takes ½ torque × e.
void PushTorque(const Frame& frame, const Vector3d& torque_W, const double* q, double* out);

}  // namespace rodeira::multibody
