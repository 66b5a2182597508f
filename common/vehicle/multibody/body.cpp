// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/multibody/body.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

namespace rodeira::multibody {
namespace {

constexpr double kIndependent = 0.05;  // part of a direction that the others do not have, to count as independent
constexpr double kTiny = 1e-9;

Vector3d At(const std::vector<double>& q, int entity) { return Eigen::Map<const Vector3d>(q.data() + 3 * entity); }

// A direction of the body: a unit vector or the way from its first point to another.
struct Direction {
  Form form;
  Vector3d drawn;
  std::string name;
  int vector = -1;  // a vector entity keeps its own length
};

std::vector<Direction> DirectionsOf(const BodyDrawing& body, const std::vector<double>& at,
                                    const std::vector<std::string>& names) {
  std::vector<Direction> directions;
  for (const int vector : body.vectors) {
    directions.push_back({Single(vector), At(at, vector), names[static_cast<std::size_t>(vector)], vector});
  }
  for (std::size_t i = 1; i < body.points.size(); ++i) {
    const Form way = Sum(Single(body.points[i]), Single(body.points[0]), -1.0);
    directions.push_back(
        {way, At(at, body.points[i]) - At(at, body.points[0]),
         names[static_cast<std::size_t>(body.points[0])] + "-" + names[static_cast<std::size_t>(body.points[i])], -1});
  }
  return directions;
}

// The first directions, vectors before points and in the order of the file, that are well independent.
std::vector<std::size_t> Basis(const std::vector<Direction>& directions, std::size_t wanted) {
  std::vector<std::size_t> chosen;
  std::vector<Vector3d> normal;
  for (std::size_t i = 0; i < directions.size() && chosen.size() < wanted; ++i) {
    const double size = directions[i].drawn.norm();
    Vector3d rest = directions[i].drawn;
    for (const Vector3d& n : normal) rest -= rest.dot(n) * n;
    if (!(rest.norm() > kIndependent * size) || size < kTiny) continue;
    chosen.push_back(i);
    normal.push_back(rest.normalized());
  }
  return chosen;
}

RowDrawing KeepDot(const BodyDrawing& body, const Direction& a, const Direction& b) {
  RowDrawing row;
  row.name = &a == &b ? fmt::format("{} (length {})", body.name, a.name)
                      : fmt::format("{} (angle {} to {})", body.name, a.name, b.name);
  row.place = body.place;
  row.kind = RowKind::kDot;
  row.v = a.form;
  row.w = b.form;
  row.value = a.drawn.dot(b.drawn);
  row.keeps_length = &a == &b;
  row.scale = &a == &b ? 0.5 / a.drawn.norm() : 1.0 / std::sqrt(a.drawn.norm() * b.drawn.norm());
  return row;
}

// Mass distribution about the frame's origin: J = ∫ x xᵀ dm with x = (1, ξ, η, ζ).
Eigen::Matrix4d PseudoInertia(const BodyDrawing& body, const Vector3d& origin) {
  const Vector3d c = body.centre_m - origin;
  Eigen::Matrix4d j = Eigen::Matrix4d::Zero();
  j(0, 0) = body.mass_kg;
  j.block<3, 1>(1, 0) = body.mass_kg * c;
  j.block<1, 3>(0, 1) = body.mass_kg * c.transpose();
  j.block<3, 3>(1, 1) = 0.5 * body.inertia_kgm2.trace() * Eigen::Matrix3d::Identity() - body.inertia_kgm2 +
                        body.mass_kg * c * c.transpose();
  return j;
}

// Mass terms Σ J_ab Aᵀ B over the frame's origin and axes.
std::vector<MassTerm> MassTerms(const Frame& frame, const Eigen::Matrix4d& j) {
  std::vector<MassTerm> terms;
  const std::array<const Form*, 4> forms = {&frame.origin, &frame.axes[0], &frame.axes[1], &frame.axes[2]};
  const auto add = [&terms](int row, int column, double a, double b) {
    if (row < column) return;  // symmetric
    for (MassTerm& known : terms) {
      if (known.row != row || known.column != column) continue;
      known.a += a;
      known.b += b;
      return;
    }
    terms.push_back({row, column, a, b});
  };
  for (int k = 0; k < 4; ++k) {
    for (int l = 0; l < 4; ++l) {
      if (j(k, l) == 0.0) continue;
      for (const Term& p : forms[static_cast<std::size_t>(k)]->terms) {
        for (const Term& r : forms[static_cast<std::size_t>(l)]->terms) {
          // (a + b z×)ᵀ (c + d z×) = (a c + b d) + (a d - b c) z×, in the plane where there is a b or d.
          add(p.entity, r.entity, j(k, l) * (p.a * r.a + p.b * r.b), j(k, l) * (p.a * r.b - p.b * r.a));
        }
      }
    }
  }
  return terms;
}

base::Error Refuse(const BodyDrawing& body, const std::string& what) {
  return base::WrongInput("mechanism.wrong_body", fmt::format("body '{}' {}", body.name, what), body.place);
}

base::Status CheckMass(const BodyDrawing& body, const Vector3d& line_origin, const Vector3d& line,
                       const Vector3d& normal) {
  if (body.kind == BodyKind::kRod || body.kind == BodyKind::kParticle) {
    const Vector3d off = body.centre_m - line_origin;
    const Vector3d beside = line.isZero() ? off : Vector3d(off - off.dot(line) / line.squaredNorm() * line);
    if (beside.norm() > 1e-9 * (1.0 + off.norm()))
      return Refuse(body, "has its centre beside its points; a general body can have that");
    return {};
  }
  if (body.kind == BodyKind::kPlanar) return {};
  if (body.kind == BodyKind::kPlate &&
      std::fabs((body.centre_m - line_origin).dot(normal)) > 1e-9 * (1.0 + (body.centre_m - line_origin).norm())) {
    return Refuse(body, "has its centre beside the plane of its points; a general body can have that");
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
      0.5 * body.inertia_kgm2.trace() * Eigen::Matrix3d::Identity() - body.inertia_kgm2);
  if (solver.eigenvalues().minCoeff() < -1e-9 * (1e-12 + body.inertia_kgm2.norm())) {
    return Refuse(
        body,
        "has moments of inertia that no mass has: each of the principal ones must be at most the sum of the other two");
  }
  return {};
}

// Coefficients of the frame's axes from a basis of directions: axes = B B0⁻¹.
std::array<Form, 3> AxesFrom(const std::array<Form, 3>& basis, const Eigen::Matrix3d& drawn) {
  const Eigen::Matrix3d inverse = drawn.inverse();
  std::array<Form, 3> axes;
  for (int axis = 0; axis < 3; ++axis) {
    for (int k = 0; k < 3; ++k)
      axes[static_cast<std::size_t>(axis)] =
          Sum(axes[static_cast<std::size_t>(axis)], basis[static_cast<std::size_t>(k)], inverse(k, axis));
  }
  return axes;
}

// A direction as a combination of the basis: what it needs to be tied to it.
Tie TieTo(const BodyDrawing& body, const Frame& frame, const Direction& direction) {
  const Form combined = frame.DirectionOf(direction.drawn);
  return {fmt::format("{} ({})", body.name, direction.name), body.place, Sum(direction.form, combined, -1.0).terms,
          direction.vector};
}

}  // namespace

Form Frame::DirectionOf(const Vector3d& drawn) const {
  Form form;
  for (int c = 0; c < 3; ++c) {
    if (drawn[c] != 0.0) form = Sum(form, axes[static_cast<std::size_t>(c)], drawn[c]);
  }
  std::erase_if(form.terms, [&drawn](const Term& term) {
    return std::fabs(term.a) + std::fabs(term.b) < 1e-15 * (1.0 + drawn.norm());
  });
  return form;
}

Form Frame::PointAt(const Vector3d& drawn) const {
  Form point = Sum(origin, DirectionOf(drawn - drawn_origin));
  return body < 0 ? point : OfBody(std::move(point), body);
}

Eigen::Matrix3d Frame::Rotation(const double* q) const {
  Eigen::Matrix3d rotation;
  for (int c = 0; c < 3; ++c) rotation.col(c) = Evaluate(axes[static_cast<std::size_t>(c)], q);
  return rotation;
}

void PushTorque(const Frame& frame, const Vector3d& torque_W, const double* q, double* out) {
  for (const Form& axis : frame.axes) Push(axis, 0.5 * torque_W.cross(Evaluate(axis, q)), out);
}

base::Result<BodyParts> MakeBody(const BodyDrawing& body, const std::vector<double>& at,
                                 const std::vector<std::string>& names) {
  BodyParts parts;
  parts.mass_kg = body.mass_kg;
  parts.turns = body.kind == BodyKind::kGeneral || body.kind == BodyKind::kPlanar;
  parts.entities = body.points;
  parts.entities.insert(parts.entities.end(), body.vectors.begin(), body.vectors.end());
  const std::vector<Direction> directions = DirectionsOf(body, at, names);
  const Vector3d origin = At(at, body.points.front());
  parts.frame.drawn_origin = origin;
  parts.frame.origin = Single(body.points.front());
  if (body.kind == BodyKind::kParticle) {
    if (const auto status = CheckMass(body, origin, Vector3d::Zero(), Vector3d::Zero()); !status) return status.error();
    parts.mass = {{body.points.front(), body.points.front(), body.mass_kg, 0.0}};
    parts.centre = parts.frame.origin;
    return parts;
  }
  const std::size_t wanted = body.kind == BodyKind::kGeneral ? 3 : body.kind == BodyKind::kPlate ? 2 : 1;
  const std::vector<std::size_t> basis = Basis(directions, wanted);
  if (basis.size() < wanted) {
    if (wanted == 2) return Refuse(body, "is a plate, but its points lie on a line");
    return Refuse(
        body, wanted == 3 ? "has no three independent directions; it needs one more point or vector that does not lie "
                            "in the plane (or on the line) of the others"
                          : "needs two points that do not coincide");
  }
  Vector3d normal = Vector3d::Zero();
  if (body.kind == BodyKind::kPlate) {
    Eigen::Matrix<double, 3, 2> drawn;
    drawn << directions[basis[0]].drawn, directions[basis[1]].drawn;
    normal = drawn.col(0).cross(drawn.col(1)).normalized();
    const Eigen::Matrix<double, 2, 3> inverse = (drawn.transpose() * drawn).inverse() * drawn.transpose();
    for (int axis = 0; axis < 3; ++axis) {
      for (int k = 0; k < 2; ++k)
        parts.frame.axes[static_cast<std::size_t>(axis)] =
            Sum(parts.frame.axes[static_cast<std::size_t>(axis)], directions[basis[static_cast<std::size_t>(k)]].form,
                inverse(k, axis));
    }
  } else if (body.kind == BodyKind::kGeneral) {
    Eigen::Matrix3d drawn;
    for (int k = 0; k < 3; ++k) drawn.col(k) = directions[basis[static_cast<std::size_t>(k)]].drawn;
    parts.frame.axes =
        AxesFrom({directions[basis[0]].form, directions[basis[1]].form, directions[basis[2]].form}, drawn);
  } else {
    const Direction& first = directions[basis[0]];
    const double size2 = first.drawn.squaredNorm();
    // x axis: the first direction turned back and made of unit length.
    const Form turned = TurnedAboutZ(first.form);
    const double cosine = first.drawn.x() / size2, sine = first.drawn.y() / size2;
    if (body.kind == BodyKind::kPlanar) {
      Form x;
      x = Sum(Sum(x, first.form, cosine), turned, -sine);
      parts.frame.axes[0] = x;
      parts.frame.axes[1] = TurnedAboutZ(x);
    } else {  // rod: only the way along it means anything
      for (int c = 0; c < 3; ++c)
        parts.frame.axes[static_cast<std::size_t>(c)] = Sum(Form{}, first.form, first.drawn[c] / size2);
    }
  }
  const Vector3d line = directions[basis[0]].drawn;
  if (const auto status = CheckMass(body, origin, line, normal); !status) return status.error();
  BodyDrawing weighed = body;
  if (body.kind == BodyKind::kPlanar) weighed.inertia_kgm2 = Vector3d(0.0, 0.0, body.inertia_kgm2(2, 2)).asDiagonal();
  Eigen::Matrix4d j = PseudoInertia(weighed, origin);
  if (body.kind == BodyKind::kPlanar) {
    const double share = 0.5 * (j(1, 1) + j(2, 2));  // only their sum matters: both axes turn together
    j(1, 1) = j(2, 2) = share;
    j(1, 2) = j(2, 1) = 0.0;
    j.row(3).setZero();
    j.col(3).setZero();
  }
  parts.mass = MassTerms(parts.frame, j);
  parts.centre = parts.frame.PointAt(body.centre_m);
  for (std::size_t a = 0; a < basis.size(); ++a) {
    for (std::size_t b = 0; b <= a; ++b) {
      if (a == b && directions[basis[a]].vector >= 0) continue;  // the vector keeps its own length
      parts.rows.push_back(KeepDot(body, directions[basis[a]], directions[basis[b]]));
    }
  }
  for (std::size_t i = 0; i < directions.size(); ++i) {
    if (body.kind == BodyKind::kPlate &&
        std::fabs(directions[i].drawn.dot(normal)) > 1e-9 * directions[i].drawn.norm()) {
      return Refuse(body, "is a plate, but its points do not lie in one plane");
    }
    if (std::find(basis.begin(), basis.end(), i) == basis.end())
      parts.ties.push_back(TieTo(body, parts.frame, directions[i]));
  }
  return parts;
}

}  // namespace rodeira::multibody
