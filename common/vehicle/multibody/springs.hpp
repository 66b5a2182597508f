// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>

#include "common/vehicle/multibody/body.hpp"
#include "common/vehicle/multibody/curve.hpp"
#include "common/vehicle/multibody/law.hpp"
#include "common/vehicle/multibody/load.hpp"

namespace rodeira::multibody {

// Force over a length (or angle) x and its rate: spring, damper, stops. Tension, or pull back towards less x, is
// positive.
struct SpringLaw {
  Curve spring;                                           // over x - free
  double free = 0.0;                                      // x without spring force
  double preload = 0.0;                                   // added to it
  Curve damper;                                           // over the rate
  double low = -std::numeric_limits<double>::infinity();  // stops: beyond them a spring and a damper more
  double high = std::numeric_limits<double>::infinity();
  double stop_stiffness = 0.0;
  double stop_damping = 0.0;  // acts while pressed further in

  // All four at a length or angle x: the force with its derivatives by x and by the rate, and the energy, J (0 without
  // spring force).
  double Force(double x, double rate) const;
  double Stiffness(double x) const;
  double Damping(double x, double rate) const;
  double Energy(double x) const;
};

// Spring, damper and stops between two points, along the line between them.
class PointSpring final : public Load {
 public:
  PointSpring(const Form& from, const Form& to, SpringLaw law);
  std::vector<int> Stiffens() const override;
  void Add(const Motion& motion, Sink& sink) const override;
  double Energy(const Motion& motion) const override { return law_.Energy(Evaluate(way_, motion.q).norm()); }
  double Force(const Motion& motion) const override;

 private:
  Form way_;
  SpringLaw law_;
};

// The same on a coordinate: a distance (force) or an angle (torque).
class CoordinateSpring final : public Load {
 public:
  CoordinateSpring(int coordinate, SpringLaw law) : coordinate_(coordinate), law_(std::move(law)) {}
  std::vector<int> Stiffens() const override { return {coordinate_}; }
  void Add(const Motion& motion, Sink& sink) const override;
  double Energy(const Motion& motion) const override { return law_.Energy(motion.q[3 * coordinate_]); }
  double Force(const Motion& motion) const override {
    return law_.Force(motion.q[3 * coordinate_], motion.qd[3 * coordinate_]);
  }
  double ForceAtRest(const Motion& motion) const override { return law_.Force(motion.q[3 * coordinate_], 0.0); }

 private:
  int coordinate_;
  SpringLaw law_;
};

// An anti-roll bar between two coordinates of one kind, distances or angles: it pushes both by the difference of what
// they have moved since they were drawn, F = k ((b - b0) - (a - a0)) + c (bd - ad), a by +F and b by -F.
class AntiRollBar final : public Load {
 public:
  // N/m and N s/m of distances, N m/rad and N m s/rad of angles.
  struct Settings {
    double stiffness = 0.0;
    double damping = 0.0;
    double drawn = 0.0;  // b0 - a0
  };
  AntiRollBar(int a, int b, const Settings& settings) : a_(a), b_(b), settings_(settings) {}
  std::vector<int> Stiffens() const override { return {a_, b_}; }
  void Add(const Motion& motion, Sink& sink) const override;
  double Energy(const Motion& motion) const override;
  double Force(const Motion& motion) const override;
  double ForceAtRest(const Motion& motion) const override { return settings_.stiffness * Twist(motion.q); }

 private:
  double Twist(const double* q) const { return q[3 * b_] - q[3 * a_] - settings_.drawn; }

  int a_, b_;
  Settings settings_;
};

// A given force at a point, in the world's axes, or a torque on a body, times a function of time.
class GivenForce final : public Load {
 public:
  GivenForce(Form point, const Vector3d& direction, const Law& law)
      : point_(std::move(point)), direction_(direction), law_(law) {}
  void Add(const Motion& motion, Sink& sink) const override {
    sink.Push(point_, law_.Value(motion.time_s) * direction_);
  }
  double Force(const Motion& motion) const override { return law_.Value(motion.time_s) * direction_.norm(); }

 private:
  Form point_;
  Vector3d direction_;
  Law law_;
};

// A given torque on a body, about an axis of the world, times a function of time.
class GivenTorque final : public Load {
 public:
  GivenTorque(Frame frame, const Vector3d& direction, const Law& law)
      : frame_(std::move(frame)), direction_(direction), law_(law) {}
  void Add(const Motion& motion, Sink& sink) const override {
    sink.PushTorque(frame_, law_.Value(motion.time_s) * direction_, motion.q);
  }
  double Force(const Motion& motion) const override { return law_.Value(motion.time_s) * direction_.norm(); }

 private:
  Frame frame_;
  Vector3d direction_;
  Law law_;
};

// A given force on a distance, or torque on an angle, as a function of time.
class CoordinateForce final : public Load {
 public:
  CoordinateForce(int coordinate, const Law& law) : coordinate_(coordinate), law_(law) {}
  void Add(const Motion& motion, Sink& sink) const override { sink.Push(coordinate_, law_.Value(motion.time_s)); }
  double Force(const Motion& motion) const override { return law_.Value(motion.time_s); }

 private:
  int coordinate_;
  Law law_;
};

// Quadratic drag at a point: -½ rho CdA |v| v.
class Drag final : public Load {
 public:
  Drag(Form point, double half_rho_area_kgpm) : point_(std::move(point)), half_rho_area_kgpm_(half_rho_area_kgpm) {}
  void Add(const Motion& motion, Sink& sink) const override;
  double Force(const Motion& motion) const override {
    return half_rho_area_kgpm_ * Evaluate(point_, motion.qd).squaredNorm();
  }

 private:
  Form point_;
  double half_rho_area_kgpm_;
};

}  // namespace rodeira::multibody
