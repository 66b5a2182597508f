// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "common/core/base/state.hpp"

// What a driver tells the others: lamps and horn. No car model needs it, so it goes beside the controls.
namespace rodeira::input_devices {

enum class Indicators : std::uint32_t { kOff = 0, kLeft = 1, kRight = 2, kHazard = 3 };
enum class Headlights : std::uint32_t { kOff = 0, kDipped = 1, kFull = 2 };

// What lamps and horn do now.
struct Signals {
  Indicators indicators = Indicators::kOff;
  Headlights headlights = Headlights::kOff;
  bool horn = false;

  bool operator==(const Signals&) const = default;
};

// What was asked of levers and buttons during one step: presses, and the horn while it is held.
struct SignalRequests {
  std::uint32_t left = 0, right = 0, hazard = 0, headlights = 0;
  bool horn = false;
};

// The lever of the indicators and the light switch. A press to a side begins it, another one ends it; turning back from
// a bend ends it too: once the steering wheel was more than kBend_rad on that side, it goes out within kBack_rad of
// straight ahead. The hazard lights stand above the lever, which stays where it is. Headlights go round: off, dipped,
// full.
class SignalSwitch {
 public:
  static constexpr double kBend_rad = 0.70, kBack_rad = 0.175;  // 40 and 10 degrees: choices of this project

  // The steering wheel is positive to the left.
  Signals Step(const SignalRequests& requests, double steering_wheel_rad);
  Signals signals() const;
  // As others have left it.
  void InitialiseFrom(const Signals& last);

  void Save(base::StateWriter& out) const;
  void Restore(base::StateReader& in);

 private:
  void Press(Indicators side, std::uint32_t presses);

  Indicators lever_ = Indicators::kOff;  // never kHazard
  Headlights headlights_ = Headlights::kOff;
  bool hazard_ = false;
  bool horn_ = false;
  bool in_bend_ = false;
};

}  // namespace rodeira::input_devices
