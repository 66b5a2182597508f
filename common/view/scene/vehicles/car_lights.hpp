// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/view/scene/mesh/mesh.hpp"

namespace rodeira::scene {

// What is switched on at a vehicle. Indicators flash as long as they are.
struct CarLights {
  bool brake = false, left = false, right = false, reversing = false, dipped = false, main = false;
};

// Groups of lamps that shine together. Behind, kBrake is the tail light too.
enum class Lamp : std::uint8_t { kBrake, kLeft, kRight, kReversing, kHead };
inline constexpr std::size_t kLamps = 5;

// Of a lamp that does not shine, by day.
Colour ColourOf(Lamp lamp);
// How bright each lamp is, as a share of its colour, at a time of the simulation; 0: it does not shine. Indicators
// flash 1.5 times a second, all in step, the brighter half first. `dark`: people have their headlights on.
std::array<float, kLamps> GlowsOf(const CarLights& lights, bool dark, std::int64_t time_ns);

}  // namespace rodeira::scene
