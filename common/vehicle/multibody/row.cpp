// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/multibody/row.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::multibody {

Row::Row(const RowDrawing& drawing, const std::vector<double>& free)
    : name_(drawing.name),
      place_(drawing.place),
      kind_(drawing.kind),
      coordinate_(drawing.coordinate),
      value_(drawing.value),
      scale_(drawing.scale),
      law_(drawing.law) {
  const auto local = [this](int entity) -> Local& {
    for (Local& known : locals_) {
      if (known.entity == entity) return known;
    }
    locals_.push_back({.entity = entity});
    return locals_.back();
  };
  const std::array<const Form*, 3> forms = {&drawing.u, &drawing.v, &drawing.w};
  for (std::size_t f = 0; f < forms.size(); ++f) {
    for (const Term& term : forms[f]->terms) {
      local(term.entity).a[f] += term.a;
      local(term.entity).b[f] += term.b;
    }
  }
  for (const auto& [entity, gradient] : drawing.sum) local(entity).sum += gradient;
  if (coordinate_ >= 0) local(coordinate_);
  for (Local& each : locals_) {
    for (int c = 0; c < 3; ++c) each.free[c] = free[static_cast<std::size_t>(3 * each.entity + c)];
  }
  std::stable_partition(locals_.begin(), locals_.end(), [](const Local& each) { return !each.free.isZero(); });
  bool same = kind_ == RowKind::kDot;
  for (const Local& each : locals_) {
    if (!each.free.isZero()) entities_.push_back(each.entity);
    same = same && each.a[kV] == each.a[kW] && each.b[kV] == each.b[kW];
    turned_ = turned_ || each.b != std::array<double, 3>{};
  }
  one_way_ = same || kind_ == RowKind::kSquare;
  first_form_ = drawing.u.terms.empty() ? kV : 0;
}

Row::Directions Row::DirectionsAt(const double* q) const {
  Directions d = {Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};
  for (const Local& local : locals_) {
    const Vector3d e(q[3 * local.entity], q[3 * local.entity + 1], q[3 * local.entity + 2]);
    for (std::size_t f = first_form_; f < 3; ++f) d[f] += local.a[f] * e;
    if (!turned_) continue;
    for (std::size_t f = first_form_; f < 3; ++f) d[f] += local.b[f] * AboutZ(e);
  }
  return d;
}

// The direction of a row with a single one.
Vector3d Row::Way(const double* q) const {
  Vector3d way = Vector3d::Zero();
  for (const Local& local : locals_) {
    const Vector3d e(q[3 * local.entity], q[3 * local.entity + 1], q[3 * local.entity + 2]);
    way += local.a[kV] * e;
    if (turned_) way += local.b[kV] * AboutZ(e);
  }
  return way;
}

void Row::WayGradients(const Vector3d& by, double by_coordinate, Triple* gradients) const {
  for (std::size_t k = 0; k < entities_.size(); ++k) {
    const Local& local = locals_[k];
    Vector3d g = local.a[kV] * by;
    if (turned_) g -= local.b[kV] * AboutZ(by);
    if (local.entity == coordinate_) g.x() += by_coordinate;
    gradients[k].v = {g.x() * local.free.x(), g.y() * local.free.y(), g.z() * local.free.z(), 0.0};
  }
}

void Row::Gradients(const Directions& by, double by_coordinate, Triple* gradients) const {
  for (std::size_t k = 0; k < entities_.size(); ++k) {
    const Local& local = locals_[k];
    Vector3d g = local.sum;
    for (std::size_t f = first_form_; f < 3; ++f) g += local.a[f] * by[f];
    if (turned_) {
      for (std::size_t f = first_form_; f < 3; ++f) g -= local.b[f] * AboutZ(by[f]);
    }
    if (local.entity == coordinate_) g.x() += by_coordinate;
    gradients[k].v = {g.x() * local.free.x(), g.y() * local.free.y(), g.z() * local.free.z(), 0.0};
  }
}

