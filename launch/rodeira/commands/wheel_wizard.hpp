// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/vehicle/input_devices/joysticks.hpp"
#include "common/vehicle/input_devices/wheel_setup.hpp"

namespace rodeira::cli {

// Setting up a wheel, shown in a terminal or a window: reads the devices, asks for one movement after the
// other, writes the file.
class WheelWizard {
 public:
  static constexpr int kMovements = 6;         // at most
  static constexpr double kPatience_s = 60.0;  // without any progress

  // With all devices that are plugged in now. Wrong input where there is none.
  static base::Result<std::unique_ptr<WheelWizard>> Begin();

  // What the devices say now, dt_s after the step before. Failed where nothing that was asked for has happened for
  // kPatience_s, or no device is there any more.
  base::Status Step(double dt_s);
  bool done() const { return setup_.stage() == input_devices::WheelSetup::Stage::kDone; }

  // The movement that is asked for, from 1 on; what to do, and why the last one did not do.
  int number() const { return number_; }
  std::string prompt() const { return setup_.Prompt(); }
  const std::string& remark() const { return setup_.remark(); }
  // What is plugged in, and what it says: of the same order.
  const std::vector<input_devices::JoystickInfo>& devices() const { return connected_; }
  const std::vector<input_devices::DeviceReading>& readings() const { return readings_; }

  // Once done: the file that was written, `out` or the user's by the steering wheel's GUID. `lock_deg`: of the car's
  // steering wheel where the device's is at its end.
  base::Result<std::filesystem::path> Write(const std::optional<std::filesystem::path>& out, double lock_deg) const;

 private:
  WheelWizard(std::unique_ptr<input_devices::Joysticks> joysticks, std::vector<input_devices::JoystickInfo> connected);

  std::unique_ptr<input_devices::Joysticks> joysticks_;
  std::vector<input_devices::JoystickInfo> connected_;
  input_devices::WheelSetup setup_;
  std::vector<input_devices::DeviceReading> readings_;
  int number_ = 1;
  double waited_s_ = 0.0;
};

}  // namespace rodeira::cli
