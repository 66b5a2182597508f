// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/vehicles/car_lights.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace rodeira::scene {
namespace {

constexpr std::size_t At(Lamp lamp) { return static_cast<std::size_t>(lamp); }

TEST(CarLights, EachSwitchHasItsLamps) {
  const auto none = GlowsOf({}, false, 0);
  for (const float glow : none) EXPECT_EQ(glow, 0.0F);
  const auto only = [](const CarLights& lights, Lamp lamp) {
    const auto glows = GlowsOf(lights, false, 0);
    for (std::size_t i = 0; i < kLamps; ++i) EXPECT_EQ(glows[i] > 0.0F, i == At(lamp)) << i;
  };
  only({.brake = true}, Lamp::kBrake);
  only({.left = true}, Lamp::kLeft);
  only({.right = true}, Lamp::kRight);
  only({.reversing = true}, Lamp::kReversing);
}

// With headlights there are tail lights, and a brake that is pressed is seen beside them.
TEST(CarLights, HeadlightsBringTailLights) {
  for (const auto& [lights, dark] : {std::pair(CarLights{.dipped = true}, false),
                                     std::pair(CarLights{.main = true}, false), std::pair(CarLights{}, true)}) {
    const auto glows = GlowsOf(lights, dark, 0);
    EXPECT_GT(glows[At(Lamp::kHead)], 0.0F);
    EXPECT_GT(glows[At(Lamp::kBrake)], 0.0F);
    CarLights braking = lights;
    braking.brake = true;
    EXPECT_GT(GlowsOf(braking, dark, 0)[At(Lamp::kBrake)], 1.5F * glows[At(Lamp::kBrake)]);
  }
}

// Between 60 and 120 a minute (UN Regulation 48): 90, as often in any ten seconds, and as long on as off.
TEST(CarLights, IndicatorsFlashNinetyTimesAMinute) {
  for (const std::int64_t from_ns : {std::int64_t{0}, std::int64_t{3'333'333'337}, std::int64_t{86'400'000'000'000}}) {
    int flashes = 0, on = 0;
    constexpr int kSteps = 10'000;
    bool before = GlowsOf({.right = true}, false, from_ns - 1'000'000)[At(Lamp::kRight)] > 0.0F;
    for (int ms = 0; ms < kSteps; ++ms) {
      const bool lit = GlowsOf({.right = true}, false, from_ns + ms * std::int64_t{1'000'000})[At(Lamp::kRight)] > 0.0F;
      flashes += lit && !before;
      on += lit;
      before = lit;
    }
    EXPECT_NEAR(flashes, 15, 1) << from_ns;
    EXPECT_NEAR(on, kSteps / 2, 340);
  }
}

}  // namespace
}  // namespace rodeira::scene
