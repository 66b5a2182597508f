// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "common/core/base/result.hpp"
#include "common/view/scene/playback/picture_pace.hpp"
#include "nodes/view/frame/quality.hpp"

struct SDL_Window;

namespace rodeira::nodes {

enum class SurfaceKind { kWindow, kOffscreen };

// Where pictures are drawn: an SDL2 window, or pixels without a display (EGL). Made, used and destroyed on one thread;
// its OpenGL context is current there all the while. At most one a process.
class Surface {
 public:
  // A window appears on the display of that number, on the first one where the PC has fewer. One that is not resizable
  // keeps its size, full screen included: frames are read from it. `quality`: none for the renderer's own: of a window
  // low where the processor draws and high where a graphics card does; medium for what is no window. Wrong input where
  // there is no display (kWindow) or no OpenGL: a sentence that says what is missing.
  static base::Result<std::unique_ptr<Surface>> Open(SurfaceKind kind, int width_px, int height_px,
                                                     const std::string& title, bool resizable = false, int display = 0,
                                                     std::optional<Quality> quality = std::nullopt);
  ~Surface();
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;

  SurfaceKind kind() const { return kind_; }
  int width_px() const;  // of the drawing area, now
  int height_px() const;
  // Shows what was drawn (waits for the display where it can).
  void Swap();
  // How often the display under the window is refreshed now, and whether Swap waits for it.
  scene::DisplayBeat beat() const;
  // From now on it does not wait for the display: the headset says when.
  void NeverWait();
  void ToggleFullScreen();
  // The window goes away; drawing and reading go on.
  void Hide();
  // "llvmpipe (LLVM 15.0.6, 256 bits)" or the like.
  const std::string& renderer() const { return renderer_; }
  bool draws_by_processor() const;
  Quality quality() const { return quality_; }

 private:
  Surface() = default;
  base::Status MakeWindow(int width_px, int height_px, const std::string& title, bool resizable, int display,
                          std::optional<Quality> quality);
  bool MakeContext(int width_px, int height_px, const std::string& title, int display, int samples);
  void DropContext();

  SurfaceKind kind_ = SurfaceKind::kOffscreen;
  SDL_Window* window_ = nullptr;
  void* context_ = nullptr;
  bool video_ = false;
  bool resizable_ = false;
  bool full_screen_ = false;
  bool holds_ = false;  // the display has taken it upon itself
  std::string renderer_;
  Quality quality_ = Quality::kMedium;
};

// Whether a window could be opened: a display server answers. Cheap; must not be called while a Surface is open.
bool HasDisplay();

}  // namespace rodeira::nodes
