#pragma once

#include <memory>
#include <vector>

#include "common/launch/launch.hpp"
#include "nodes/input/joysticks.hpp"

namespace rodeira::front {

// Buttons of steering wheels that pause the run and let it go on (`pause` of a wheel file), on the PC where the clock is. As the terminal's
// keys they are the operator's: the clock stands, and what it does is a remark, no sample.
class PauseButtons {
 public:
  // Those of the launch file's inputs with `source: joystick`. Null where no wheel file names one; what is wrong there the input says.
  static std::unique_ptr<PauseButtons> Open(const launch::Launch& launch);

  // Whether one was pressed since the last call. Never waits.
  bool Pressed();

 private:
  struct Button {
    std::size_t place = 0, button = 0;  // of the devices
    bool down = true;                   // one that is held as it begins is no press
  };
  std::unique_ptr<nodes::Joysticks> joysticks_;
  std::vector<Button> buttons_;
};

}  // namespace rodeira::front
