// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/multibody/curve.hpp"

#include <algorithm>

#include "common/core/base/assert.hpp"

namespace rodeira::multibody {

Curve::Curve(std::vector<Sample> samples) : samples_(std::move(samples)) {
  RODEIRA_ASSERT(samples_.size() >= 2);
  integral_.push_back(0.0);
  for (std::size_t i = 1; i < samples_.size(); ++i) {
    RODEIRA_ASSERT(samples_[i].x > samples_[i - 1].x);
    integral_.push_back(integral_.back() +
                        0.5 * (samples_[i].y + samples_[i - 1].y) * (samples_[i].x - samples_[i - 1].x));
  }
}

std::size_t Curve::Segment(double x) const {
  const auto above = std::upper_bound(samples_.begin() + 1, samples_.end() - 1, x,
                                      [](double value, const Sample& sample) { return value < sample.x; });
  return static_cast<std::size_t>(above - samples_.begin()) - 1;
}

double Curve::Slope(double x) const {
  if (samples_.empty()) return 0.0;
  const std::size_t i = Segment(x);
  return (samples_[i + 1].y - samples_[i].y) / (samples_[i + 1].x - samples_[i].x);
}

double Curve::Value(double x) const {
  if (samples_.empty()) return 0.0;
  const std::size_t i = Segment(x);
  return samples_[i].y +
         (samples_[i + 1].y - samples_[i].y) / (samples_[i + 1].x - samples_[i].x) * (x - samples_[i].x);
}

double Curve::FromFirst(double x) const {
  if (samples_.empty()) return 0.0;
  const std::size_t i = Segment(x);
  return integral_[i] + 0.5 * (samples_[i].y + Value(x)) * (x - samples_[i].x);
}

}  // namespace rodeira::multibody
