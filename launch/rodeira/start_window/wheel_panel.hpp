// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "launch/rodeira/commands/wheel_wizard.hpp"

namespace rodeira::cli {

// The wizard for steering wheels as panels of Dear ImGui: what is asked for, the axes as they move, cancel.
class WheelPanel {
 public:
  // Begins with what is plugged in; where that is nothing, said() tells.
  void Open();
  bool open() const { return wizard_ != nullptr; }
  // One frame of it, while it is open; between BeginFrame and EndFrame.
  void Draw();
  // How the last setup ended, as a sentence; empty before.
  const std::string& said() const { return said_; }
  // The file that was just written, once.
  std::optional<std::filesystem::path> TakeWritten();
  // Null while it is closed.
  const WheelWizard* wizard() const { return wizard_.get(); }

 private:
  void DrawDevices() const;
  void Finish();
  void Close(std::string said);

  std::unique_ptr<WheelWizard> wizard_;
  int range_deg_ = 900;  // of the wheel, from end to end
  std::string said_;
  std::optional<std::filesystem::path> written_;
};

}  // namespace rodeira::cli
