// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "nodes/editor/panels.hpp"

namespace rodeira::nodes {

const char* const kBorderNames[traffic_map::kBorderTypes] = {
    "None", "Boundary", "Single", "Dashed", "DashedSame", "DashedSpeedCtrl", "DashedWarn", "DoubleDashed"};
const char* const kModeNames[3] = {"none", "start", "end"};

namespace {

// Of lanes that are drawn along a line.
void DrawLaneLook(Work& work) {
  Number(work, "lane width", "width, m", work.look.width_m, "%.2f", 100.0f);
  int mode = static_cast<int>(work.look.mode);
  if (OneOf(work, "lane mode", "mode", mode, kModeNames, 100.0f))
    work.look.mode = static_cast<traffic_map::LaneMode>(mode);
}

// `rows` lines of a list, of which only those that are seen are drawn.
template <class Row>
void DrawList(const char* name, std::size_t rows, const Row& row) {
  ImGui::BeginChild(name, ImVec2(0.0f, 110.0f), true);
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(rows));
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      ImGui::PushID(i);
      row(static_cast<std::size_t>(i));
      ImGui::PopID();
    }
  }
  ImGui::EndChild();
}

}  // namespace

void DrawSide(Work& work, const std::vector<std::pair<std::int32_t, std::int32_t>>& proposals, float top, float width,
              float height) {
  ImGui::SetNextWindowPos(ImVec2(0.0f, top));
  ImGui::SetNextWindowSize(ImVec2(width, height));
  ImGui::Begin("side", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoBringToFrontOnFocus);
  const ImVec2 half(0.5f * (width - 24.0f), 0.0f);
  if (Button(work, "New Curve", "New Curve", half)) NewCurve(work);
  ImGui::SameLine();
  if (Button(work, "New Lane", "New Lane", half)) work.lane_form = {}, work.Open(Form::kLane);
  if (Button(work, "New Connection", "New Connection", half)) work.connection_form = {}, work.Open(Form::kConnection);
  ImGui::SameLine();
  if (Button(work, "Lane along a line", work.tool == Tool::kLane ? "Lane along …" : "Lane along a line", half))
    work.tool = work.tool == Tool::kLane ? Tool::kChoose : Tool::kLane;
  if (work.tool == Tool::kLane) DrawLaneLook(work);
  if (!proposals.empty() &&
      Button(work, "Connect", fmt::format("Connect where ends meet ({})###connect", proposals.size()).c_str(),
             ImVec2(-1.0f, 0.0f)))
    ProposeConnections(work);
  if (Heading(work, "Background", true)) DrawBackgroundPanel(work);
  if (Heading(work, "Chosen", true)) DrawChosenPanel(work), DrawBesidePanel(work);
  if (Heading(work, "Traffic", true)) DrawTrafficPanel(work);
  if (Heading(work, "Manage lanes and connections", false)) DrawLists(work);
  if (Heading(work, "Traffic lights", false)) DrawLightsPanel(work);
  ImGui::End();
}

void DrawBackgroundPanel(Work& work) {
  if (Button(work, "Import Background", "Import Background")) AskToImport(work);
  double scale = static_cast<double>(work.session.document().map.scale.value.value);
  if (Number(work, "scale", "Background Scale", scale, "%g", 120.0f))
    work.session.Do([&](editor::Document& document) { return editor::SetScale(document, static_cast<float>(scale)); });
  if (const auto& picture = work.picture.picture()) {
    const double height_m = 10.0 * scale;
    ImGui::Text("%.1f m by %.1f m", height_m * picture->width_px() / picture->height_px(), height_m);
  }
}

