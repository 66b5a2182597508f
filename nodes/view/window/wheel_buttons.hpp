// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

struct _SDL_Joystick;
struct _SDL_GameController;

namespace rodeira::nodes {

// A button of a steering wheel on the window's PC; without a GUID: of the first game pad, by SDL's numbers of their
// buttons. `own`: what the files of the wheels that are plugged in (`rodeira input setup`) call `camera`, whichever
// these are, and the rest of it is not looked at.
struct WheelButtonUse {
  std::string guid;
  int button = 0;
  bool own = false;
};
inline constexpr int kPadCameraButton = 3;  // y

// Buttons of the wheel that change what the window shows (`camera` of a wheel file). A file that cannot be read names
// none: that is the input's to say. Used on the thread of the window.
class WheelButtons {
 public:
  // Null where none is named, or SDL cannot look at devices.
  static std::unique_ptr<WheelButtons> Open(const std::vector<WheelButtonUse>& uses);
  ~WheelButtons();
  WheelButtons(const WheelButtons&) = delete;
  WheelButtons& operator=(const WheelButtons&) = delete;

  // Whether one was pressed since the last call. A wheel may come and go. Never waits.
  bool Pressed();

 private:
  struct Button {
    WheelButtonUse use;
    _SDL_Joystick* joystick = nullptr;
    _SDL_GameController* pad = nullptr;  // instead of it
    int seen = -1;                       // so many devices were there when their own files were looked for
    bool down = true;                    // one that is held as it begins is no press
  };
  WheelButtons() = default;
  static void Find(Button& button);
  static void FindOwn(Button& button);
  static void Drop(Button& button);
  std::vector<Button> buttons_;
};

}  // namespace rodeira::nodes
