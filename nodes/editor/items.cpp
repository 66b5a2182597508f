// SPDX-License-Identifier: Apache-2.0
#include "nodes/editor/items.hpp"

namespace rodeira::nodes {

void Note(Work& work, const std::string& name) {
  if (!ImGui::IsItemVisible()) return;
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  work.places[name] = 0.5 * Eigen::Vector2d(static_cast<double>(low.x + high.x), static_cast<double>(low.y + high.y));
}

bool Button(Work& work, const std::string& name, const char* label, const ImVec2& size) {
  const bool pressed = ImGui::Button(label, size);
  Note(work, name);
  return pressed;
}

bool SmallButton(Work& work, const std::string& name, const char* label) {
  const bool pressed = ImGui::SmallButton(label);
  Note(work, name);
  return pressed;
}

bool Tick(Work& work, const std::string& name, const char* label, bool& value) {
  const bool pressed = ImGui::Checkbox(label, &value);
  Note(work, name);
  return pressed;
}

bool Listed(Work& work, const std::string& name, const std::string& text, bool chosen) {
  const bool pressed = ImGui::Selectable(text.c_str(), chosen);
  Note(work, name);
  return pressed;
}

bool Heading(Work& work, const char* label, bool open_at_first) {
  const bool open =
      ImGui::CollapsingHeader(label, open_at_first ? ImGuiTreeNodeFlags_DefaultOpen : ImGuiTreeNodeFlags_None);
  Note(work, label);
  return open;
}

bool OneOf(Work& work, const std::string& name, const char* label, int& value, std::span<const char* const> names,
           float width_px) {
  ImGui::SetNextItemWidth(width_px);
  const bool open = ImGui::BeginCombo(label, names[static_cast<std::size_t>(value)]);
  if (!open) {
    Note(work, name);
    return false;
  }
  bool changed = false;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool is = static_cast<int>(i) == value;
    if (Listed(work, name + ": " + names[i], names[i], is) && !is) value = static_cast<int>(i), changed = true;
  }
  ImGui::EndCombo();
  return changed;
}

bool Number(Work& work, const std::string& name, const char* label, double& value, const char* format, float width_px) {
  // Tab leaves a field between two pictures: what was written is remembered until the field is drawn again.
  constexpr int kRemembered = 2;  // pictures
  const int now = ImGui::GetFrameCount();
  const auto entry = work.written.find(name);
  const bool written = entry != work.written.end() && entry->second.picture >= now - kRemembered;
  double shown = written ? entry->second.value : value;
  ImGui::SetNextItemWidth(width_px);
  ImGui::InputDouble(("##" + name).c_str(), &shown, 0.0, 0.0, format);
  Note(work, name);
  const bool active = ImGui::IsItemActive();
  if (active)
    work.written[name] = {shown, now};
  else if (entry != work.written.end())
    work.written.erase(entry);
  const bool changed =
      written && !active && shown != value && !ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
  if (changed) value = shown;
  if (*label != '\0') {
    ImGui::SameLine(0.0f, ImGui::GetStyle().ItemInnerSpacing.x);
    ImGui::TextUnformatted(label);
  }
  return changed;
}

}  // namespace rodeira::nodes