void DrawLists(Work& work) {
  editor::Selection gone;
  const traffic_map::MapFile& map = work.session.document().map;
  DrawList("lanes", map.lanes.size(), [&](std::size_t i) {
    const traffic_map::Lane& lane = map.lanes[i].value;
    const std::string name = fmt::format("lane {}", lane.id);
    if (SmallButton(work, "delete " + name, "Delete")) gone.lanes.insert(lane.id);
    ImGui::SameLine();
    const std::string text = fmt::format("{}: {}, {} ({})", name, lane.left.curve, lane.right.curve,
                                         kModeNames[static_cast<int>(lane.mode)]);
    if (Listed(work, name, text, work.session.selection.lanes.contains(lane.id)))
      work.session.selection = {{}, {}, {lane.id}, {}};
  });
  DrawList("connections", map.connections.size(), [&](std::size_t i) {
    const std::pair pair(map.connections[i].value.from, map.connections[i].value.to);
    const std::string name = fmt::format("{} to {}", pair.first, pair.second);
    if (SmallButton(work, "delete " + name, "Delete")) gone.connections.insert(pair);
    ImGui::SameLine();
    if (Listed(work, name, name + (map.connections[i].value.stop ? ", STOP" : ""),
               work.session.selection.connections.contains(pair)))
      work.session.selection = {{}, {}, {}, {pair}};
  });
  if (!gone.empty()) work.session.Do([&](editor::Document& document) { return editor::Remove(document, gone); });
}

void DrawTrafficPanel(Work& work) {
  Traffic& traffic = work.traffic;
  if (Button(work, "Run", traffic.runs ? "Pause###run" : "Run###run")) RunOrPause(work);
  ImGui::SameLine();
  if (Button(work, "Stop", "Stop")) StopTraffic(work);
  ImGui::SameLine();
  Tick(work, "heat map", "heat map", work.heat);
  double vehicles = traffic.vehicles;
  if (Number(work, "vehicles", "vehicles", vehicles, "%.0f", 120.0f))
    traffic.vehicles = static_cast<int>(std::clamp(vehicles, 1.0, 2000.0));
  ImGui::SetNextItemWidth(120.0f);
  ImGui::SliderFloat("times real time", &traffic.pace, 0.1f, 20.0f, "%.1f", ImGuiSliderFlags_Logarithmic);
  Note(work, "pace");
  if (!traffic.preview) return;
  const auto& statistics = traffic.preview->statistics();
  ImGui::Text("%.1f s, %zu on the road, %lld came, %lld left", traffic.preview->time_s(),
              traffic.preview->model().on_road(), static_cast<long long>(statistics.entered()),
              static_cast<long long>(statistics.left()));
  if (traffic.of_state != work.session.state())
    ImGui::TextColored(ImVec4(1.0f, 0.8f, 0.3f, 1.0f), "the map was edited: Run begins anew");
}

void DrawStatus(Work& work, float top, float width, float height) {
  ImGui::SetNextWindowPos(ImVec2(0.0f, top));
  ImGui::SetNextWindowSize(ImVec2(width, height));
  ImGui::Begin("status", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoBringToFrontOnFocus);
  const auto& said = work.session.said();
  ImGui::AlignTextToFramePadding();
  ImGui::PushClipRect(ImVec2(0.0f, top), ImVec2(width - 460.0f, top + height), true);
  ImGui::TextColored(said.good ? ImVec4(0.45f, 0.9f, 0.45f, 1.0f) : ImVec4(1.0f, 0.45f, 0.4f, 1.0f), "%s",
                     said.text.c_str());
  ImGui::PopClipRect();
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", said.text.c_str());
  ImGui::SameLine(width - 450.0f);
  double width_m = work.view.width_m();
  if (Number(work, "visible width", "m visible width", width_m, "%.1f", 80.0f)) work.view.ShowWidth(width_m);
  ImGui::SameLine(width - 230.0f);
  if (work.picture.loading())
    ImGui::ProgressBar(static_cast<float>(work.picture.share()), ImVec2(210.0f, 0.0f), "background");
  else
    ImGui::Text("%zu curves, %zu lanes%s", work.session.document().map.curves.size(),
                work.session.document().map.lanes.size(), work.session.unsaved() ? " *" : "");
  ImGui::End();
}

}  // namespace rodeira::nodes
