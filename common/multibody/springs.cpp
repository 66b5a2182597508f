#include "common/multibody/springs.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::multibody {
namespace {

constexpr int kMostEntities = 24;
constexpr double kShort_m = 1e-9;  // a spring shorter than this has no direction

// Gradients of a form along n for a load's entities.
void AlongForm(const Form& form, const std::vector<int>& entities, const std::vector<Vector3d>& free, const Vector3d& n,
               Triple* gradients) {
  for (std::size_t k = 0; k < entities.size(); ++k) {
    Vector3d g = Vector3d::Zero();
    for (const Term& term : form.terms) {
      if (term.entity == entities[k]) g += Transposed(term, n);
    }
    g = g.cwiseProduct(free[k]);
    gradients[k].v = {g.x(), g.y(), g.z(), 0.0};
  }
}

std::vector<int> EntitiesOf(const Form& form) {
  std::vector<int> entities;
  for (const Term& term : form.terms) entities.push_back(term.entity);
  return entities;
}

}  // namespace

double SpringLaw::Force(double x, double rate) const {
  double force = preload + spring.Value(x - free) + damper.Value(rate);
  if (x > high) force += stop_stiffness * (x - high) + stop_damping * std::max(0.0, rate);
  if (x < low) force += stop_stiffness * (x - low) + stop_damping * std::min(0.0, rate);
  return force;
}

double SpringLaw::Stiffness(double x) const { return spring.Slope(x - free) + (x > high || x < low ? stop_stiffness : 0.0); }

double SpringLaw::Damping(double x, double rate) const {
  return damper.Slope(rate) + ((x > high && rate > 0.0) || (x < low && rate < 0.0) ? stop_damping : 0.0);
}

double SpringLaw::Energy(double x) const {
  const double beyond = std::max(0.0, x - high) + std::max(0.0, low - x);
  return preload * (x - free) + spring.Integral(x - free) + 0.5 * stop_stiffness * beyond * beyond;
}

