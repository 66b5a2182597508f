#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <set>

#include "nodes/editor/panels.hpp"

namespace rodeira::desk {
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

bool PhaseFields(lights::LightPlan& plan, std::size_t number, const std::set<std::int32_t>& chosen) {
  lights::Phase& phase = plan.phases[number];
  ImGui::PushID(static_cast<int>(number));
  ImGui::SetNextItemWidth(60.0f);
  bool changed = ImGui::InputDouble("s", &phase.green_s, 0.0, 0.0, "%.0f", ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::SameLine();
  ImGui::Text("green: %s", fmt::format("{}", fmt::join(phase.green, " ")).c_str());
  ImGui::SameLine();
  if (ImGui::SmallButton("chosen lanes")) {
    phase.green.clear();
    for (const std::int32_t lane : chosen) phase.green.push_back(std::to_string(lane));
    changed = true;
  }
  ImGui::SameLine();
  if (ImGui::SmallButton("x") && plan.phases.size() > 1) plan.phases.erase(plan.phases.begin() + static_cast<std::ptrdiff_t>(number)), changed = true;
  ImGui::PopID();
  return changed;
}

bool TimeFields(lights::LightPlan& plan) {
  bool changed = false;
  const auto field = [&changed](const char* name, double& value, bool beside) {
    if (beside) ImGui::SameLine();
    ImGui::SetNextItemWidth(45.0f);
    changed |= ImGui::InputDouble(name, &value, 0.0, 0.0, "%g", ImGuiInputTextFlags_EnterReturnsTrue);
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
    if (ImGui::SmallButton("Delete")) {
      plans.erase(plans.begin() + static_cast<std::ptrdiff_t>(i));
      changed = true;
    }
    changed = changed || TimeFields(plans[i]);
    for (std::size_t phase = 0; !changed && phase < plans[i].phases.size(); ++phase) changed = PhaseFields(plans[i], phase, chosen);
    if (!changed && ImGui::SmallButton("Add a phase")) plans[i].phases.emplace_back(), changed = true;
    ImGui::PopID();
  }
  if (chosen.empty()) ImGui::TextDisabled("choose lanes to give them lights");
  else if (ImGui::SmallButton("New lights, chosen lanes first")) plans = WithNewLights(plans, chosen), changed = true;
  if (changed) work.session.Do([&](editor::Document& document) { return editor::SetLights(document, plans); });
}

}  // namespace rodeira::desk
