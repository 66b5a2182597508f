// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "common/core/base/result.hpp"
#include "common/vehicle/input_devices/pad_driver.hpp"

namespace rodeira::input_devices {

// The first game pad that is plugged in; it needs no setup. No function waits. One thread.
class GamePad {
 public:
  // By the program's device access (device_access.hpp). Wrong input where the program has none, or where it cannot look
  // at devices at all. There need not be a pad: one that is plugged in later is taken.
  static base::Result<std::unique_ptr<GamePad>> Start();
  virtual ~GamePad() = default;

  // Reads the pad; finds out whether it was plugged in or out.
  virtual void Update() = 0;
  virtual const PadReading& reading() const = 0;
  // As the pad calls itself, once it was there.
  virtual const std::string& name() const = 0;
};

}  // namespace rodeira::input_devices
