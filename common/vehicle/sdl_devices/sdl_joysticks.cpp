// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/sdl_devices/sdl_joysticks.hpp"

#include <SDL.h>
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "common/vehicle/sdl_devices/haptic_force.hpp"

namespace rodeira::sdl_devices {
namespace {

using input_devices::JoystickInfo;

std::string GuidText(SDL_JoystickGUID guid) {
  char text[33] = {};
  SDL_JoystickGetGUIDString(guid, text, sizeof(text));
  return text;
}

std::string OrNameless(const char* name) { return name == nullptr || *name == '\0' ? "nameless" : name; }

// Nothing is plugged or unplugged while the list is looked at.
class Locked {
 public:
  Locked() { SDL_LockJoysticks(); }
  ~Locked() { SDL_UnlockJoysticks(); }
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;
};

class SdlJoysticks final : public input_devices::Joysticks {
 public:
  SdlJoysticks() = default;
  ~SdlJoysticks() override;
  SdlJoysticks(const SdlJoysticks&) = delete;
  SdlJoysticks& operator=(const SdlJoysticks&) = delete;

  void Update() override;
  std::vector<JoystickInfo> Connected() const override;
  void Use(const std::vector<std::string>& guids) override;
  const input_devices::DeviceReading& reading(std::size_t place) const override { return used_[place].reading; }
  const std::string& name(std::size_t place) const override { return used_[place].name; }
  std::uint64_t connection(std::size_t place) const override {
    SDL_Joystick* joystick = used_[place].joystick;
    return joystick == nullptr ? 0 : static_cast<std::uint64_t>(SDL_JoystickInstanceID(joystick)) + 1;
  }
  std::unique_ptr<input_devices::ForceDevice> OpenMotor(std::size_t place, bool inverted) override {
    return OpenHapticForce(used_[place].joystick, inverted);
  }

 private:
  struct Used {
    std::string guid;
    std::string name;
    SDL_Joystick* joystick = nullptr;  // null: not there
    input_devices::DeviceReading reading;
  };
  void OpenMissing();
  static void Read(Used& used);

  std::vector<Used> used_;
};

SdlJoysticks::~SdlJoysticks() {
  for (Used& used : used_) {
    if (used.joystick != nullptr) SDL_JoystickClose(used.joystick);
  }
  SDL_QuitSubSystem(SDL_INIT_JOYSTICK);
}

std::vector<JoystickInfo> SdlJoysticks::Connected() const {
  const Locked locked;
  std::vector<JoystickInfo> all;
  for (int index = 0; index < SDL_NumJoysticks(); ++index) {
    SDL_Joystick* joystick = SDL_JoystickOpen(index);  // an open one is counted, not opened again
    JoystickInfo info{OrNameless(SDL_JoystickNameForIndex(index)), GuidText(SDL_JoystickGetDeviceGUID(index)), 0, 0,
                      SDL_JoystickGetDeviceType(index) == SDL_JOYSTICK_TYPE_WHEEL};
    if (joystick != nullptr) {
      info.axes = SDL_JoystickNumAxes(joystick);
      info.buttons = SDL_JoystickNumButtons(joystick);
      SDL_JoystickClose(joystick);
    }
    all.push_back(std::move(info));
  }
  return all;
}

void SdlJoysticks::Use(const std::vector<std::string>& guids) {
  for (const std::string& guid : guids) used_.push_back({guid, "", nullptr, {}});
  Update();
}

void SdlJoysticks::Update() {
  SDL_JoystickUpdate();
  for (Used& used : used_) {
    if (used.joystick != nullptr && SDL_JoystickGetAttached(used.joystick) == SDL_FALSE) {
      SDL_JoystickClose(used.joystick);
      used.joystick = nullptr;
    }
  }
  OpenMissing();
  for (Used& used : used_) Read(used);
}

void SdlJoysticks::OpenMissing() {
  if (std::none_of(used_.begin(), used_.end(), [](const Used& used) { return used.joystick == nullptr; })) return;
  const Locked locked;
  for (int index = 0; index < SDL_NumJoysticks(); ++index) {
    const std::string guid = GuidText(SDL_JoystickGetDeviceGUID(index));
    const SDL_JoystickID id = SDL_JoystickGetDeviceInstanceID(index);
    const bool taken = std::any_of(used_.begin(), used_.end(), [id](const Used& used) {
      return used.joystick != nullptr && SDL_JoystickInstanceID(used.joystick) == id;
    });
    if (taken) continue;
    const auto waiting = std::find_if(used_.begin(), used_.end(),
                                      [&](const Used& used) { return used.joystick == nullptr && used.guid == guid; });
    if (waiting == used_.end()) continue;
    waiting->joystick = SDL_JoystickOpen(index);
    if (waiting->joystick != nullptr) waiting->name = OrNameless(SDL_JoystickName(waiting->joystick));
  }
}

void SdlJoysticks::Read(Used& used) {
  used.reading.connected = used.joystick != nullptr;
  if (used.joystick == nullptr) return;
  used.reading.axes.resize(static_cast<std::size_t>(std::max(0, SDL_JoystickNumAxes(used.joystick))));
  used.reading.buttons.resize(static_cast<std::size_t>(std::max(0, SDL_JoystickNumButtons(used.joystick))));
  for (std::size_t axis = 0; axis < used.reading.axes.size(); ++axis)
    used.reading.axes[axis] = SDL_JoystickGetAxis(used.joystick, static_cast<int>(axis));
  for (std::size_t button = 0; button < used.reading.buttons.size(); ++button) {
    used.reading.buttons[button] = SDL_JoystickGetButton(used.joystick, static_cast<int>(button));
  }
}

}  // namespace

base::Result<std::unique_ptr<input_devices::Joysticks>> StartJoysticks() {
  SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");                // signals are the run's
  SDL_SetHint(SDL_HINT_JOYSTICK_ALLOW_BACKGROUND_EVENTS, "1");  // a wheel steers whatever window has the keyboard
  SDL_SetMainReady();
  if (SDL_InitSubSystem(SDL_INIT_JOYSTICK) != 0)
    return base::Failed("device.no_sdl", fmt::format("SDL cannot look at joysticks: {}", SDL_GetError()));
  SDL_JoystickEventState(SDL_IGNORE);  // they are read, not listened to
  return std::unique_ptr<input_devices::Joysticks>(std::make_unique<SdlJoysticks>());
}

}  // namespace rodeira::sdl_devices
