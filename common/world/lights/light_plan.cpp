// SPDX-License-Identifier: Apache-2.0
#include "common/world/lights/light_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/core/config/declared.hpp"
#include "common/world/lights/light_schema.hpp"

namespace rodeira::lights {
namespace {

bool IsGreen(const Phase& phase, std::string_view name) {
  return std::find(phase.green.begin(), phase.green.end(), name) != phase.green.end();
}

// How often a name becomes green in a cycle.
std::size_t Begins(const LightPlan& plan, std::string_view name) {
  std::size_t begins = 0;
  for (std::size_t i = 0; i < plan.phases.size(); ++i) {
    const Phase& before = plan.phases[(i + plan.phases.size() - 1) % plan.phases.size()];
    if (IsGreen(plan.phases[i], name) && !IsGreen(before, name)) ++begins;
  }
  return begins;
}

}  // namespace

double LightPlan::cycle_s() const {
  double cycle = 0.0;
  for (const Phase& phase : phases) cycle += phase.green_s + amber_s + all_red_s;
  return cycle;
}

std::vector<std::string> LightPlan::Names() const {
  std::vector<std::string> names;
  for (const Phase& phase : phases) {
    for (const std::string& name : phase.green) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

LightPlan ReadLightPlan(const config::Map& map) {
  const config::DeclaredMap keys(map, LightPlanKeys());
  LightPlan plan;
  plan.offset_s = keys.Number("offset_s");
  plan.amber_s = keys.Number("amber_s");
  plan.all_red_s = keys.Number("all_red_s");
  plan.red_amber_s = keys.Number("red_amber_s");
  if (plan.red_amber_s > plan.amber_s + plan.all_red_s)
    map.Problem("red_amber_s", "config.wrong_order", "'red_amber_s' is longer than 'amber_s' and 'all_red_s' together");
  const config::DeclaredList phases = keys.Items("phases");
  for (std::size_t i = 0; i < phases.size(); ++i) {
    const config::DeclaredMap item = phases.At(i);
    Phase phase;
    phase.place = item.map().Place();
    phase.green_s = item.Number("for_s");
    const config::DeclaredList green = item.Items("green");
    for (std::size_t k = 0; k < green.size(); ++k) {
      phase.green.push_back(green.Text(k));
      if (std::count(phase.green.begin(), phase.green.end(), phase.green.back()) > 1)
        green.list().Problem(k, "config.duplicate_name", fmt::format("'{}' is named twice", phase.green.back()));
    }
    plan.phases.push_back(std::move(phase));
  }
  if (plan.phases.empty() && map.Has("phases"))
    map.Problem("phases", "config.too_few", "'phases' is empty; one or more were expected");
  for (const std::string& name : plan.Names()) {
    if (Begins(plan, name) > 1)
      map.Problem(
          "phases",
          fmt::format("'{}' becomes green more than once in a cycle; put its phases one after the other", name));
  }
  return plan;
}

std::string PlaceOf(const LightPlan& plan, std::string_view name) {
  for (const Phase& phase : plan.phases) {
    if (IsGreen(phase, name)) return phase.place;
  }
  return "";
}

std::optional<network::LightTimes> TimesOf(const LightPlan& plan, std::string_view name) {
  const std::size_t count = plan.phases.size();
  std::size_t greens = 0, first = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!IsGreen(plan.phases[i], name)) continue;
    ++greens;
    if (!IsGreen(plan.phases[(i + count - 1) % count], name)) first = i;
  }
  if (greens == 0) return std::nullopt;
  network::LightTimes times;
  times.cycle_s = plan.cycle_s();
  times.amber_s = plan.amber_s;
  times.red_amber_s = plan.red_amber_s;
  if (greens == count) {
    times.green_s = times.cycle_s;
    return times;
  }
  double from = plan.offset_s;
  for (std::size_t i = 0; i < first; ++i) from += plan.phases[i].green_s + plan.amber_s + plan.all_red_s;
  times.green_from_s = std::fmod(from, times.cycle_s);
  for (std::size_t i = first; IsGreen(plan.phases[i % count], name); ++i) {
    if (i > first) times.green_s += plan.amber_s + plan.all_red_s;
    times.green_s += plan.phases[i % count].green_s;
  }
  return times;
}

}  // namespace rodeira::lights
