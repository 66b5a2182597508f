#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "nodes/editor/panels.hpp"

namespace rodeira::desk {

const char* const kBorderNames[map::kBorderTypes] = {"None", "Boundary", "Single", "Dashed", "DashedSame", "DashedSpeedCtrl", "DashedWarn", "DoubleDashed"};
const char* const kModeNames[3] = {"none", "start", "end"};

void Note(Work& work, const std::string& name) {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  work.places[name] = 0.5 * Eigen::Vector2d(static_cast<double>(low.x + high.x), static_cast<double>(low.y + high.y));
}

void DrawSide(Work& work, const std::vector<std::pair<std::int32_t, std::int32_t>>& proposals, float top, float width, float height) {
  ImGui::SetNextWindowPos(ImVec2(0.0f, top));
  ImGui::SetNextWindowSize(ImVec2(width, height));
  ImGui::Begin("side", nullptr, ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoBringToFrontOnFocus);
  const ImVec2 half(0.5f * (width - 24.0f), 0.0f);
  if (ImGui::Button("New Curve", half)) NewCurve(work);
  ImGui::SameLine();
  if (ImGui::Button("New Lane", half)) work.lane_form = {}, work.Open(Form::kLane);
  if (ImGui::Button("New Connection", half)) work.connection_form = {}, work.Open(Form::kConnection);
  ImGui::SameLine();
  if (ImGui::Button(work.tool == Tool::kLane ? "Lane along …" : "Lane along a line", half)) work.tool = work.tool == Tool::kLane ? Tool::kChoose : Tool::kLane;
  if (work.tool == Tool::kLane) {
    float lane_width = static_cast<float>(work.look.width_m);
    if (ImGui::InputFloat("width, m", &lane_width, 0.25f, 1.0f, "%.2f")) work.look.width_m = static_cast<double>(lane_width);
    int mode = static_cast<int>(work.look.mode);
    if (ImGui::Combo("mode", &mode, kModeNames, 3)) work.look.mode = static_cast<map::LaneMode>(mode);
  }
  if (!proposals.empty() && ImGui::Button(fmt::format("Connect where ends meet ({})", proposals.size()).c_str(), ImVec2(-1.0f, 0.0f))) ProposeConnections(work);
  if (ImGui::CollapsingHeader("Background", ImGuiTreeNodeFlags_DefaultOpen)) DrawBackgroundPanel(work);
  if (ImGui::CollapsingHeader("Chosen", ImGuiTreeNodeFlags_DefaultOpen)) DrawChosenPanel(work), DrawBesidePanel(work);
  if (ImGui::CollapsingHeader("Traffic", ImGuiTreeNodeFlags_DefaultOpen)) DrawTrafficPanel(work);
  if (ImGui::CollapsingHeader("Manage lanes and connections")) DrawLists(work);
  if (ImGui::CollapsingHeader("Traffic lights")) DrawLightsPanel(work);
  ImGui::End();
}

void DrawBackgroundPanel(Work& work) {
  if (ImGui::Button("Import Background")) AskToImport(work);
  float scale = work.session.document().map.scale.value.value;
  ImGui::SetNextItemWidth(120.0f);
  const bool scaled = ImGui::InputFloat("Background Scale", &scale, 0.0f, 0.0f, "%g", ImGuiInputTextFlags_EnterReturnsTrue);
  Note(work, "scale");
  if (scaled)
    work.session.Do([&](editor::Document& document) { return editor::SetScale(document, scale); });
  if (const auto& picture = work.picture.picture()) {
    const double height_m = 10.0 * static_cast<double>(scale);
    ImGui::Text("%.1f m by %.1f m", height_m * picture->level(0).width_px / picture->level(0).height_px, height_m);
  }
}

void DrawLists(Work& work) {
  editor::Selection gone;
  ImGui::BeginChild("lanes", ImVec2(0.0f, 110.0f), true);
  for (const auto& line : work.session.document().map.lanes) {
    ImGui::PushID(line.value.id);
    if (ImGui::SmallButton("Delete")) gone.lanes.insert(line.value.id);
    ImGui::SameLine();
    const std::string text = fmt::format("lane {}: {}, {} ({})", line.value.id, line.value.left.curve, line.value.right.curve, kModeNames[static_cast<int>(line.value.mode)]);
    if (ImGui::Selectable(text.c_str(), work.session.selection.lanes.contains(line.value.id))) work.session.selection = {{}, {}, {line.value.id}, {}};
    ImGui::PopID();
  }
  ImGui::EndChild();
  ImGui::BeginChild("connections", ImVec2(0.0f, 110.0f), true);
  for (const auto& line : work.session.document().map.connections) {
    const std::pair pair(line.value.from, line.value.to);
    ImGui::PushID(line.value.from);
    ImGui::PushID(line.value.to);
    if (ImGui::SmallButton("Delete")) gone.connections.insert(pair);
    ImGui::SameLine();
    const std::string text = fmt::format("{} to {}{}", pair.first, pair.second, line.value.stop ? ", STOP" : "");
    if (ImGui::Selectable(text.c_str(), work.session.selection.connections.contains(pair))) work.session.selection = {{}, {}, {}, {pair}};
    ImGui::PopID();
    ImGui::PopID();
  }
  ImGui::EndChild();
  if (!gone.empty()) work.session.Do([&](editor::Document& document) { return editor::Remove(document, gone); });
}

void DrawTrafficPanel(Work& work) {
  Traffic& traffic = work.traffic;
  if (ImGui::Button(traffic.runs ? "Pause" : "Run")) RunOrPause(work);
  ImGui::SameLine();
  if (ImGui::Button("Stop")) StopTraffic(work);
  ImGui::SameLine();
  ImGui::Checkbox("heat map", &work.heat);
  ImGui::SetNextItemWidth(120.0f);
  if (ImGui::InputInt("vehicles", &traffic.vehicles)) traffic.vehicles = std::clamp(traffic.vehicles, 1, 2000);
  ImGui::SetNextItemWidth(120.0f);
  ImGui::SliderFloat("times real time", &traffic.pace, 0.1f, 20.0f, "%.1f", ImGuiSliderFlags_Logarithmic);
  if (!traffic.preview) return;
  const auto& statistics = traffic.preview->statistics();
  ImGui::Text("%.1f s, %zu on the road, %lld came, %lld left", traffic.preview->time_s(), traffic.preview->model().on_road(), static_cast<long long>(statistics.entered()), static_cast<long long>(statistics.left()));
  if (traffic.of_state != work.session.state()) ImGui::TextColored(ImVec4(1.0f, 0.8f, 0.3f, 1.0f), "the map was edited: Run begins anew");
}

void DrawStatus(const Work& work, float top, float width, float height) {
  ImGui::SetNextWindowPos(ImVec2(0.0f, top));
  ImGui::SetNextWindowSize(ImVec2(width, height));
  ImGui::Begin("status", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoBringToFrontOnFocus);
  const auto& said = work.session.said();
  ImGui::TextColored(said.good ? ImVec4(0.45f, 0.9f, 0.45f, 1.0f) : ImVec4(1.0f, 0.45f, 0.4f, 1.0f), "%s", said.text.c_str());
  ImGui::SameLine(width - 420.0f);
  ImGui::Text("visible width %.1f m", work.view.width_m());
  ImGui::SameLine(width - 230.0f);
  if (work.picture.loading()) ImGui::ProgressBar(static_cast<float>(work.picture.share()), ImVec2(210.0f, 0.0f), "background");
  else ImGui::Text("%zu curves, %zu lanes%s", work.session.document().map.curves.size(), work.session.document().map.lanes.size(), work.session.unsaved() ? " *" : "");
  ImGui::End();
}

}  // namespace rodeira::desk
