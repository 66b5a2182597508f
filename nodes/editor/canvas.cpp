// SPDX-License-Identifier: Apache-2.0
#include "nodes/editor/canvas.hpp"

#include <SDL.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace rodeira::nodes {
namespace {

constexpr double kTremble_px = 3.0;  // a click may move so far
constexpr double kNotch = 1.2;       // of the wheel
constexpr double kPan_pxps = 600.0;  // by keys

}  // namespace

Eigen::Vector2d Canvas::Screen(const Work& work, const Eigen::Vector2d& p_W) const {
  return work.view.ToPixels(p_W) + Eigen::Vector2d(static_cast<double>(area_.left), static_cast<double>(area_.top));
}

void Canvas::Draw(Work& work, const Area& area, int window_height_px) {
  area_ = area;
  work.view.width_px = static_cast<double>(std::max(area.width, 1.0f));
  work.view.height_px = static_cast<double>(std::max(area.height, 1.0f));
  TakeMouse(work);
  TakeKeys(work);
  const int left = static_cast<int>(area.left), below = window_height_px - static_cast<int>(area.top + area.height);
  const editor::Document& document = work.session.document();
  pictures_.Draw(work.picture.picture(), 10.0 * static_cast<double>(document.map.scale.value.value), work.view, left,
                 below);
  map_.Begin(work.view, left, below);
  map_.DrawMap(document, work.session.state(), work.handles);
  if (work.heat) map_.DrawHeat(work.traffic.heat);
  if (work.traffic.preview) map_.DrawVehicles(work.traffic.preview->model());
  map_.DrawProposals(document, work.session.state());
  map_.DrawChosen(document, work.session.selection);
  DrawOver(work);
}

void Canvas::TakeMouse(Work& work) {
  const ImGuiIO& io = ImGui::GetIO();
  const Eigen::Vector2d px(static_cast<double>(io.MousePos.x - area_.left),
                           static_cast<double>(io.MousePos.y - area_.top));
  const bool over = px.x() >= 0.0 && px.y() >= 0.0 && px.x() < work.view.width_px && px.y() < work.view.height_px &&
                    !io.WantCaptureMouse;
  if (over && io.MouseWheel != 0.0f) work.view.Zoom(std::pow(kNotch, static_cast<double>(io.MouseWheel)), px);
  for (const int button : {1, 2}) {
    if (ImGui::IsMouseDragging(button, 0.0f) && !io.WantCaptureMouse)
      work.view.Drag({static_cast<double>(io.MouseDelta.x), static_cast<double>(io.MouseDelta.y)});
  }
  if (over && ImGui::IsMouseClicked(0)) Press(work, px);
  if (hold_ == Hold::kNone) return;
  if ((px - pressed_px_).norm() > kTremble_px) moved_ = true;
  if (hold_ == Hold::kPan && moved_) work.view.Go(pressed_W_ - work.view.ToWorld(px));
  if (hold_ == Hold::kHandles && moved_) DragHandles(work, px);
  if (!io.MouseDown[0]) Release(work, px);
}

void Canvas::TakeKeys(Work& work) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantTextInput || io.KeyCtrl || io.KeyAlt || work.form != Form::kNone || work.files.open()) return;
  const double step_m = kPan_pxps * work.view.metres_per_px * static_cast<double>(std::min(io.DeltaTime, 0.1f));
  const auto held = [&](int key) { return io.KeysDown[key] ? 1.0 : 0.0; };
  work.view.Go(
      {step_m * (held(SDL_SCANCODE_D) - held(SDL_SCANCODE_A)), step_m * (held(SDL_SCANCODE_W) - held(SDL_SCANCODE_S))});
}

}  // namespace rodeira::nodes
