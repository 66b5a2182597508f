// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <set>

#include "nodes/editor/panels.hpp"

namespace rodeira::nodes {
namespace {

using Plans = std::vector<lights::LightPlan>;

// A light goes to the first phase of new lights where it has none yet.
Plans WithNewLights(const Plans& plans, const std::set<std::int32_t>& lanes) {
  Plans more = plans;
  lights::LightPlan plan;
  lights::Phase phase;
  for (const std::int32_t lane : lanes) phase.green.push_back(std::to_string(lane));
  plan.phases = {phase, lights::Phase{}};
  more.push_back(plan);
  return more;
}

bool PhaseFields(Work& work, const std::string& of, lights::LightPlan& plan, std::size_t number) {
  lights::Phase& phase = plan.phases[number];
  const std::string name = fmt::format("{} phase {}", of, number + 1);
  ImGui::PushID(static_cast<int>(number));
  bool changed = Number(work, name, "s", phase.green_s, "%.0f", 60.0f);
  ImGui::SameLine();
  ImGui::Text("green: %s", fmt::format("{}", fmt::join(phase.green, " ")).c_str());
  ImGui::SameLine();
  if (SmallButton(work, name + " chosen", "chosen lanes")) {
    phase.green.clear();
    for (const std::int32_t lane : work.session.selection.lanes) phase.green.push_back(std::to_string(lane));
    changed = true;
  }
  ImGui::SameLine();
  if (SmallButton(work, "delete " + name, "x") && plan.phases.size() > 1)
    plan.phases.erase(plan.phases.begin() + static_cast<std::ptrdiff_t>(number)), changed = true;
  ImGui::PopID();
  return changed;
}

bool TimeFields(Work& work, const std::string& of, lights::LightPlan& plan) {
  bool changed = false;
  const auto field = [&](const char* name, double& value, bool beside) {
    if (beside) ImGui::SameLine();
    changed |= Number(work, of + " " + name, name, value, "%g", 45.0f);
  };
  field("offset, s", plan.offset_s, false);
  field("amber, s", plan.amber_s, true);
  field("all red, s", plan.all_red_s, false);
  field("red and amber, s", plan.red_amber_s, true);
  return changed;
}

}  // namespace

void DrawLightsPanel(Work& work) {
  Plans plans = work.session.document().companion.lights;
  bool changed = false;
  const std::set<std::int32_t>& chosen = work.session.selection.lanes;
  for (std::size_t i = 0; i < plans.size() && !changed; ++i) {
    ImGui::PushID(static_cast<int>(i));
    ImGui::Text("lights %zu, cycle %.0f s", i + 1, plans[i].cycle_s());
    ImGui::SameLine();
    const std::string name = fmt::format("lights {}", i + 1);
    if (SmallButton(work, "delete " + name, "Delete")) {
      plans.erase(plans.begin() + static_cast<std::ptrdiff_t>(i));
      changed = true;
    }
    changed = changed || TimeFields(work, name, plans[i]);
    for (std::size_t phase = 0; !changed && phase < plans[i].phases.size(); ++phase)
      changed = PhaseFields(work, name, plans[i], phase);
    if (!changed && SmallButton(work, name + " add phase", "Add a phase"))
      plans[i].phases.emplace_back(), changed = true;
    ImGui::PopID();
  }
  if (chosen.empty())
    ImGui::TextDisabled("choose lanes to give them lights");
  else if (SmallButton(work, "new lights", "New lights, chosen lanes first"))
    plans = WithNewLights(plans, chosen), changed = true;
  if (changed) work.session.Do([&](editor::Document& document) { return editor::SetLights(document, plans); });
}

}  // namespace rodeira::nodes
