// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cfloat>

#include "nodes/editor/panels.hpp"

namespace rodeira::nodes {
namespace {

using editor::Document;

bool LaneSideFields(Work& work, const std::string& name, traffic_map::LaneSide& side) {
  ImGui::PushID(name.c_str());
  int type = static_cast<int>(side.type);
  ImGui::AlignTextToFramePadding();
  ImGui::Text("%s curve %d", name.c_str(), side.curve);
  ImGui::SameLine();
  bool changed = Tick(work, name + " inverted", "inverted", side.inverted);
  if (OneOf(work, name + " border", "border", type, kBorderNames, 150.0f))
    side.type = static_cast<traffic_map::BorderType>(type), changed = true;
  ImGui::PopID();
  return changed;
}

void DrawLane(Work& work, std::int32_t number) {
  const auto at = editor::Find(work.session.document().map.lanes, number);
  if (!at) return;
  traffic_map::Lane lane = work.session.document().map.lanes[*at].value;
  ImGui::Text("lane %d", number);
  bool changed = LaneSideFields(work, "left", lane.left);
  changed |= LaneSideFields(work, "right", lane.right);
  int mode = static_cast<int>(lane.mode);
  if (OneOf(work, "mode", "mode", mode, kModeNames, 150.0f))
    lane.mode = static_cast<traffic_map::LaneMode>(mode), changed = true;
  if (changed) work.session.Do([&](Document& document) { return editor::SetLane(document, lane); });
}

void DrawConnection(Work& work, const std::pair<std::int32_t, std::int32_t>& pair) {
  const auto at = editor::Find(work.session.document().map.connections, pair.first, pair.second);
  if (!at) return;
  bool stop = work.session.document().map.connections[*at].value.stop;
  ImGui::AlignTextToFramePadding();
  ImGui::Text("connection %d to %d", pair.first, pair.second);
  ImGui::SameLine();
  if (Tick(work, "STOP", "STOP", stop))
    work.session.Do([&](Document& document) { return editor::SetStop(document, pair.first, pair.second, stop); });
}

// Heights at the four handles, and a drawing of them along the curve.
void DrawHeights(Work& work, std::int32_t curve) {
  std::array<double, 4> z_m = work.session.document().companion.Of(curve);
  bool changed = false;
  for (std::size_t i = 0; i < z_m.size(); ++i) {
    const std::string name = fmt::format("height {}", i + 1);
    changed |= Number(work, name, i + 1 < z_m.size() ? "" : "heights, m", z_m[i], "%.2f", 48.0f);
    if (i + 1 < z_m.size()) ImGui::SameLine(0.0f, 3.0f);
  }
  if (changed) work.session.Do([&](Document& document) { return editor::SetHeights(document, curve, z_m); });
  std::array<float, 33> profile{};
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(profile.size() - 1), u = 1.0 - t;
    profile[i] = static_cast<float>(u * u * u * z_m[0] + 3.0 * u * u * t * z_m[1] + 3.0 * u * t * t * z_m[2] +
                                    t * t * t * z_m[3]);
  }
  ImGui::PlotLines("profile", profile.data(), static_cast<int>(profile.size()), 0, nullptr, FLT_MAX, FLT_MAX,
                   ImVec2(0.0f, 50.0f));
  Note(work, "profile");
}

void DrawSigns(Work& work, std::int32_t lane) {
  constexpr const char* kKinds[traffic_map::kSignKinds] = {"STOP", "give way", "priority", "speed limit"};
  std::vector<traffic_map::LaneSign> signs = work.session.document().companion.signs;
  bool changed = false;
  int number = 0;  // among this lane's
  for (std::size_t i = 0; i < signs.size() && !changed; ++i) {
    if (signs[i].lane != lane) continue;
    ImGui::PushID(static_cast<int>(i));
    int kind = static_cast<int>(signs[i].kind);
    const std::string name = fmt::format("sign {}", ++number);
    if (OneOf(work, name, "##kind", kind, kKinds, 100.0f)) {
      signs[i].kind = static_cast<traffic_map::SignKind>(kind);
      if (signs[i].kind == traffic_map::SignKind::kSpeedLimit && signs[i].limit_kmh == 0.0) signs[i].limit_kmh = 30.0;
      changed = true;
    }
    if (signs[i].kind == traffic_map::SignKind::kSpeedLimit) {
      ImGui::SameLine();
      changed |= Number(work, name + " limit", "km/h", signs[i].limit_kmh, "%.0f", 60.0f);
    }
    ImGui::SameLine();
    if (SmallButton(work, "delete " + name, "Delete"))
      signs.erase(signs.begin() + static_cast<std::ptrdiff_t>(i)), changed = true;
    ImGui::PopID();
  }
  if (SmallButton(work, "add sign", "Add a sign at its end"))
    signs.push_back({lane, traffic_map::SignKind::kGiveWay, 0.0, 0.0, 0}), changed = true;
  if (changed) work.session.Do([&](Document& document) { return editor::SetSigns(document, signs); });
}

void DrawFlow(Work& work, std::int32_t lane) {
  const auto& flows = work.session.document().companion.flows;
  const auto at =
      std::find_if(flows.begin(), flows.end(), [lane](const traffic_map::LaneFlow& flow) { return flow.lane == lane; });
  double vehph = at != flows.end() ? at->vehph : 0.0;
  if (Number(work, "flow", "vehicles an hour", vehph, "%.0f", 100.0f))
    work.session.Do([&](Document& document) { return editor::SetFlow(document, lane, vehph); });
}

}  // namespace

void DrawChosenPanel(Work& work) {
  const editor::Selection chosen = work.session.selection;
  if (chosen.empty()) {
    ImGui::TextDisabled("nothing");
    return;
  }
  if (chosen.lanes.size() == 1) DrawLane(work, *chosen.lanes.begin());
  if (chosen.connections.size() == 1) DrawConnection(work, *chosen.connections.begin());
  if (chosen.curves.size() == 1) ImGui::Text("curve %d", *chosen.curves.begin());
  if (chosen.curves.size() + chosen.lanes.size() + chosen.connections.size() > 1)
    ImGui::Text("%zu curves, %zu lanes, %zu connections", chosen.curves.size(), chosen.lanes.size(),
                chosen.connections.size());
  if (Button(work, "delete chosen", "Delete")) DeleteChosen(work);
}

void DrawBesidePanel(Work& work) {
  const editor::Selection chosen = work.session.selection;
  if (chosen.curves.size() == 1 && chosen.lanes.empty() &&
      editor::Find(work.session.document().map.curves, *chosen.curves.begin()))
    DrawHeights(work, *chosen.curves.begin());
  if (chosen.lanes.size() != 1) return;
  const std::int32_t number = *chosen.lanes.begin();
  const auto at = editor::Find(work.session.document().map.lanes, number);
  if (!at) return;
  DrawSigns(work, number);
  if (work.session.document().map.lanes[*at].value.mode == traffic_map::LaneMode::kStart) DrawFlow(work, number);
}

}  // namespace rodeira::nodes
