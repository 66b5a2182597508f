// SPDX-License-Identifier: Apache-2.0
// What the left button does on the canvas, from where it goes down to where it comes up.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "common/editor/snap.hpp"
#include "nodes/editor/canvas.hpp"

namespace rodeira::nodes {
namespace {

using editor::Document;

constexpr double kReach_px = 8.0;  // of the pointer

Eigen::Vector2d Position(const Document& document, const editor::Handle& handle) {
  return editor::CubicOf(document.map.curves[*editor::Find(document.map.curves, handle.curve)].value)
      .p_W[static_cast<std::size_t>(handle.index)];
}

}  // namespace

void Canvas::Press(Work& work, const Eigen::Vector2d& px) {
  const ImGuiIO& io = ImGui::GetIO();
  pressed_px_ = px;
  pressed_W_ = work.view.ToWorld(px);
  moved_ = edited_ = false;
  hold_ = Hold::kPan;
  if (work.tool != Tool::kChoose) {
    hold_ = Hold::kTool;
    return;
  }
  if (io.KeyShift) {
    hold_ = Hold::kRectangle;
    return;
  }
  const Document& document = work.session.document();
  const auto handle =
      work.handles ? editor::HandleAt(document, pressed_W_, kReach_px * work.view.metres_per_px) : std::nullopt;
  if (!handle) return;
  hold_ = Hold::kHandles;
  grip_W_ = Position(document, *handle);
  // Of a single chosen curve (the one just made) its handles are still dragged one by one; of more, all go along.
  const editor::Selection& selection = work.session.selection;
  const bool one_curve = selection.curves.size() == 1 && selection.lanes.empty() && selection.handles.empty();
  const std::vector<editor::Handle> chosen = editor::HandlesOf(document, selection);
  const bool of_chosen = !one_curve && std::find(chosen.begin(), chosen.end(), *handle) != chosen.end();
  // Ends that were joined stay so, unless Alt is held.
  dragged_ = of_chosen ? chosen : io.KeyAlt ? std::vector{*handle} : editor::HandlesTogether(document, grip_W_);
  const auto first = std::find(dragged_.begin(), dragged_.end(), *handle);
  std::iter_swap(dragged_.begin(), first);
}

void Canvas::DragHandles(Work& work, const Eigen::Vector2d& px) {
  Eigen::Vector2d to_W = grip_W_ + work.view.ToWorld(px) - pressed_W_;
  if (work.snap) {
    std::set<std::int32_t> curves;
    for (const editor::Handle& handle : dragged_) curves.insert(handle.curve);
    to_W =
        editor::Snap(work.session.document(), dragged_.front(), curves, to_W, kSnap_px * work.view.metres_per_px).p_W;
  }
  const Eigen::Vector2d by_W = to_W - grip_W_;
  const auto move = [&](Document& document) { return editor::MoveHandles(document, dragged_, by_W); };
  if (edited_) {
    work.session.Again(move);
    edited_ = by_W != Eigen::Vector2d::Zero();  // a move by nothing has no edit
  } else if (by_W != Eigen::Vector2d::Zero()) {
    edited_ = work.session.Do(move);
  }
}

void Canvas::Release(Work& work, const Eigen::Vector2d& px) {
  const Hold held = std::exchange(hold_, Hold::kNone);
  const bool add = ImGui::GetIO().KeyCtrl;
  if (held == Hold::kTool) return FinishTool(work, pressed_W_, work.view.ToWorld(px));
  if (held == Hold::kRectangle && moved_) {
    work.session.selection = editor::Inside(work.session.document(), pressed_W_, work.view.ToWorld(px));
    const auto& chosen = work.session.selection;
    return work.session.Say(fmt::format("{} handles, {} curves, {} lanes chosen", chosen.handles.size(),
                                        chosen.curves.size(), chosen.lanes.size()));
  }
  if (!moved_) ChooseAt(work, px, add);
}

void Canvas::ChooseAt(Work& work, const Eigen::Vector2d& px, bool add) {
  const Document& document = work.session.document();
  const Eigen::Vector2d p_W = work.view.ToWorld(px);
  if (!add) work.session.selection = {};
  if (const auto curve = editor::CurveAt(document, p_W, kReach_px * work.view.metres_per_px))
    work.session.selection.curves.insert(*curve);
  else if (const auto lane = editor::LaneAt(document, p_W))
    work.session.selection.lanes.insert(*lane);
}

void Canvas::FinishTool(Work& work, const Eigen::Vector2d& from_W, const Eigen::Vector2d& to_W) {
  const double reach_m = kSnap_px * work.view.metres_per_px;
  if (work.tool == Tool::kLane) {
    const auto middle = editor::MiddleBetween(work.session.document(), from_W, to_W, work.snap ? reach_m : 0.0);
    work.session.Do([&](Document& document) { return editor::LaneAlong(document, middle, work.look); });
    return;
  }
  if (work.tool == Tool::kMeasure) {
    work.measured = {from_W, to_W};
    work.known_m = (from_W - to_W).norm();
    work.Open(Form::kMeasured);
    work.tool = Tool::kChoose;
    return;
  }
  // A template: where the button went down; its heading is where it was drawn to.
  editor::TemplatePlace place = work.place;
  place.middle_W = from_W;
  if (moved_) place.heading_rad = std::atan2(to_W.y() - from_W.y(), to_W.x() - from_W.x());
  if (work.session.Do([&](Document& document) { return editor::Place(document, work.placing, place); }))
    work.tool = Tool::kChoose;
}

}  // namespace rodeira::nodes
