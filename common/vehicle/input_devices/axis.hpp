// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "common/core/base/state.hpp"

namespace rodeira::input_devices {

// One axis of one device and what its numbers mean.
struct AxisUse {
  std::size_t device = 0;  // in the order of the file's `devices`
  std::size_t axis = 0;
  double min = -32768.0;
  double centre = 0.0;  // where it has two sides
  double max = 32767.0;
  double dead_zone = 0.0;  // share of a side, or of a pedal's way, next to its rest
  double exponent = 1.0;   // above 1: finer next to the rest
  bool inverted = false;
  std::string place;  // file:line, for people
};

// A raw number with two sides as -1 … 1: linear from the centre to either end, behind the dead zone, raised to the
// exponent.
double TwoSided(const AxisUse& use, double raw);
// A pedal's as 0 (released, `min`) … 1 (to the floor, `max`; the other way round where inverted).
double OneSided(const AxisUse& use, double raw);

// Drivers give any number for an axis until it first moves (a pedal half down, a wheel at its stop): until then it
// counts as at rest.
class AxisWatch {
 public:
  // Whether this number, or one before it, lies away from the first.
  bool Moved(const AxisUse& use, double raw);
  // As if no number had come yet.
  void Forget() { *this = AxisWatch(); }

  void Save(base::StateWriter& out) const;
  void Restore(base::StateReader& in);

 private:
  bool seen_ = false;
  bool moved_ = false;
  double first_ = 0.0;
};

}  // namespace rodeira::input_devices
