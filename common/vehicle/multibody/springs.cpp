// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/multibody/springs.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::multibody {
namespace {

constexpr double kShort_m = 1e-9;  // a spring shorter than this has no direction

}  // namespace

double SpringLaw::Force(double x, double rate) const {
  double force = preload + spring.Value(x - free) + damper.Value(rate);
  if (x > high) force += stop_stiffness * (x - high) + stop_damping * std::max(0.0, rate);
  if (x < low) force += stop_stiffness * (x - low) + stop_damping * std::min(0.0, rate);
  return force;
}

double SpringLaw::Stiffness(double x) const {
  return spring.Slope(x - free) + (x > high || x < low ? stop_stiffness : 0.0);
}

double SpringLaw::Damping(double x, double rate) const {
  return damper.Slope(rate) + ((x > high && rate > 0.0) || (x < low && rate < 0.0) ? stop_damping : 0.0);
}

double SpringLaw::Energy(double x) const {
  const double beyond = std::max(0.0, x - high) + std::max(0.0, low - x);
  return preload * (x - free) + spring.Integral(x - free) + 0.5 * stop_stiffness * beyond * beyond;
}

PointSpring::PointSpring(const Form& from, const Form& to, SpringLaw law)
    : way_(Sum(to, from, -1.0)), law_(std::move(law)) {}

std::vector<int> PointSpring::Stiffens() const { return EntitiesOf(way_); }

double PointSpring::Force(const Motion& motion) const {
  const Vector3d way = Evaluate(way_, motion.q);
  const double length = way.norm();
  if (length < kShort_m) return 0.0;
  return law_.Force(length, way.dot(Evaluate(way_, motion.qd)) / length);
}

void PointSpring::Add(const Motion& motion, Sink& sink) const {
  const Vector3d way = Evaluate(way_, motion.q);
  const double length = way.norm();
  if (length < kShort_m) return;
  const Vector3d n = way / length;
  const double rate = n.dot(Evaluate(way_, motion.qd));
  const double force = law_.Force(length, rate);
  sink.Push(way_, -force * n);
  if (!sink.wants_matrix()) return;
  std::array<Triple, kMaxLoadEntities> gradients;
  const double across = std::max(0.0, force) / length;  // a taut spring resists sideways too: force/length (I - n nᵀ)
  AlongForm(way_, n, gradients.data());
  sink.Stiffen(pairs_, gradients.data(), std::max(0.0, law_.Stiffness(length)) - across, law_.Damping(length, rate));
  if (across <= 0.0) return;
  for (int c = 0; c < 3; ++c) {
    AlongForm(way_, Vector3d::Unit(c), gradients.data());
    sink.Stiffen(pairs_, gradients.data(), across, 0.0);
  }
}

void CoordinateSpring::Add(const Motion& motion, Sink& sink) const {
  const double x = motion.q[3 * coordinate_];
  const double rate = motion.qd[3 * coordinate_];
  sink.Push(coordinate_, -law_.Force(x, rate));
  if (!sink.wants_matrix() || entities_.empty()) return;
  const Triple gradient{{1.0, 0.0, 0.0, 0.0}};
  sink.Stiffen(pairs_, &gradient, std::max(0.0, law_.Stiffness(x)), law_.Damping(x, rate));
}

// The matrix has K and C of both together: g = (-1, 1).
void AntiRollBar::Add(const Motion& motion, Sink& sink) const {
  const double force = Force(motion);
  sink.Push(a_, force);
  sink.Push(b_, -force);
  if (!sink.wants_matrix() || entities_.empty()) return;
  std::array<Triple, 2> gradients;
  for (std::size_t k = 0; k < entities_.size(); ++k) gradients[k].v = {entities_[k] == b_ ? 1.0 : -1.0, 0.0, 0.0, 0.0};
  sink.Stiffen(pairs_, gradients.data(), settings_.stiffness, settings_.damping);
}

double AntiRollBar::Energy(const Motion& motion) const {
  const double twist = Twist(motion.q);
  return 0.5 * settings_.stiffness * twist * twist;
}

double AntiRollBar::Force(const Motion& motion) const {
  return settings_.stiffness * Twist(motion.q) + settings_.damping * (motion.qd[3 * b_] - motion.qd[3 * a_]);
}

void Drag::Add(const Motion& motion, Sink& sink) const {
  const Vector3d v = Evaluate(point_, motion.qd);
  sink.Push(point_, -half_rho_area_kgpm_ * v.norm() * v);
}

}  // namespace rodeira::multibody
