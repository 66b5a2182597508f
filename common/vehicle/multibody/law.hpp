// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "common/core/base/constants.hpp"

namespace rodeira::multibody {

// A given motion or force over time: c0 + c1 t + c2 t² + amplitude sin(2 pi frequency t + phase).
struct Law {
  double c0 = 0.0;
  double c1 = 0.0;
  double c2 = 0.0;
  double amplitude = 0.0;
  double frequency_Hz = 0.0;
  double phase_rad = 0.0;

  // Whether it is 0 at all times.
  bool IsZero() const { return c0 == 0.0 && c1 == 0.0 && c2 == 0.0 && amplitude == 0.0; }
  double Value(double t) const {
    return c0 + t * (c1 + t * c2) + (amplitude == 0.0 ? 0.0 : amplitude * std::sin(omega() * t + phase_rad));
  }
  // The first derivative by t; Acceleration is the second one.
  double Rate(double t) const {
    return c1 + 2.0 * c2 * t + (amplitude == 0.0 ? 0.0 : amplitude * omega() * std::cos(omega() * t + phase_rad));
  }
  double Acceleration(double t) const {
    return 2.0 * c2 - (amplitude == 0.0 ? 0.0 : amplitude * omega() * omega() * std::sin(omega() * t + phase_rad));
  }

 private:
  double omega() const { return 2.0 * base::kPi * frequency_Hz; }
};

}  // namespace rodeira::multibody
