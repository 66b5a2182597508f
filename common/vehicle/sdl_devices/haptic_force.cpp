// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/sdl_devices/haptic_force.hpp"

#include <SDL.h>

#include <algorithm>
#include <cmath>

namespace rodeira::sdl_devices {
namespace {

constexpr double kMost = 32767.0;

class HapticForce final : public input_devices::ForceDevice {
 public:
  // Takes the device; `effect` is on it already.
  HapticForce(SDL_Haptic* haptic, int effect, const SDL_HapticEffect& told, bool inverted)
      : haptic_(haptic), effect_(effect), told_(told), inverted_(inverted) {}
  ~HapticForce() override {
    SDL_HapticStopAll(haptic_);
    SDL_HapticClose(haptic_);
    SDL_QuitSubSystem(SDL_INIT_HAPTIC);
  }

  bool Push(double share, double for_s) override {
    told_.constant.level = static_cast<Sint16>(std::lround(std::clamp(inverted_ ? -share : share, -1.0, 1.0) * kMost));
    told_.constant.length = static_cast<Uint32>(std::lround(for_s * 1e3));  // of an effect: it ends by itself
    return SDL_HapticUpdateEffect(haptic_, effect_, &told_) == 0 && SDL_HapticRunEffect(haptic_, effect_, 1) == 0;
  }

 private:
  SDL_Haptic* haptic_;
  int effect_;
  SDL_HapticEffect told_;
  bool inverted_;
};

SDL_HapticEffect NoForce() {
  SDL_HapticEffect effect{};
  effect.type = SDL_HAPTIC_CONSTANT;
  effect.constant.type = SDL_HAPTIC_CONSTANT;
  effect.constant.direction.type = SDL_HAPTIC_STEERING_AXIS;
  effect.constant.length = 1;
  return effect;
}

}  // namespace

std::unique_ptr<input_devices::ForceDevice> OpenHapticForce(_SDL_Joystick* joystick, bool inverted) {
  if (joystick == nullptr || SDL_InitSubSystem(SDL_INIT_HAPTIC) != 0) return nullptr;
  SDL_Haptic* haptic = SDL_JoystickIsHaptic(joystick) == SDL_TRUE ? SDL_HapticOpenFromJoystick(joystick) : nullptr;
  if (haptic != nullptr && (SDL_HapticQuery(haptic) & SDL_HAPTIC_CONSTANT) != 0) {
    if ((SDL_HapticQuery(haptic) & SDL_HAPTIC_AUTOCENTER) != 0) (void)SDL_HapticSetAutocenter(haptic, 0);
    if ((SDL_HapticQuery(haptic) & SDL_HAPTIC_GAIN) != 0) (void)SDL_HapticSetGain(haptic, 100);
    SDL_HapticEffect effect = NoForce();
    if (const int number = SDL_HapticNewEffect(haptic, &effect); number >= 0)
      return std::make_unique<HapticForce>(haptic, number, effect, inverted);
  }
  if (haptic != nullptr) SDL_HapticClose(haptic);
  SDL_QuitSubSystem(SDL_INIT_HAPTIC);
  SDL_ClearError();
  return nullptr;
}

}  // namespace rodeira::sdl_devices
