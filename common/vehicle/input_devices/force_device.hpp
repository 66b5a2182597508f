// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>

#include "common/vehicle/input_devices/force_feedback.hpp"

namespace rodeira::input_devices {

// The motor of a wheel. Whatever is asked of it ends by itself, so that a run that pauses, stops or dies lets go of the
// driver's hands.
class ForceDevice {
 public:
  virtual ~ForceDevice() = default;
  // From -1 to 1 of what it gives at its most, positive to the left, for `for_s` from now on in place of what was asked
  // before. False where it does not answer (any more).
  virtual bool Push(double share, double for_s) = 0;
};

// A device that follows the law as long as it is told of the car. Nothing is asked for longer than kFor_s ahead.
class ForceDriver {
 public:
  static constexpr double kFor_s =
      0.08;  // less than the 0.1 s in which the wheel must be free, more than some activations of 10 ms

  // `device`: null: there is none.
  ForceDriver(const ForceSettings& settings, std::unique_ptr<ForceDevice> device)
      : law_(settings), device_(std::move(device)) {}

  // Now and then, at each activation; `now_s` of the wall's clock. Calls within kAgain_s of the one before do nothing:
  // a device wants its time.
  void Tell(const ForceMoment& moment, double now_s);
  // The wheel is away, or back as another device (null: away).
  void Change(std::unique_ptr<ForceDevice> device);
  bool has_device() const { return device_ != nullptr; }

 private:
  static constexpr double kAgain_s = 0.004;
  ForceFeedback law_;
  std::unique_ptr<ForceDevice> device_;
  double told_s_ = -1e9;
};

}  // namespace rodeira::input_devices
