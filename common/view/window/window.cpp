// SPDX-License-Identifier: Apache-2.0
#include "common/view/window/window.hpp"

#include <SDL.h>
#include <SDL_opengl.h>
#include <backends/imgui_impl_opengl2.h>
#include <imgui.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "common/core/base/display.hpp"
#include "common/view/window/display.hpp"
#include "common/view/window/input.hpp"

namespace rodeira::window {
namespace {

constexpr float kOffscreenFrame_s = 1.0f / 60.0f;  // without a viewer, frames follow one another evenly

void SetContextHints() {
  SDL_GL_ResetAttributes();
  SDL_GL_SetAttribute(SDL_GL_RED_SIZE, 8);
  SDL_GL_SetAttribute(SDL_GL_GREEN_SIZE, 8);
  SDL_GL_SetAttribute(SDL_GL_BLUE_SIZE, 8);
  SDL_GL_SetAttribute(SDL_GL_DOUBLEBUFFER, 1);
}

// Dark panels with the view's blue.
void Paint() {
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = style.FrameRounding = style.PopupRounding = 3.0f;
  style.WindowBorderSize = 0.0f;
  style.Colors[ImGuiCol_WindowBg] = ImVec4(0.10f, 0.11f, 0.13f, 0.94f);
}

}  // namespace

base::Result<std::unique_ptr<Window>> Window::Open(const Settings& settings) {
  std::unique_ptr<Window> window(new Window());
  window->kind_ = settings.kind;
  const bool wanted = settings.kind == Kind::kWindow;
  if (wanted && !base::NamesDisplay())
    return base::WrongInput("view.no_display", "a window is requested, but there is no display; set DISPLAY");
  SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");  // signals are the program's
  SDL_SetMainReady();
  if (SDL_VideoInit(wanted ? nullptr : "offscreen") != 0) {
    return base::WrongInput(
        wanted ? base::ErrorId("view.no_display") : base::ErrorId("view.no_opengl"),
        wanted ? std::string("a window is requested, but no display answers (") + SDL_GetError() + "); set DISPLAY"
               : std::string("OpenGL without a display does not start (") + SDL_GetError() +
                     "); the packages libegl1 and libegl-mesa0 were expected");
  }
  window->video_ = true;
  if (wanted && !IsDisplay(SDL_GetCurrentVideoDriver())) {
    return base::WrongInput("view.no_display", "a window is requested, but no display answers (" +
                                                   base::NamedDisplay() + "); another DISPLAY was expected");
  }
  if (auto status = window->Make(settings); !status) return status.error();
  return window;
}

base::Status Window::Make(const Settings& settings) {
  SetContextHints();
  Uint32 flags = SDL_WINDOW_OPENGL | SDL_WINDOW_RESIZABLE;
  if (kind_ == Kind::kWindow) flags |= SDL_WINDOW_SHOWN;
  window_ = SDL_CreateWindow(settings.title.c_str(), SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, settings.width_px,
                             settings.height_px, flags);
  if (window_ != nullptr) gl_ = SDL_GL_CreateContext(window_);
  if (gl_ == nullptr)
    return base::WrongInput("view.no_opengl", std::string("no OpenGL context can be made (") + SDL_GetError() +
                                                  "); the package libgl1-mesa-dri was expected");
  if (kind_ == Kind::kWindow && SDL_GL_SetSwapInterval(1) != 0) SDL_ClearError();
  const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  renderer_ = renderer != nullptr ? renderer : "";
  panels_ = ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // where panels stand is in no file
  Paint();
  UseFont(settings.font);
  input_ = std::make_unique<Input>();
  drawn_with_ = ImGui_ImplOpenGL2_Init();
  SDL_StartTextInput();
  before_ = SDL_GetPerformanceCounter();
  return {};
}

Window::~Window() {
  if (drawn_with_) ImGui_ImplOpenGL2_Shutdown();
  input_.reset();
  if (panels_ != nullptr) ImGui::DestroyContext(panels_);
  if (gl_ != nullptr) SDL_GL_DeleteContext(gl_);
  if (window_ != nullptr) SDL_DestroyWindow(window_);
  if (video_) SDL_VideoQuit();
}

bool Window::BeginFrame(int wait_ms) {
  if (!input_->Take(wait_ms)) return false;
  ImGuiIO& io = ImGui::GetIO();
  const std::uint64_t now = SDL_GetPerformanceCounter();
  const double passed_s = static_cast<double>(now - before_) / static_cast<double>(SDL_GetPerformanceFrequency());
  before_ = now;
  io.DeltaTime = kind_ == Kind::kOffscreen ? kOffscreenFrame_s : static_cast<float>(std::clamp(passed_s, 1e-4, 1.0));
  int width = 0, height = 0;
  SDL_GetWindowSize(window_, &width, &height);
  io.DisplaySize = ImVec2(static_cast<float>(width), static_cast<float>(height));
  if (width > 0 && height > 0) {
    io.DisplayFramebufferScale =
        ImVec2(static_cast<float>(width_px()) / io.DisplaySize.x, static_cast<float>(height_px()) / io.DisplaySize.y);
  }
  glViewport(0, 0, width_px(), height_px());
  glClearColor(0.16f, 0.17f, 0.19f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL2_NewFrame();
  ImGui::NewFrame();
  return true;
}

void Window::EndFrame(Image* seen) {
  ImGui::Render();
  ImGui_ImplOpenGL2_RenderDrawData(ImGui::GetDrawData());
  if (seen != nullptr) *seen = Read();
  SDL_GL_SwapWindow(window_);
}

Image Window::Read() const {
  Image image{width_px(), height_px(), {}};
  const std::size_t row = 3 * static_cast<std::size_t>(image.width_px),
                    rows = static_cast<std::size_t>(image.height_px);
  std::vector<std::uint8_t> upward(row * rows);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, image.width_px, image.height_px, GL_RGB, GL_UNSIGNED_BYTE, upward.data());
  image.rgb.resize(upward.size());
  for (std::size_t y = 0; y < rows; ++y) std::memcpy(&image.rgb[y * row], &upward[(rows - 1 - y) * row], row);
  return image;
}

int Window::width_px() const {
  int width = 0, height = 0;
  SDL_GL_GetDrawableSize(window_, &width, &height);
  return width;
}

int Window::height_px() const {
  int width = 0, height = 0;
  SDL_GL_GetDrawableSize(window_, &width, &height);
  return height;
}

bool Window::busy() const { return input_->waiting(); }

void Window::StayOpen() { input_->Stay(); }

void Window::SetTitle(const std::string& title) { SDL_SetWindowTitle(window_, title.c_str()); }

}  // namespace rodeira::window
