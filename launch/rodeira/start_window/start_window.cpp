// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/start_window/start_window.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <imgui.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "common/core/base/installation.hpp"
#include "common/core/base/print_error.hpp"
#include "common/core/base/printable.hpp"
#include "common/core/base/user_folders.hpp"
#include "launch/rodeira/interrupt.hpp"
#include "launch/rodeira/wall_clock.hpp"

namespace rodeira::cli {
namespace {

constexpr std::size_t kMaxLines = 200;
constexpr int kWait_ms = 100;
constexpr int kWheelWait_ms = 10;  // bars follow the hand

constexpr float kListWidth = 260.0F;  // of a list of files, with the field for any other one beside it
constexpr float kLabelWidth = 100.0F;

// One of several files.
void ListFiles(const char* label, const std::vector<std::filesystem::path>& files, std::filesystem::path& chosen,
               const std::function<std::string(const std::filesystem::path&)>& name) {
  if (!ImGui::BeginCombo(label, chosen.empty() ? "none" : name(chosen).c_str(), ImGuiComboFlags_HeightLarge)) return;
  for (const auto& file : files) {
    if (ImGui::Selectable(name(file).c_str(), file == chosen)) chosen = file;
  }
  ImGui::EndCombo();
}

// A file's path, as it is typed.
void TypeFile(const char* label, std::filesystem::path& chosen) {
  std::array<char, 1024> text{};
  const std::string now = chosen.string();
  now.copy(text.data(), text.size() - 1);
  if (ImGui::InputText(label, text.data(), text.size())) chosen = text.data();
}

}  // namespace

base::Result<StartedRun> StartedRun::Start(const std::string& program, const std::vector<std::string>& arguments) {
  std::vector<std::string> command{"/bin/sh", "-c", "exec \"$0\" \"$@\" 2>&1", program};
  command.insert(command.end(), arguments.begin(), arguments.end());
  auto child = Child::Start("rodeira", command, true);
  if (!child) return child.error();
  const int out = child.value().out();
  ::fcntl(out, F_SETFL, ::fcntl(out, F_GETFL) | O_NONBLOCK);
  return StartedRun(std::move(child).value());
}

void StartedRun::Poll() {
  std::array<char, 4096> buffer;
  for (;;) {
    const ssize_t size = ::read(child_.out(), buffer.data(), buffer.size());
    if (size <= 0) break;
    rest_.append(buffer.data(), static_cast<std::size_t>(size));
  }
  for (std::size_t end = rest_.find('\n'); end != std::string::npos; end = rest_.find('\n')) {
    lines_.push_back(base::Printable(rest_.substr(0, end)));
    rest_.erase(0, end + 1);
  }
  if (lines_.size() > kMaxLines) lines_.erase(lines_.begin(), lines_.end() - static_cast<std::ptrdiff_t>(kMaxLines));
  child_.Poll();
}

void StartedRun::Stop() const { child_.Signal(SIGINT); }

std::string StartedRun::State() const {
  if (!child_.ended())
    return fmt::format("goes on for {:.0f} s; its own window shows how far it is loaded", SecondsSince(begun_));
  if (child_.exit_status() == 0) return "has ended";
  return child_.Fate();
}

void StartWindow::Draw(int width_px, int height_px) {
  ImGui::SetNextWindowPos({0.0F, 0.0F});
  ImGui::SetNextWindowSize({static_cast<float>(width_px), static_cast<float>(height_px)});
  ImGui::Begin("start", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
  ImGui::TextUnformatted("Rodeira");
  ImGui::Separator();
  if (wheel_.open()) {
    wheel_.Draw();
    if (const auto file = wheel_.TakeWritten()) TakeWheel(*file);
  } else {
    DrawChoices();
    DrawRun();
  }
  ImGui::End();
}

void StartWindow::DrawChoices() {
  ImGui::BeginDisabled(run_ && !run_->ended());
  if (ImGui::RadioButton("drive", choice_.way == StartWay::kDrive)) choice_.way = StartWay::kDrive;
  ImGui::SameLine();
  if (ImGui::RadioButton("watch a recording", choice_.way == StartWay::kWatch)) {
    choice_.way = StartWay::kWatch;
    LookForRecordings();
  }
  ImGui::Spacing();
  if (choice_.way == StartWay::kDrive)
    DrawDrive();
  else
    DrawWatch();
  DrawCommand();
  ImGui::EndDisabled();
}

// The wheel that was just set up is the one to drive with.
void StartWindow::TakeWheel(const std::filesystem::path& file) {
  if (std::find(files_.wheels.begin(), files_.wheels.end(), file) == files_.wheels.end()) files_.wheels.push_back(file);
  std::sort(files_.wheels.begin(), files_.wheels.end());
  choice_.driver = StartDriver::kWheel;
  choice_.wheel = file;
}

// One of the files that were found, or any other one, by its path.
void StartWindow::ChooseFile(const char* label, const std::vector<std::filesystem::path>& files,
                             std::filesystem::path& chosen) const {
  ImGui::SetNextItemWidth(kListWidth);
  ListFiles(fmt::format("##{}", label).c_str(), files, chosen,
            [this](const std::filesystem::path& file) { return ShownName(files_.root, file); });
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-kLabelWidth);
  TypeFile(label, chosen);
}

void StartWindow::DrawDrive() {
  ChooseFile("world", files_.worlds, choice_.world);
  ChooseFile("vehicle", files_.vehicles, choice_.vehicle);
  const auto driver = [&](const char* label, StartDriver which) {
    if (ImGui::RadioButton(label, choice_.driver == which)) choice_.driver = which;
    ImGui::SameLine();
  };
  driver("keyboard", StartDriver::kKeyboard);
  driver("steering wheel", StartDriver::kWheel);
  driver("game pad", StartDriver::kPad);
  driver("autopilot", StartDriver::kAutopilot);
  ImGui::TextUnformatted("  driver");
  ImGui::SameLine();
  DrawWheel();
  ImGui::SliderInt("traffic, cars", &choice_.traffic, 0, 100);
  ImGui::Checkbox("record", &choice_.records);
}

void StartWindow::DrawWheel() {
  if (ImGui::Button("set up a steering wheel")) wheel_.Open();
  if (choice_.driver == StartDriver::kWheel && !files_.wheels.empty()) {
    ListFiles("wheel", files_.wheels, choice_.wheel,
              [](const std::filesystem::path& file) { return file.filename().string(); });
  }
  if (!wheel_.said().empty()) ImGui::TextWrapped("%s", wheel_.said().c_str());
}

// Without a choice, the newest.
void StartWindow::LookForRecordings() {
  const bool newest =
      choice_.recording.empty() || (!files_.recordings.empty() && choice_.recording == files_.recordings.front());
  files_.FindRecordings();
  if (newest && !files_.recordings.empty()) choice_.recording = files_.recordings.front();
}

void StartWindow::DrawWatch() {
  ImGui::TextUnformatted(files_.recordings.empty() ? "there are no recordings yet" : "recent runs");
  for (const auto& file : files_.recordings) {
    if (ImGui::Selectable(file.filename().c_str(), file == choice_.recording)) choice_.recording = file;
  }
  TypeFile("file", choice_.recording);
}

void StartWindow::DrawCommand() {
  ImGui::Spacing();
  ImGui::Separator();
  const std::string missing = WhatIsMissing(files_, choice_);
  if (!missing.empty()) return ImGui::TextWrapped("%s", missing.c_str());
  const auto arguments = CommandOf(files_, choice_);
  const std::string text = ShellText(arguments);
  if (ImGui::Button("start", {140.0F, 32.0F})) {
    problem_.clear();
    auto run = StartedRun::Start(program_, arguments);
    if (run)
      run_.emplace(std::move(run).value());
    else
      problem_ = run.error().Text();
  }
  ImGui::SameLine();
  if (ImGui::Button("copy the command", {0.0F, 32.0F})) ImGui::SetClipboardText(text.c_str());
  ImGui::TextUnformatted("the same as a command:");
  ImGui::TextWrapped("%s", text.c_str());
}

void StartWindow::DrawRun() {
  if (!problem_.empty()) ImGui::TextWrapped("%s", problem_.c_str());
  if (!run_) return;
  const bool went_on = !run_->ended();
  run_->Poll();
  if (went_on && run_->ended()) LookForRecordings();
  ImGui::Separator();
  ImGui::TextWrapped("it %s", run_->State().c_str());
  if (!run_->ended() && ImGui::Button("stop it")) run_->Stop();
  ImGui::BeginChild("said");
  for (const std::string& line : run_->lines()) ImGui::TextWrapped("%s", line.c_str());
  if (!run_->ended()) ImGui::SetScrollHereY(1.0F);
  ImGui::EndChild();
}

int StartByWindow() {
  std::error_code problem;
  const std::filesystem::path here = std::filesystem::current_path(problem);
  std::filesystem::path root = FindStartRoot({here});
  if (root.empty()) root = base::SharedDataFolder();
  if (root == here) root = ".";  // commands are shorter
  auto window = window::Window::Open({window::Kind::kWindow, 820, 640, "Rodeira"});
  if (!window) return base::PrintError("rodeira", window.error());
  CatchInterrupts();
  StartWindow start(FindStartFiles(root, base::UserDataFolder(), base::UserConfigFolder()),
                    base::FindProgram("rodeira").string());
  while (!Interrupted() && window.value()->BeginFrame(start.wheel().open() ? kWheelWait_ms : kWait_ms)) {
    start.Draw(window.value()->width_px(), window.value()->height_px());
    window.value()->EndFrame();
  }
  if (start.run() && !start.run()->ended()) start.run()->Stop();
  return 0;
}

}  // namespace rodeira::cli
