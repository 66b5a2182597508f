// SPDX-License-Identifier: Apache-2.0
#include "nodes/editor/editor_app.hpp"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <system_error>
#include <utility>

#include "common/core/base/print_error.hpp"
#include "common/core/base/user_folders.hpp"
#include "nodes/editor/panels.hpp"

namespace rodeira::nodes {
namespace {

constexpr float kSide_px = 300.0f, kStatus_px = 30.0f;
constexpr double kHeatEvery_s = 0.5;
constexpr double kMaxTrafficTime_s = 0.025;  // of a picture

}  // namespace

EditorApp::EditorApp(window::Window& window, const std::filesystem::path& file, const std::filesystem::path& kept)
    : window_(window) {
  work_.view.width_px = window.width_px() - kSide_px;
  work_.view.height_px = window.height_px();
  if (!kept.empty()) {
    auto keeper = editor::Keeper::Make(kept);
    if (keeper) {
      keeper_.emplace(std::move(keeper).value());
      work_.left = keeper_->Found();
    } else {
      work_.session.Say(keeper.error().Text(), false);
    }
  }
  std::error_code problem;
  if (!file.empty() && work_.session.Open(file)) ShowAll(work_);
  if (!work_.left.empty()) work_.Open(Form::kRecover);
  kept_state_ = work_.session.state();
}

int EditorApp::wait_ms() const {
  constexpr int kIdle_ms = 100, kLoading_ms = 60;
  if (work_.traffic.runs || canvas_.incomplete() || window_.busy() || ImGui::GetIO().WantTextInput) return 0;
  // What is seen already need not be drawn while the rest is read.
  return work_.picture.loading() && work_.picture.picture() == nullptr ? kLoading_ms : kIdle_ms;
}

bool EditorApp::Frame(int wait_ms, window::Image* seen) {
  if (!window_.BeginFrame(wait_ms)) {
    window_.StayOpen();
    AskToClose(work_);
    if (work_.closing) {
      if (keeper_) keeper_->Forget();
      return false;
    }
    if (!window_.BeginFrame(0)) return false;
  }
  work_.picture.Want(work_.session.document().map.picture, work_.session.picture_state());
  const bool had_one = work_.picture.picture() != nullptr;
  work_.picture.Poll();
  if (const std::string problem = work_.picture.TakeProblem(); !problem.empty()) work_.session.Say(problem, false);
  if (!had_one && work_.picture.picture() != nullptr && work_.session.document().map.curves.empty()) ShowAll(work_);
  RunTraffic();
  if (!work_.left.empty() && work_.form == Form::kNone) work_.Open(Form::kRecover);
  Layout();
  KeepWork();
  const bool keeps = std::exchange(work_.take_picture, false);
  window::Image picture;
  window_.EndFrame(keeps ? &picture : seen);
  if (keeps) WritePicture(picture);
  if (keeps && seen != nullptr) *seen = std::move(picture);
  if (work_.closing && keeper_) keeper_->Forget();
  return !work_.closing;
}

void EditorApp::Layout() {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  work_.places.clear();
  TakeShortcuts(work_);
  const float top = ImGui::GetFrameHeight();
  const float height = std::max(1.0f, size.y - top - kStatus_px), width = std::max(1.0f, size.x - kSide_px);
  canvas_.Draw(work_, {kSide_px, top, width, height}, window_.height_px());
  DrawMenu(work_);
  DrawSide(work_, canvas_.proposals(), top, kSide_px, height);
  DrawStatus(work_, size.y - kStatus_px, size.x, kStatus_px);
  DrawForms(work_);
  work_.files.Draw();
  const std::string name = work_.session.path().empty() ? "new map" : work_.session.path().filename().string();
  const std::string title = fmt::format("{}{} - Rodeira", work_.session.unsaved() ? "*" : "", name);
  if (title != title_) window_.SetTitle(title);
  title_ = title;
}

void EditorApp::RunTraffic() {
  Traffic& traffic = work_.traffic;
  if (!traffic.preview) return;
  if (traffic.runs && traffic.of_state != work_.session.state()) {
    traffic.runs = false;
    work_.session.Say("traffic pauses: the map was edited");
  }
  if (traffic.runs) {
    // No more than the machine can do in a part of a picture's time: then traffic is slower than wished, the desk is
    // not.
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    double left_s = static_cast<double>(ImGui::GetIO().DeltaTime) * static_cast<double>(traffic.pace);
    while (left_s > 0.0 && std::chrono::duration<double>(Clock::now() - begin).count() < kMaxTrafficTime_s) {
      const double piece_s = std::min(left_s, 0.1);
      traffic.preview->Run(piece_s);
      left_s -= piece_s;
    }
  }
  if (traffic.preview->time_s() < traffic.heat_of_s + kHeatEvery_s && traffic.heat_of_s >= 0.0) return;
  traffic.heat = traffic.preview->Heat();
  traffic.heat_of_s = traffic.preview->time_s();
}

void EditorApp::WritePicture(const window::Image& picture) {
  const std::filesystem::path folder = base::UserDataFolder() / "pictures";
  const std::string name = work_.session.path().empty() ? "map" : work_.session.path().stem().string();
  std::error_code problem;
  std::filesystem::path file = folder / (name + ".png");
  for (int number = 2; std::filesystem::exists(file, problem); ++number)
    file = folder / fmt::format("{}-{}.png", name, number);
  if (auto status = window::WritePng(file, picture); !status)
    work_.session.Say(status.error().Text(), false);
  else
    work_.session.Say("the window's picture is " + file.string());
}

void EditorApp::KeepWork() {
  if (!keeper_) return;
  since_kept_s_ += static_cast<double>(ImGui::GetIO().DeltaTime);
  if (!work_.taken_up && (since_kept_s_ < keep_every_s_ || kept_state_ == work_.session.state())) return;
  since_kept_s_ = 0.0;
  kept_state_ = work_.session.state();
  const auto taken_up = std::exchange(work_.taken_up, {});
  if (!work_.session.unsaved()) return keeper_->Forget();
  const auto kept = keeper_->Keep(work_.session.document(), work_.session.path(), work_.session.picture_state());
  if (!kept) return work_.session.Say("unsaved work cannot be kept: " + kept.error().Text(), false);
  if (taken_up) editor::Keeper::Discard(*taken_up);
}

int RunEditor(const std::filesystem::path& file) {
  window::Settings settings;
  settings.title = "Rodeira";
  auto opened = window::Window::Open(settings);
  if (!opened) return base::PrintError("rodeira", opened.error());
  EditorApp app(*opened.value(), file, base::UserDataFolder() / "editor");
  while (app.Frame(app.wait_ms())) {
  }
  return 0;
}

}  // namespace rodeira::nodes
