// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "common/core/base/result.hpp"
#include "common/view/window/font.hpp"
#include "common/view/window/image.hpp"

struct SDL_Window;
struct ImGuiContext;

namespace rodeira::window {

class Input;

enum class Kind { kWindow, kOffscreen };

// Of a new window. Pixels are those of the drawing area.
struct Settings {
  Kind kind = Kind::kWindow;
  int width_px = 1280;
  int height_px = 800;
  std::string title = "Rodeira";
  std::filesystem::path font = FontFile();
};

// A window with panels: SDL2, an OpenGL 2 context, Dear ImGui. Made, used and destroyed on one thread, where its
// contexts are current all the while; at most one a process, and not beside another window of SDL's.
//
//   while (window.BeginFrame(wait_ms)) {
//     glClear(…); …              // what lies below the panels
//     ImGui::Begin("…"); …       // panels
//     window.EndFrame();
//   }
class Window {
 public:
  // Off-screen it draws without a display (EGL); events are those that the program pushes (SDL_PushEvent). Wrong input
  // where there is no display (kWindow) or no OpenGL: a sentence that says what is missing.
  static base::Result<std::unique_ptr<Window>> Open(const Settings& settings);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  // Takes the events, up to `wait_ms` for the first one, clears the picture and begins the panels. False where the
  // window should close: the frame must then not be drawn. StayOpen takes that back.
  bool BeginFrame(int wait_ms);
  // Draws the panels over the picture and shows it; what is seen is written into `seen` too.
  void EndFrame(Image* seen = nullptr);

  int width_px() const;  // of the drawing area, now
  int height_px() const;
  // Events wait for a further frame: BeginFrame will not wait.
  bool busy() const;
  // The person has been asked, or must be: the window is not to close now.
  void StayOpen();
  // UTF-8.
  void SetTitle(const std::string& title);
  // Of OpenGL: "llvmpipe (LLVM 15.0.6, 256 bits)" or the like.
  const std::string& renderer() const { return renderer_; }

 private:
  Window() = default;
  base::Status Make(const Settings& settings);
  Image Read() const;

  Kind kind_ = Kind::kOffscreen;
  SDL_Window* window_ = nullptr;
  void* gl_ = nullptr;
  ImGuiContext* panels_ = nullptr;
  std::unique_ptr<Input> input_;
  bool video_ = false;
  bool drawn_with_ = false;   // ImGui's OpenGL part is there
  std::uint64_t before_ = 0;  // the last frame's beginning, by SDL's counter
  std::string renderer_;
};

}  // namespace rodeira::window
