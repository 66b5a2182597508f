// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/sdl_devices/sdl_game_pad.hpp"

#include <SDL.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace rodeira::sdl_devices {
namespace {

using input_devices::PadButton;

// Names are those of SDL, which are an Xbox pad's (docs/how-to/wheel.md).
constexpr std::array<std::pair<PadButton, SDL_GameControllerButton>, input_devices::kPadButtons> kButtons = {{
    {PadButton::kGearUp, SDL_CONTROLLER_BUTTON_RIGHTSHOULDER},
    {PadButton::kGearDown, SDL_CONTROLLER_BUTTON_LEFTSHOULDER},
    {PadButton::kGearboxMode, SDL_CONTROLLER_BUTTON_DPAD_DOWN},
    {PadButton::kHandbrake, SDL_CONTROLLER_BUTTON_A},
    {PadButton::kStarter, SDL_CONTROLLER_BUTTON_LEFTSTICK},
    {PadButton::kIndicateLeft, SDL_CONTROLLER_BUTTON_DPAD_LEFT},
    {PadButton::kIndicateRight, SDL_CONTROLLER_BUTTON_DPAD_RIGHT},
    {PadButton::kHazard, SDL_CONTROLLER_BUTTON_DPAD_UP},
    {PadButton::kHeadlights, SDL_CONTROLLER_BUTTON_X},
    {PadButton::kHorn, SDL_CONTROLLER_BUTTON_B},
    {PadButton::kCamera, SDL_CONTROLLER_BUTTON_Y},
    {PadButton::kPause, SDL_CONTROLLER_BUTTON_START},
}};

double Share(SDL_GameController* pad, SDL_GameControllerAxis axis) {
  return std::max(SDL_GameControllerGetAxis(pad, axis) / 32767.0, -1.0);
}

class SdlGamePad final : public input_devices::GamePad {
 public:
  SdlGamePad() = default;
  ~SdlGamePad() override;
  SdlGamePad(const SdlGamePad&) = delete;
  SdlGamePad& operator=(const SdlGamePad&) = delete;

  void Update() override;
  const input_devices::PadReading& reading() const override { return reading_; }
  const std::string& name() const override { return name_; }

 private:
  void Find();

  SDL_GameController* pad_ = nullptr;
  std::string name_;
  input_devices::PadReading reading_;
};

SdlGamePad::~SdlGamePad() {
  if (pad_ != nullptr) SDL_GameControllerClose(pad_);
  SDL_QuitSubSystem(SDL_INIT_GAMECONTROLLER);
}

// Steering wheels of the database do not count as game pads.
void SdlGamePad::Find() {
  SDL_LockJoysticks();
  for (int index = 0; index < SDL_NumJoysticks() && pad_ == nullptr; ++index) {
    if (SDL_IsGameController(index) == SDL_FALSE || SDL_JoystickGetDeviceType(index) == SDL_JOYSTICK_TYPE_WHEEL)
      continue;
    pad_ = SDL_GameControllerOpen(index);
  }
  SDL_UnlockJoysticks();
  if (pad_ == nullptr) return;
  const char* name = SDL_GameControllerName(pad_);
  name_ = name == nullptr || *name == '\0' ? "nameless" : name;
}

void SdlGamePad::Update() {
  SDL_GameControllerUpdate();
  if (pad_ != nullptr && SDL_GameControllerGetAttached(pad_) == SDL_FALSE) {
    SDL_GameControllerClose(pad_);
    pad_ = nullptr;
  }
  if (pad_ == nullptr) Find();
  reading_ = {};
  if (pad_ == nullptr) return;
  reading_.connected = true;
  reading_.stick = Share(pad_, SDL_CONTROLLER_AXIS_LEFTX);
  reading_.throttle = std::max(Share(pad_, SDL_CONTROLLER_AXIS_TRIGGERRIGHT), 0.0);
  reading_.brake = std::max(Share(pad_, SDL_CONTROLLER_AXIS_TRIGGERLEFT), 0.0);
  for (const auto& [what, button] : kButtons)
    reading_.down[static_cast<std::size_t>(what)] = SDL_GameControllerGetButton(pad_, button) != 0;
}

}  // namespace

base::Result<std::unique_ptr<input_devices::GamePad>> StartGamePad() {
  SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");                // signals are the run's
  SDL_SetHint(SDL_HINT_JOYSTICK_ALLOW_BACKGROUND_EVENTS, "1");  // it drives whatever window has the keyboard
  SDL_SetMainReady();
  if (SDL_InitSubSystem(SDL_INIT_GAMECONTROLLER) != 0)
    return base::Failed("device.no_sdl", fmt::format("SDL cannot look at game pads: {}", SDL_GetError()));
  SDL_JoystickEventState(SDL_IGNORE);  // they are read, not listened to
  SDL_GameControllerEventState(SDL_IGNORE);
  auto made = std::make_unique<SdlGamePad>();
  made->Update();
  return std::unique_ptr<input_devices::GamePad>(std::move(made));
}

}  // namespace rodeira::sdl_devices
