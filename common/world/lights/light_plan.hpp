// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/config/config.hpp"
#include "common/world/network/lights.hpp"

namespace rodeira::lights {

// What is green in a phase: the names mean what the file says (roads, lanes).
struct Phase {
  std::vector<std::string> green;
  double green_s = 20.0;
  std::string place;  // "file:line"
};

// The lights of one junction as a person writes them: phases one after the other, each with its green; between two of
// them amber and red for all. What is green in a phase and in the next one stays green between them.
struct LightPlan {
  double offset_s = 0.0;  // when the first phase begins
  double amber_s = 3.0;
  double all_red_s = 2.0;
  double red_amber_s = 1.0;
  std::vector<Phase> phases;

  double cycle_s() const;
  std::vector<std::string> Names() const;  // each once, in the order of the phases
};

// Reads a mapping of the keys LightPlanKeys. A name that is
// green, waits, and is green again in one cycle is a problem, as is a red with amber longer than amber and red for all.
LightPlan ReadLightPlan(const config::Map& map);

// Where the first phase in which a name is green is written down, "file:line"; empty where it is in no phase.
std::string PlaceOf(const LightPlan& plan, std::string_view name);

// When a name is green; nothing where it is in no phase.
std::optional<network::LightTimes> TimesOf(const LightPlan& plan, std::string_view name);

}  // namespace rodeira::lights
