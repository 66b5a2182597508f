// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "common/runtime/launch/launch.hpp"
#include "common/vehicle/input_devices/game_pad.hpp"
#include "common/vehicle/input_devices/joysticks.hpp"

namespace rodeira::cli {

// Buttons of steering wheels (`pause` of a wheel file) and game pads (start) that pause the run and let it go on, on
// the PC where the clock is. As the terminal's keys they are the operator's: the clock stands, and what it does is a
// remark, no sample.
class PauseButtons {
 public:
  // Those of the launch file's inputs with `source: joystick` or `gamepad`. Null where no wheel file names one, and no
  // game pad may drive; what is wrong there the input says.
  static std::unique_ptr<PauseButtons> Open(const launch::Launch& launch);

  // Whether one was pressed since the last call. Never waits.
  bool Pressed();

 private:
  struct Button {
    std::size_t place = 0, button = 0;  // of the devices
    bool down = true;                   // one that is held as it begins is no press
  };
  bool TakePad();

  std::unique_ptr<input_devices::Joysticks> joysticks_;  // null: no wheel is looked at
  std::unique_ptr<input_devices::GamePad> pad_;          // null: none may drive
  bool pad_down_ = true;
  std::vector<Button> buttons_;
};

}  // namespace rodeira::cli
