// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/input_devices/axis.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::input_devices {
namespace {

constexpr double kMoved = 0.01;  // share of the whole way; less is noise

// 0 … 1 from the rest on.
double Shaped(const AxisUse& use, double share) {
  const double behind = std::clamp((share - use.dead_zone) / (1.0 - use.dead_zone), 0.0, 1.0);
  return use.exponent == 1.0 ? behind : std::pow(behind, use.exponent);
}

}  // namespace

double TwoSided(const AxisUse& use, double raw) {
  const double side = raw >= use.centre ? use.max - use.centre : use.centre - use.min;
  const double value = std::copysign(Shaped(use, std::fabs(raw - use.centre) / side), raw - use.centre);
  return use.inverted ? -value : value;
}

double OneSided(const AxisUse& use, double raw) {
  const double share = (raw - use.min) / (use.max - use.min);
  return Shaped(use, use.inverted ? 1.0 - share : share);
}

bool AxisWatch::Moved(const AxisUse& use, double raw) {
  if (!seen_) {
    seen_ = true;
    first_ = raw;
  }
  moved_ = moved_ || std::fabs(raw - first_) > kMoved * (use.max - use.min);
  return moved_;
}

void AxisWatch::Save(base::StateWriter& out) const {
  out.Put("seen", seen_);
  out.Put("moved", moved_);
  out.Put("first", first_);
}

void AxisWatch::Restore(base::StateReader& in) {
  in.Get("seen", seen_);
  in.Get("moved", moved_);
  in.Get("first", first_);
}

}  // namespace rodeira::input_devices
