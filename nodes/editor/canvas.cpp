#include "nodes/editor/canvas.hpp"

#include <SDL.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "common/editor/snap.hpp"

namespace rodeira::desk {
namespace {

using editor::Document;

constexpr double kReach_px = 8.0;    // of the pointer
constexpr double kSnap_px = 12.0;
constexpr double kTremble_px = 3.0;  // a click may move so far
constexpr double kNotch = 1.2;       // of the wheel
constexpr double kPan_pxps = 600.0;  // by keys

Eigen::Vector2d Position(const Document& document, const editor::Handle& handle) {
  return editor::CubicOf(document.map.curves[*editor::Find(document.map.curves, handle.curve)].value).p_W[static_cast<std::size_t>(handle.index)];
}

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
  const Document& document = work.session.document();
  pictures_.Draw(work.picture.picture(), 10.0 * static_cast<double>(document.map.scale.value.value), work.view, left, below);
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
  const Eigen::Vector2d px(static_cast<double>(io.MousePos.x - area_.left), static_cast<double>(io.MousePos.y - area_.top));
  const bool over = px.x() >= 0.0 && px.y() >= 0.0 && px.x() < work.view.width_px && px.y() < work.view.height_px && !io.WantCaptureMouse;
  if (over && io.MouseWheel != 0.0f) work.view.Zoom(std::pow(kNotch, static_cast<double>(io.MouseWheel)), px);
  for (const int button : {1, 2}) {
    if (ImGui::IsMouseDragging(button, 0.0f) && !io.WantCaptureMouse) work.view.Drag({static_cast<double>(io.MouseDelta.x), static_cast<double>(io.MouseDelta.y)});
  }
  if (over && ImGui::IsMouseClicked(0)) Press(work, px);
  if (hold_ == Hold::kNone) return;
  if ((px - pressed_px_).norm() > kTremble_px) moved_ = true;
  if (hold_ == Hold::kPan && moved_) work.view.Go(pressed_W_ - work.view.ToWorld(px));
  if (hold_ == Hold::kHandles && moved_) DragHandles(work, px);
  if (!io.MouseDown[0]) Release(work, px);
}

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
  const auto handle = work.handles ? editor::HandleAt(document, pressed_W_, kReach_px * work.view.metres_per_px) : std::nullopt;
  if (!handle) return;
  hold_ = Hold::kHandles;
  grip_W_ = Position(document, *handle);
  // Of a single chosen curve (the one just made) its handles are still dragged one by one; of more, all go along.
  const editor::Selection& selection = work.session.selection;
  const bool one_curve = selection.curves.size() == 1 && selection.lanes.empty() && selection.handles.empty();
  const std::vector<editor::Handle> chosen = editor::HandlesOf(document, selection);
  const bool of_chosen = !one_curve && std::find(chosen.begin(), chosen.end(), *handle) != chosen.end();
  // Ends that were joined stay so, but for who holds Alt.
  dragged_ = of_chosen ? chosen : io.KeyAlt ? std::vector{*handle} : editor::HandlesTogether(document, grip_W_);
  const auto first = std::find(dragged_.begin(), dragged_.end(), *handle);
  std::iter_swap(dragged_.begin(), first);
}

void Canvas::DragHandles(Work& work, const Eigen::Vector2d& px) {
  Eigen::Vector2d to_W = grip_W_ + work.view.ToWorld(px) - pressed_W_;
  if (work.snap) {
    std::set<std::int32_t> curves;
    for (const editor::Handle& handle : dragged_) curves.insert(handle.curve);
    to_W = editor::Snap(work.session.document(), dragged_.front(), curves, to_W, kSnap_px * work.view.metres_per_px).p_W;
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
    return work.session.Say(fmt::format("{} handles, {} curves, {} lanes chosen", chosen.handles.size(), chosen.curves.size(), chosen.lanes.size()));
  }
  if (!moved_) ChooseAt(work, px, add);
}

void Canvas::ChooseAt(Work& work, const Eigen::Vector2d& px, bool add) {
  const Document& document = work.session.document();
  const Eigen::Vector2d p_W = work.view.ToWorld(px);
  if (!add) work.session.selection = {};
  if (const auto curve = editor::CurveAt(document, p_W, kReach_px * work.view.metres_per_px)) work.session.selection.curves.insert(*curve);
  else if (const auto lane = editor::LaneAt(document, p_W)) work.session.selection.lanes.insert(*lane);
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
  if (work.session.Do([&](Document& document) { return editor::Place(document, work.placing, place); })) work.tool = Tool::kChoose;
}

void Canvas::TakeKeys(Work& work) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantTextInput || io.KeyCtrl || io.KeyAlt || work.form != Form::kNone || work.files.open()) return;
  const double step_m = kPan_pxps * work.view.metres_per_px * static_cast<double>(std::min(io.DeltaTime, 0.1f));
  const auto held = [&](int key) { return io.KeysDown[key] ? 1.0 : 0.0; };
  work.view.Go({step_m * (held(SDL_SCANCODE_D) - held(SDL_SCANCODE_A)), step_m * (held(SDL_SCANCODE_W) - held(SDL_SCANCODE_S))});
}

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
    const bool seen = at.x() > static_cast<double>(area_.left) && at.y() > static_cast<double>(area_.top) && at.x() < static_cast<double>(area_.left + area_.width) && at.y() < static_cast<double>(area_.top + area_.height);
    if (!seen || ++count > kMost) return;
    const std::string text = std::to_string(number);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const ImVec2 corner(static_cast<float>(at.x()) - 0.5f * size.x, static_cast<float>(at.y()) - 0.5f * size.y);
    list.AddRectFilled(ImVec2(corner.x - 2.0f, corner.y), ImVec2(corner.x + size.x + 2.0f, corner.y + size.y), IM_COL32(0, 0, 0, 150), 2.0f);
    list.AddText(corner, colour, text.c_str());
  };
  if (work.view.metres_per_px > 1.0) return;
  const map::NumberIndex curves(document.map.curves);
  for (const auto& line : document.map.lanes) {
    const auto left = curves.Find(line.value.left.curve), right = curves.Find(line.value.right.curve);
    if (!left || !right) continue;
    const Eigen::Vector2d a = map::BorderOf(line.value.left, document.map.curves[*left].value, {}).plan.At(0.5), b = map::BorderOf(line.value.right, document.map.curves[*right].value, {}).plan.At(0.5);
    write(0.5 * (a + b), line.value.id, IM_COL32(140, 220, 255, 255));
  }
  for (const auto& line : document.map.curves) write(editor::CubicOf(line.value).At(0.4), line.value.id, IM_COL32(255, 235, 140, 255));
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
  const Eigen::Vector2d to_W = work.view.ToWorld({static_cast<double>(b.x - area_.left), static_cast<double>(b.y - area_.top)});
  const map::Cubic middle{editor::MiddleBetween(work.session.document(), pressed_W_, to_W, work.snap ? kSnap_px * work.view.metres_per_px : 0.0)};
  std::array<ImVec2, 4> p;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Eigen::Vector2d at = Screen(work, middle.p_W[i]);
    p[i] = ImVec2(static_cast<float>(at.x()), static_cast<float>(at.y()));
  }
  list.AddBezierCubic(p[0], p[1], p[2], p[3], kInk, static_cast<float>(std::max(2.0, work.look.width_m / work.view.metres_per_px)) * 0.5f);
}

}  // namespace rodeira::desk