PointSpring::PointSpring(const Form& from, const Form& to, SpringLaw law) : way_(Sum(to, from, -1.0)), law_(std::move(law)) {}

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
  std::array<Triple, kMostEntities> gradients;
  const double across = std::max(0.0, force) / length;  // a taut spring resists sideways too: force/length (I - n nᵀ)
  AlongForm(way_, entities_, free_, n, gradients.data());
  sink.Stiffen(pairs_, gradients.data(), std::max(0.0, law_.Stiffness(length)) - across, law_.Damping(length, rate));
  if (across <= 0.0) return;
  for (int c = 0; c < 3; ++c) {
    AlongForm(way_, entities_, free_, Vector3d::Unit(c), gradients.data());
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

void Drag::Add(const Motion& motion, Sink& sink) const {
  const Vector3d v = Evaluate(point_, motion.qd);
  sink.Push(point_, -half_rho_area_kgpm_ * v.norm() * v);
}

Bushing::Bushing(const Frame& first, const Frame& second, const Vector3d& drawn, const BushingSettings& settings)
    : first_(first),
      second_(second),
      at_first_(first.PointAt(drawn)),
      at_second_(second.PointAt(drawn)),
      gap_(Sum(at_second_, at_first_, -1.0)),
      settings_(settings) {}

std::vector<int> Bushing::Stiffens() const {
  std::vector<int> entities = EntitiesOf(gap_);
  for (const Frame* frame : {&first_, &second_}) {
    for (const Form& axis : frame->axes) {
      for (const Term& term : axis.terms) entities.push_back(term.entity);
    }
  }
  std::sort(entities.begin(), entities.end());
  entities.erase(std::unique(entities.begin(), entities.end()), entities.end());
  return entities;
}

// On the second body.
Vector3d Bushing::ForceOn(const Motion& motion) const {
  const Vector3d gap = Evaluate(gap_, motion.q);
  const Vector3d rate = Evaluate(gap_, motion.qd);
  Vector3d force = Vector3d::Zero();
  for (int c = 0; c < 3; ++c) {
    const Vector3d e = Evaluate(first_.axes[static_cast<std::size_t>(c)], motion.q);
    const Vector3d ed = Evaluate(first_.axes[static_cast<std::size_t>(c)], motion.qd);
    force -= (settings_.stiffness_Npm[c] * e.dot(gap) + settings_.damping_Nspm[c] * (e.dot(rate) + ed.dot(gap))) * e;
  }
  return force;
}

Vector3d Bushing::TorqueOn(const Motion& motion) const {
  Vector3d turned = Vector3d::Zero();  // of the second against the first, for small turns
  Vector3d rate = Vector3d::Zero();
  for (std::size_t c = 0; c < 3; ++c) {
    const Vector3d e1 = Evaluate(first_.axes[c], motion.q), e2 = Evaluate(second_.axes[c], motion.q);
    const Vector3d d1 = Evaluate(first_.axes[c], motion.qd), d2 = Evaluate(second_.axes[c], motion.qd);
    turned += 0.5 * e1.cross(e2);
    rate += 0.5 * (e2.cross(d2) - e1.cross(d1));
  }
  return -settings_.turn_Nmprad * turned - settings_.turn_Nmsprad * rate;
}

void Bushing::Add(const Motion& motion, Sink& sink) const {
  const Vector3d force = ForceOn(motion);
  sink.Push(at_second_, force);
  // The reaction acts on the first body where the second one's point now is, so that no moment is made from nothing.
  const Vector3d arm = Evaluate(gap_, motion.q);
  const Vector3d torque = TorqueOn(motion);
  sink.Push(at_first_, -force);
  PushTorque(first_, -arm.cross(force) - torque, motion.q, sink.forces());
  PushTorque(second_, torque, motion.q, sink.forces());
  if (!sink.wants_matrix()) return;
  std::array<Triple, kMostEntities> gradients;
  for (int c = 0; c < 3; ++c) {
    const Vector3d e = Evaluate(first_.axes[static_cast<std::size_t>(c)], motion.q);
    AlongForm(gap_, entities_, free_, e, gradients.data());
    sink.Stiffen(pairs_, gradients.data(), settings_.stiffness_Npm[c], settings_.damping_Nspm[c]);
    if (settings_.turn_Nmprad == 0.0 && settings_.turn_Nmsprad == 0.0) continue;
    // Gradient of the relative turn about the world's axis c.
    for (std::size_t k = 0; k < entities_.size(); ++k) gradients[k] = {};
    for (std::size_t a = 0; a < 3; ++a) {
      for (const auto& [frame, sign] : {std::pair(&second_, 0.5), std::pair(&first_, -0.5)}) {
        const Vector3d axis = Evaluate(frame->axes[a], motion.q);
        const Vector3d pull = sign * Vector3d::Unit(c).cross(axis);
        for (const Term& term : frame->axes[a].terms) {
          for (std::size_t k = 0; k < entities_.size(); ++k) {
            if (entities_[k] != term.entity) continue;
            const Vector3d g = Transposed(term, pull).cwiseProduct(free_[k]);
            for (int i = 0; i < 3; ++i) gradients[k].v[static_cast<std::size_t>(i)] += g[i];
          }
        }
      }
    }
    sink.Stiffen(pairs_, gradients.data(), settings_.turn_Nmprad, settings_.turn_Nmsprad);
  }
}

double Bushing::Energy(const Motion& motion) const {
  const Vector3d gap = Evaluate(gap_, motion.q);
  double energy = 0.0;
  double aligned = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    const Vector3d e = Evaluate(first_.axes[c], motion.q);
    energy += 0.5 * settings_.stiffness_Npm[static_cast<int>(c)] * e.dot(gap) * e.dot(gap);
    aligned += e.dot(Evaluate(second_.axes[c], motion.q));
  }
  return energy + 0.5 * settings_.turn_Nmprad * (3.0 - aligned);
}

double Bushing::Force(const Motion& motion) const { return ForceOn(motion).norm(); }

}  // namespace rodeira::multibody
