// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "common/world/network/lights.hpp"
#include "common/world/sumo/read_net.hpp"

namespace rodeira::sumo {

// A light's times by the letters of the program's phases. G and g are green, y is amber, u is red with amber; r and s
// (green after a stop) are red; o and O (off, blinking) are off where no phase says more, and green elsewhere.
// `held`: by phase, whether the light is red there although it is green in the program; empty: in none. Nothing: the
// light is off.
std::optional<network::LightTimes> TimesOf(const LightProgram& program, int light, const std::vector<bool>& held = {});

// Whether a light is green in a phase; it yields or not.
bool IsGreen(const LightProgram& program, std::size_t phase, int light);
// Whether it is green and has to yield (g).
bool IsYieldingGreen(const LightProgram& program, std::size_t phase, int light);

// The program has times that Rodeira follows: phases, a cycle of 1 to 3600 s.
bool HasTimes(const LightProgram& program);

}  // namespace rodeira::sumo