double Row::Evaluate(const double* q, double time_s, Triple* gradients) const {
  const Vector3d zero = Vector3d::Zero();
  const double s = coordinate_ >= 0 ? q[3 * coordinate_] : 0.0;
  if (kind_ == RowKind::kSum) {
    double value = -value_ - law_.Value(time_s);
    for (const Local& local : locals_) value += local.sum.dot(Eigen::Map<const Vector3d>(q + 3 * local.entity));
    Gradients({zero, zero, zero}, 0.0, gradients);
    return value;
  }
  if (one_way_ && !turned_ && coordinate_ < 0) {  // a length, the most frequent of all: the same by fewer steps
    Vector3d v = Vector3d::Zero();
    for (const Local& local : locals_) {
      const double* e = q + 3 * local.entity;
      const double a = local.a[kV];
      v += Vector3d(a * e[0], a * e[1], a * e[2]);
    }
    const Vector3d by = 2.0 * scale_ * v;
    const Local* local = locals_.data();
    for (const Local* last = local + entities_.size(); local != last; ++local, ++gradients) {
      const double a = local->a[kV];
      gradients->v = {a * by.x() * local->free.x(), a * by.y() * local->free.y(), a * by.z() * local->free.z(), 0.0};
    }
    return scale_ * (v.squaredNorm() - value_);
  }
  if (one_way_) {
    const Vector3d v = Way(q);
    WayGradients(2.0 * scale_ * v, -2.0 * scale_ * s, gradients);
    return scale_ * (v.squaredNorm() - (kind_ == RowKind::kSquare ? s * s : value_));
  }
  const auto [u, v, w] = DirectionsAt(q);
  switch (kind_) {
    case RowKind::kDot:
      Gradients({zero, scale_ * w, scale_ * v}, 0.0, gradients);
      return scale_ * (v.dot(w) - value_);
    case RowKind::kSlide:
      Gradients({zero, scale_ * w, scale_ * v}, -1.0, gradients);
      return scale_ * v.dot(w) - s;
    case RowKind::kTriple:
      Gradients({scale_ * v.cross(w), scale_ * w.cross(u), scale_ * u.cross(v)}, 0.0, gradients);
      return scale_ * (u.cross(v).dot(w) - value_);
    default:
      break;
  }
  const double sine = std::sin(s), cosine = std::cos(s);
  const double uw = u.dot(w), uv = u.dot(v);
  Gradients({scale_ * (cosine * w - sine * v), -scale_ * sine * u, scale_ * cosine * u},
            -scale_ * (uw * sine + uv * cosine), gradients);
  return scale_ * (uw * cosine - uv * sine);
}

double Row::Bias(const double* q, const double* qd, double time_s) const {
  if (kind_ == RowKind::kSum) return -law_.Acceleration(time_s);
  if (one_way_) {
    const double sd = kind_ == RowKind::kSquare ? qd[3 * coordinate_] : 0.0;
    return 2.0 * scale_ * (Way(qd).squaredNorm() - sd * sd);
  }
  const auto [ud, vd, wd] = DirectionsAt(qd);
  if (kind_ == RowKind::kDot || kind_ == RowKind::kSlide) return 2.0 * scale_ * vd.dot(wd);
  const auto [u, v, w] = DirectionsAt(q);
  if (kind_ == RowKind::kTriple)
    return 2.0 * scale_ * (ud.cross(vd).dot(w) + ud.cross(v).dot(wd) + u.cross(vd).dot(wd));
  const double sd = qd[3 * coordinate_];
  const double sine = std::sin(q[3 * coordinate_]), cosine = std::cos(q[3 * coordinate_]);
  const double uw = u.dot(w), uv = u.dot(v);
  const double uw_rate = ud.dot(w) + u.dot(wd), uv_rate = ud.dot(v) + u.dot(vd);
  return scale_ * (2.0 * ud.dot(wd) * cosine - 2.0 * ud.dot(vd) * sine -
                   2.0 * sd * (uw_rate * sine + uv_rate * cosine) - sd * sd * (uw * cosine - uv * sine));
}

}  // namespace rodeira::multibody
