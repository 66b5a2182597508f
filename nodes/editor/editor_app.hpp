// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "common/view/window/window.hpp"
#include "nodes/editor/canvas.hpp"
#include "nodes/editor/work.hpp"

namespace rodeira::nodes {

// The drawing desk in its window. The window must outlive it.
class EditorApp {
 public:
  // `kept`: where unsaved work is kept (editor::Keeper); empty: nowhere. `file` is opened; one that is not there is
  // said in the status line.
  EditorApp(window::Window& window, const std::filesystem::path& file, const std::filesystem::path& kept);

  // One picture: takes what hands did, does it, draws. False: the desk is closed.
  bool Frame(int wait_ms, window::Image* seen = nullptr);
  // How long the next picture may wait for hands, ms: not at all where something moves, a little while the background
  // is read beside it.
  int wait_ms() const;

  // How long unsaved work may be kept nowhere, s; 10 otherwise.
  void KeepEvery(double seconds) { keep_every_s_ = seconds; }
  Work& work() { return work_; }

 private:
  void Layout();
  void RunTraffic();
  void KeepWork();
  void WritePicture(const window::Image& picture);

  window::Window& window_;
  Work work_;
  Canvas canvas_;
  std::optional<editor::Keeper> keeper_;
  std::uint64_t kept_state_ = 0;
  double since_kept_s_ = 0.0, keep_every_s_ = 10.0;
  std::string title_;
};

// `rodeira edit [FILE.motors]`: until the window is closed. The exit status.
int RunEditor(const std::filesystem::path& file);

}  // namespace rodeira::nodes
