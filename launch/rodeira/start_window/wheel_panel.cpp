// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/start_window/wheel_panel.hpp"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

#include "common/core/base/printable.hpp"

namespace rodeira::cli {
namespace {

constexpr float kMaxStep_s = 0.1F;                       // a window that was held up has seen nothing meanwhile
constexpr int kMinRange_deg = 20, kMaxRange_deg = 3600;  // as wheel files: twice what a side may have

// From the axis' one end to its other, as the device counts.
float ShareOf(double raw) { return static_cast<float>(std::clamp((raw + 32768.0) / 65535.0, 0.0, 1.0)); }

}  // namespace

void WheelPanel::Open() {
  said_.clear();
  auto begun = WheelWizard::Begin();
  if (begun)
    wizard_ = std::move(begun).value();
  else
    said_ = begun.error().Text();
}

std::optional<std::filesystem::path> WheelPanel::TakeWritten() { return std::exchange(written_, std::nullopt); }

void WheelPanel::Close(std::string said) {
  wizard_.reset();
  said_ = std::move(said);
}

void WheelPanel::Finish() {
  auto file = wizard_->Write(std::nullopt, std::clamp(range_deg_, kMinRange_deg, kMaxRange_deg) / 2.0);
  if (!file) return Close(file.error().Text());
  Close("written: " + file.value().string());
  written_ = std::move(file).value();
}

void WheelPanel::Draw() {
  if (wizard_ == nullptr) return;
  if (const auto went = wizard_->Step(std::clamp(ImGui::GetIO().DeltaTime, 1e-4F, kMaxStep_s)); !went)
    return Close(went.error().Text());
  if (wizard_->done()) return Finish();
  ImGui::Text("setting up a steering wheel: movement %d of at most %d", wizard_->number(), WheelWizard::kMovements);
  ImGui::Spacing();
  ImGui::TextWrapped("%s", wizard_->prompt().c_str());
  if (!wizard_->remark().empty()) ImGui::TextWrapped("%s", wizard_->remark().c_str());
  ImGui::Spacing();
  DrawDevices();
  ImGui::SetNextItemWidth(140.0F);
  ImGui::InputInt("degrees that the wheel turns from end to end", &range_deg_, 90, 180);
  ImGui::Spacing();
  if (ImGui::Button("cancel", {140.0F, 32.0F})) Close("setup cancelled; nothing was written");
}

void WheelPanel::DrawDevices() const {
  for (std::size_t place = 0; place < wizard_->devices().size(); ++place) {
    const input_devices::DeviceReading& reading = wizard_->readings()[place];
    ImGui::TextUnformatted(base::Printable(wizard_->devices()[place].name).c_str());
    if (!reading.connected) ImGui::TextUnformatted("  was unplugged");
    if (!reading.connected) continue;
    for (std::size_t axis = 0; axis < reading.axes.size(); ++axis) {
      ImGui::ProgressBar(ShareOf(reading.axes[axis]), {420.0F, 0.0F},
                         fmt::format("{:.0f}", reading.axes[axis]).c_str());
      ImGui::SameLine();
      ImGui::Text("axis %d", static_cast<int>(axis));
    }
    std::string down;
    for (std::size_t button = 0; button < reading.buttons.size(); ++button) {
      if (reading.buttons[button] != 0) down += fmt::format(" {}", button);
    }
    ImGui::Text("buttons held:%s", down.empty() ? " none" : down.c_str());
    ImGui::Spacing();
  }
}

}  // namespace rodeira::cli
