// SPDX-License-Identifier: Apache-2.0
// What is written and drawn over the map: numbers, the centre, what the hand is doing.
#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>

#include "nodes/editor/canvas.hpp"

namespace rodeira::nodes {

using editor::Document;

void Canvas::DrawOver(Work& work) const {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.PushClipRect(ImVec2(area_.left, area_.top), ImVec2(area_.left + area_.width, area_.top + area_.height));
  if (work.numbers) DrawNumbers(work);
  if (work.centre) {
    const float x = area_.left + 0.5f * area_.width, y = area_.top + 0.5f * area_.height;
    list.AddLine(ImVec2(x - 10.0f, y), ImVec2(x + 10.0f, y), IM_COL32(255, 255, 255, 200));
    list.AddLine(ImVec2(x, y - 10.0f), ImVec2(x, y + 10.0f), IM_COL32(255, 255, 255, 200));
  }
  DrawGesture(work);
  list.PopClipRect();
}

void Canvas::DrawNumbers(const Work& work) const {
  constexpr int kMost = 500;  // more cannot be read
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const Document& document = work.session.document();
  int count = 0;
  const auto write = [&](const Eigen::Vector2d& p_W, std::int32_t number, ImU32 colour) {
    const Eigen::Vector2d at = Screen(work, p_W);
    const bool seen = at.x() > static_cast<double>(area_.left) && at.y() > static_cast<double>(area_.top) &&
                      at.x() < static_cast<double>(area_.left + area_.width) &&
                      at.y() < static_cast<double>(area_.top + area_.height);
    if (!seen || ++count > kMost) return;
    const std::string text = std::to_string(number);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const ImVec2 corner(static_cast<float>(at.x()) - 0.5f * size.x, static_cast<float>(at.y()) - 0.5f * size.y);
    list.AddRectFilled(ImVec2(corner.x - 2.0f, corner.y), ImVec2(corner.x + size.x + 2.0f, corner.y + size.y),
                       IM_COL32(0, 0, 0, 150), 2.0f);
    list.AddText(corner, colour, text.c_str());
  };
  if (work.view.metres_per_px > 1.0) return;
  const traffic_map::NumberIndex curves(document.map.curves);
  for (const auto& line : document.map.lanes) {
    const auto left = curves.Find(line.value.left.curve), right = curves.Find(line.value.right.curve);
    if (!left || !right) continue;
    const Eigen::Vector2d a = traffic_map::BorderOf(line.value.left, document.map.curves[*left].value, {}).plan.At(0.5),
                          b = traffic_map::BorderOf(line.value.right, document.map.curves[*right].value, {})
                                  .plan.At(0.5);
    write(0.5 * (a + b), line.value.id, IM_COL32(140, 220, 255, 255));
  }
  for (const auto& line : document.map.curves)
    write(editor::CubicOf(line.value).At(0.4), line.value.id, IM_COL32(255, 235, 140, 255));
}

void Canvas::DrawGesture(const Work& work) const {
  if (hold_ != Hold::kRectangle && hold_ != Hold::kTool) return;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const Eigen::Vector2d from = Screen(work, pressed_W_);
  const ImVec2 a(static_cast<float>(from.x()), static_cast<float>(from.y())), b = ImGui::GetIO().MousePos;
  constexpr ImU32 kInk = IM_COL32(255, 235, 60, 255);
  if (hold_ == Hold::kRectangle) {
    list.AddRect(a, b, kInk);
    return;
  }
  if (work.tool != Tool::kLane) {
    list.AddLine(a, b, kInk, 2.0f);
    return;
  }
  const Eigen::Vector2d to_W =
      work.view.ToWorld({static_cast<double>(b.x - area_.left), static_cast<double>(b.y - area_.top)});
  const traffic_map::Cubic middle{editor::MiddleBetween(work.session.document(), pressed_W_, to_W,
                                                        work.snap ? kSnap_px * work.view.metres_per_px : 0.0)};
  std::array<ImVec2, 4> p;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Eigen::Vector2d at = Screen(work, middle.p_W[i]);
    p[i] = ImVec2(static_cast<float>(at.x()), static_cast<float>(at.y()));
  }
  list.AddBezierCubic(p[0], p[1], p[2], p[3], kInk,
                      static_cast<float>(std::max(2.0, work.look.width_m / work.view.metres_per_px)) * 0.5f);
}

}  // namespace rodeira::nodes
