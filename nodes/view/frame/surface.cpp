// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/frame/surface.hpp"

#include <SDL.h>
#include <SDL_opengl.h>

#include "common/core/base/display.hpp"
#include "common/view/window/display.hpp"

namespace rodeira::nodes {
namespace {

constexpr const char* kNoDisplay =
    "a window is requested, but there is no display; set DISPLAY, or --headless ('window: never')";

// Starts SDL's video with one of its drivers, or nullptr for the display's own.
bool StartVideo(const char* driver) {
  SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");  // signals are the run's
  SDL_SetMainReady();
  return SDL_VideoInit(driver) == 0;
}

void SetContextHints(int samples) {
  SDL_GL_ResetAttributes();
  SDL_GL_SetAttribute(SDL_GL_RED_SIZE, 8);
  SDL_GL_SetAttribute(SDL_GL_GREEN_SIZE, 8);
  SDL_GL_SetAttribute(SDL_GL_BLUE_SIZE, 8);
  SDL_GL_SetAttribute(SDL_GL_DEPTH_SIZE, 24);
  SDL_GL_SetAttribute(SDL_GL_DOUBLEBUFFER, 1);
  SDL_GL_SetAttribute(SDL_GL_MULTISAMPLEBUFFERS, samples > 0 ? 1 : 0);
  SDL_GL_SetAttribute(SDL_GL_MULTISAMPLESAMPLES, samples);
}

// Of the current context.
std::string RendererName() {
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return name != nullptr ? name : "";
}

bool IsSoftware(const std::string& renderer) {
  return renderer.find("llvmpipe") != std::string::npos || renderer.find("softpipe") != std::string::npos ||
         renderer.find("swrast") != std::string::npos;
}

}  // namespace

bool HasDisplay() {
  if (!base::NamesDisplay()) return false;
  if (!StartVideo(nullptr)) return false;
  const bool display = window::IsDisplay(SDL_GetCurrentVideoDriver());
  SDL_VideoQuit();
  return display;
}

base::Result<std::unique_ptr<Surface>> Surface::Open(SurfaceKind kind, int width_px, int height_px,
                                                     const std::string& title, bool resizable, int display,
                                                     std::optional<Quality> quality) {
  std::unique_ptr<Surface> surface(new Surface());
  surface->kind_ = kind;
  if (kind == SurfaceKind::kWindow && !base::NamesDisplay()) return base::WrongInput("view.no_display", kNoDisplay);
  if (!StartVideo(kind == SurfaceKind::kOffscreen ? "offscreen" : nullptr)) {
    return base::WrongInput(
        kind == SurfaceKind::kWindow ? base::ErrorId("view.no_display") : base::ErrorId("view.no_opengl"),
        std::string(kind == SurfaceKind::kWindow ? "a window is requested, but no display answers ("
                                                 : "OpenGL without a display does not start (") +
            SDL_GetError() +
            (kind == SurfaceKind::kWindow ? "); set DISPLAY, or --headless ('window: never')"
                                          : "); the packages libegl1 and libegl-mesa0 were expected"));
  }
  surface->video_ = true;
  if (kind == SurfaceKind::kWindow && !window::IsDisplay(SDL_GetCurrentVideoDriver())) {
    return base::WrongInput("view.no_display", "a window is requested, but no display answers (" +
                                                   base::NamedDisplay() +
                                                   "); another DISPLAY was expected, or 'window: never'");
  }
  if (auto status = surface->MakeWindow(width_px, height_px, title, resizable, display, quality); !status)
    return status.error();
  return surface;
}

bool Surface::MakeContext(int width_px, int height_px, const std::string& title, int display, int samples) {
  Uint32 flags = SDL_WINDOW_OPENGL;
  if (kind_ == SurfaceKind::kWindow) flags |= SDL_WINDOW_SHOWN;
  if (resizable_) flags |= SDL_WINDOW_RESIZABLE;
  const int place = static_cast<int>(SDL_WINDOWPOS_CENTERED_DISPLAY(display < SDL_GetNumVideoDisplays() ? display : 0));
  SetContextHints(samples);
  window_ = SDL_CreateWindow(title.c_str(), place, place, width_px, height_px, flags);
  if (window_ != nullptr) context_ = SDL_GL_CreateContext(window_);
  if (context_ == nullptr) DropContext();
  return context_ != nullptr;
}

void Surface::DropContext() {
  if (context_ != nullptr) SDL_GL_DeleteContext(context_);
  if (window_ != nullptr) SDL_DestroyWindow(window_);
  context_ = nullptr;
  window_ = nullptr;
}

base::Status Surface::MakeWindow(int width_px, int height_px, const std::string& title, bool resizable, int display,
                                 std::optional<Quality> quality) {
  resizable_ = resizable;
  const auto make = [&](int samples) {  // smooth edges where they are to be had
    return (samples > 0 && MakeContext(width_px, height_px, title, display, samples)) ||
           MakeContext(width_px, height_px, title, display, 0);
  };
  const Quality guess = quality.value_or(kind_ == SurfaceKind::kWindow ? Quality::kHigh : Quality::kMedium);
  bool made = make(TraitsOf(guess).samples);
  quality_ = guess;
  if (made && !quality && kind_ == SurfaceKind::kWindow &&
      IsSoftware(RendererName())) {  // it needs its time for more pictures a second
    DropContext();
    quality_ = Quality::kLow;
    made = make(TraitsOf(quality_).samples);
  }
  if (!made)
    return base::WrongInput("view.no_opengl", std::string("no OpenGL context can be made (") + SDL_GetError() +
                                                  "); the package libgl1-mesa-dri was expected");
  // A first operation, for a driver that would wait for ever in it: RenderThread::Open has a limit for this function.
  glClear(GL_COLOR_BUFFER_BIT);
  glFinish();
  if (kind_ == SurfaceKind::kWindow) holds_ = SDL_GL_SetSwapInterval(1) == 0;
  if (!holds_) SDL_ClearError();
  renderer_ = RendererName();
  return {};
}

Surface::~Surface() {
  DropContext();
  if (video_) SDL_VideoQuit();
}

int Surface::width_px() const {
  int width = 0, height = 0;
  SDL_GL_GetDrawableSize(window_, &width, &height);
  return width;
}

int Surface::height_px() const {
  int width = 0, height = 0;
  SDL_GL_GetDrawableSize(window_, &width, &height);
  return height;
}

bool Surface::draws_by_processor() const { return IsSoftware(renderer_); }

void Surface::Swap() { SDL_GL_SwapWindow(window_); }

scene::DisplayBeat Surface::beat() const {
  SDL_DisplayMode mode{};
  const int display = kind_ == SurfaceKind::kWindow ? SDL_GetWindowDisplayIndex(window_) : -1;
  if (display < 0 || SDL_GetCurrentDisplayMode(display, &mode) != 0) mode.refresh_rate = 0;
  return {static_cast<double>(mode.refresh_rate), holds_};
}

void Surface::NeverWait() {
  holds_ = false;
  if (SDL_GL_SetSwapInterval(0) != 0) SDL_ClearError();
}

void Surface::ToggleFullScreen() {
  if (!resizable_) return;
  full_screen_ = !full_screen_;
  SDL_SetWindowFullscreen(window_, full_screen_ ? SDL_WINDOW_FULLSCREEN_DESKTOP : 0);
}

void Surface::Hide() { SDL_HideWindow(window_); }

}  // namespace rodeira::nodes
