// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace rodeira::multibody {

// y(x) by samples ascending in x: linear between them, going on with the end slopes beyond.
class Curve {
 public:
  // A point of the curve.
  struct Sample {
    double x = 0.0;
    double y = 0.0;
  };
  Curve() = default;
  // At least two samples, x strictly ascending.
  explicit Curve(std::vector<Sample> samples);
  // y = slope x.
  static Curve Linear(double slope) { return Curve({{0.0, 0.0}, {1.0, slope}}); }

  // Beyond the samples, too.
  double Value(double x) const;
  // dy/dx; at a sample that of the segment to its right. An empty curve has value and slope 0.
  double Slope(double x) const;
  // Integral from 0 to x: the energy of a spring with the curve as its force.
  double Integral(double x) const { return FromFirst(x) - FromFirst(0.0); }
  bool empty() const { return samples_.empty(); }
  const std::vector<Sample>& samples() const { return samples_; }

 private:
  std::size_t Segment(double x) const;
  double FromFirst(double x) const;  // integral from the first sample

  std::vector<Sample> samples_;
  std::vector<double> integral_;  // from the first sample to each
};

}  // namespace rodeira::multibody
