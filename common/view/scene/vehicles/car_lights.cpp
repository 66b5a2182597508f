// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/vehicles/car_lights.hpp"

namespace rodeira::scene {
namespace {

constexpr float kBraking = 2.1F, kTail = 0.85F, kIndicating = 1.6F, kReverses = 1.5F, kDipped = 1.15F, kMain = 1.4F;
constexpr std::int64_t kTwoSeconds_ns = 2'000'000'000;  // three flashes

}  // namespace

Colour ColourOf(Lamp lamp) {
  switch (lamp) {
    case Lamp::kBrake:
      return Colour::Of(0x7c1410);
    case Lamp::kLeft:
    case Lamp::kRight:
      return Colour::Of(0xa0600e);
    case Lamp::kReversing:
      return Colour::Of(0xa9a8a2);
    case Lamp::kHead:
      return Colour::Of(0xdedcd0);
  }
  return {};
}

std::array<float, kLamps> GlowsOf(const CarLights& lights, bool dark, std::int64_t time_ns) {
  const bool lit = 3 * (time_ns % kTwoSeconds_ns) % kTwoSeconds_ns < kTwoSeconds_ns / 2;
  const bool head = dark || lights.dipped || lights.main;
  const float brake = lights.brake ? kBraking : head ? kTail : 0.0F;
  return {brake, lights.left && lit ? kIndicating : 0.0F, lights.right && lit ? kIndicating : 0.0F,
          lights.reversing ? kReverses : 0.0F,
          lights.main ? kMain
          : head      ? kDipped
                      : 0.0F};
}

}  // namespace rodeira::scene
