// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/view/window/window.hpp"
#include "launch/rodeira/run/processes.hpp"
#include "launch/rodeira/start_window/start_model.hpp"
#include "launch/rodeira/start_window/wheel_panel.hpp"

namespace rodeira::cli {

// A run or a replay that the start window has begun, and what it says.
class StartedRun {
 public:
  // `program` with these arguments; both outputs are read. Failed where it does not start.
  static base::Result<StartedRun> Start(const std::string& program, const std::vector<std::string>& arguments);

  // Reads what it has said, without waiting.
  void Poll();
  bool ended() const { return child_.ended(); }
  // Ctrl-C, as in its terminal.
  void Stop() const;
  // Its newest lines.
  const std::vector<std::string>& lines() const { return lines_; }
  // "goes on for 12 s", or how it ended.
  std::string State() const;

 private:
  explicit StartedRun(Child child) : child_(std::move(child)), begun_(std::chrono::steady_clock::now()) {}

  Child child_;
  std::chrono::steady_clock::time_point begun_;
  std::string rest_;
  std::vector<std::string> lines_;
};

// The window in which a person without a command chooses one: world, vehicle, driver, traffic, recording, or a
// recording to watch; the command that does the same stands below. What was begun says there how it goes. A steering
// wheel is set up here too.
class StartWindow {
 public:
  StartWindow(StartFiles files, std::string program)
      : files_(std::move(files)), program_(std::move(program)), choice_(DefaultChoice(files_)) {}

  // Draws the panels of one frame; between BeginFrame and EndFrame.
  void Draw(int width_px, int height_px);
  const StartChoice& choice() const { return choice_; }
  StartChoice& choice() { return choice_; }
  const std::optional<StartedRun>& run() const { return run_; }
  const WheelPanel& wheel() const { return wheel_; }

 private:
  void DrawChoices();
  void DrawDrive();
  void ChooseFile(const char* label, const std::vector<std::filesystem::path>& files,
                  std::filesystem::path& chosen) const;
  void DrawWheel();
  void TakeWheel(const std::filesystem::path& file);
  void DrawWatch();
  void LookForRecordings();
  void DrawCommand();
  void DrawRun();

  StartFiles files_;
  std::string program_;
  StartChoice choice_;
  std::optional<StartedRun> run_;
  std::string problem_;
  WheelPanel wheel_;
};

// `rodeira` or `rodeira view` on a display: until the window is closed. The program's exit status.
int StartByWindow();

}  // namespace rodeira::cli
