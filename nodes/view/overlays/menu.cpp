// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/overlays/menu.hpp"

#include <SDL.h>
#include <SDL_opengl.h>
#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <cstdlib>
#include <deque>
#include <string>

#include "common/view/window/font.hpp"
#include "common/world/weather/named_weather.hpp"

namespace rodeira::nodes {
namespace {

constexpr float kWidth_px = 236.0F, kMargin_px = 8.0F;
constexpr int kCorner_px = 130, kCornerHeight_px = 70;  // the button comes where the mouse is there
constexpr float kButtonWidth_px = 70.0F, kButtonHeight_px = 26.0F;
constexpr float kFrame_s = 1.0F / 60.0F;
constexpr int kSettles =
    3;  // pictures: a panel finds its size by being drawn, and what was clicked is seen in the next one
constexpr int kOldestMajor = 3;  // of OpenGL

bool CanDraw() {
  const auto* version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
  return version != nullptr && std::atoi(version) >= kOldestMajor;
}

// A button that does what a key does, and names it.
void Key(const char* label, const char* name, int symbol, MenuRequest& request) {
  if (ImGui::Button(fmt::format("{}  ({})###{}", label, name, label).c_str(), {-FLT_MIN, 0.0F})) request.key = symbol;
}

void Switch(const char* label, const char* name, bool is, int symbol, MenuRequest& request) {
  bool box = is;
  if (ImGui::Checkbox(fmt::format("{}  ({})###{}", label, name, label).c_str(), &box)) request.key = symbol;
}

}  // namespace

struct Menu::Panels {
  Panels() : context(ImGui::CreateContext()) {
    ImGui::SetCurrentContext(context);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;  // where it stands is in no file
    io.MousePos = ImVec2(-FLT_MAX, -FLT_MAX);
    ImGui::StyleColorsDark();
    ImGui::GetStyle().WindowRounding = ImGui::GetStyle().FrameRounding = 3.0F;
    window::UseFont(window::FontFile());
    draws = CanDraw() && ImGui_ImplOpenGL3_Init("#version 120");
  }
  ~Panels() {
    ImGui::SetCurrentContext(context);
    if (draws) ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext(context);
  }
  Panels(const Panels&) = delete;
  Panels& operator=(const Panels&) = delete;

  ImGuiContext* context;
  bool draws = false;
  std::deque<bool> presses;  // of the left button, one a frame, so that a click between two frames is one
};

Menu::Menu() = default;
Menu::~Menu() = default;

bool Menu::Place::Holds(int x_px, int y_px) const {
  const auto x = static_cast<float>(x_px), y = static_cast<float>(y_px);
  return x >= left && x < right && y >= top && y < bottom;
}

void Menu::Toggle() {
  open_ = !open_;
  unrest_ = kSettles;
}

bool Menu::Take(const SDL_Event& event) {
  const bool was_near = near_, taken = Sort(event);
  if (taken || near_ != was_near) unrest_ = kSettles;
  return taken;
}

bool Menu::Sort(const SDL_Event& event) {
  const auto at = [this](int x_px, int y_px) {
    near_ = width_px_ > 0 && x_px >= width_px_ - kCorner_px && y_px < kCornerHeight_px;
    if (panels_ == nullptr) return;
    ImGui::SetCurrentContext(panels_->context);
    ImGui::GetIO().MousePos = ImVec2(static_cast<float>(x_px), static_cast<float>(y_px));
  };
  switch (event.type) {
    case SDL_MOUSEMOTION:
      at(event.motion.x, event.motion.y);
      return held_ || (open_ && event.motion.state == 0 && place_.Holds(event.motion.x, event.motion.y));
    case SDL_MOUSEBUTTONDOWN:
    case SDL_MOUSEBUTTONUP: {
      at(event.button.x, event.button.y);
      const bool down = event.type == SDL_MOUSEBUTTONDOWN, left = event.button.button == SDL_BUTTON_LEFT;
      if (!down && !(held_ && left)) return false;
      if (down && !place_.Holds(event.button.x, event.button.y)) return false;
      if (!left) return true;
      held_ = down;
      if (panels_ != nullptr) panels_->presses.push_back(down);
      return true;
    }
    case SDL_MOUSEWHEEL:
      if (!open_ || panels_ == nullptr) return false;
      ImGui::SetCurrentContext(panels_->context);
      if (const ImVec2 mouse = ImGui::GetIO().MousePos;
          !place_.Holds(static_cast<int>(mouse.x), static_cast<int>(mouse.y)))
        return false;
      ImGui::GetIO().MouseWheel += static_cast<float>(event.wheel.y);
      return true;
    default:
      return false;
  }
}

MenuRequest Menu::Draw(const MenuSight& sight, int width_px, int height_px) {
  width_px_ = width_px;
  place_ = {};
  unrest_ = std::max(unrest_ - 1, 0);
  MenuRequest request;
  if (!open_ && !near_) return request;
  if (panels_ == nullptr) panels_ = std::make_unique<Panels>();
  if (!panels_->draws) return request;
  ImGui::SetCurrentContext(panels_->context);
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = ImVec2(static_cast<float>(width_px), static_cast<float>(height_px));
  io.DeltaTime = kFrame_s;
  if (!panels_->presses.empty()) {
    io.MouseDown[0] = panels_->presses.front();
    panels_->presses.pop_front();
  }
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                      ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                      ImGuiWindowFlags_AlwaysAutoResize;
  ImGui::SetNextWindowPos({io.DisplaySize.x - kMargin_px, kMargin_px}, ImGuiCond_Always, {1.0F, 0.0F});
  if (open_) {
    ImGui::SetNextWindowSizeConstraints({kWidth_px, 0.0F}, {kWidth_px, io.DisplaySize.y - 2.0F * kMargin_px});
    ImGui::Begin("menu", nullptr, kFixed);
    request = DrawEntries(sight);
  } else {
    ImGui::Begin("closed", nullptr, kFixed | ImGuiWindowFlags_NoBackground);
    open_ = ImGui::Button("menu", {kButtonWidth_px, kButtonHeight_px});
  }
  const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  place_ = {at.x, at.y, at.x + size.x, at.y + size.y};
  ImGui::End();
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  return request;
}

MenuRequest Menu::DrawEntries(const MenuSight& sight) {
  MenuRequest request;
  if (ImGui::Button("close the menu  (f1)###close", {-FLT_MIN, 0.0F})) open_ = false;
  ImGui::TextUnformatted("camera  (k)");
  const auto cameras = scene::CameraNames();
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (i % 2 != 0) ImGui::SameLine(0.5F * kWidth_px);
    const auto kind = static_cast<scene::CameraKind>(i);
    if (ImGui::RadioButton(std::string(cameras[i]).c_str(), kind == sight.camera)) request.camera = kind;
  }
  Key("next vehicle", "tab", SDLK_TAB, request);
  Key("from above, and back", "f9", SDLK_F9, request);
  Key("statistics on the ground", "f8", SDLK_F8, request);
  ImGui::Separator();
  Switch("mirrors", "f4", sight.mirrors, SDLK_F4, request);
  Switch("statistics", "f3", sight.statistics, SDLK_F3, request);
  Switch("all keys", "h", sight.help, SDLK_h, request);
  Switch("sound", "f5", sight.sound, SDLK_F5, request);
  auto volume = static_cast<float>(100.0 * sight.volume);
  ImGui::SetNextItemWidth(0.5F * kWidth_px);
  if (ImGui::SliderFloat("volume", &volume, 0.0F, 100.0F, "%.0f %%"))
    request.volume = static_cast<double>(volume) / 100.0;
  if (sight.live) {
    ImGui::Separator();
    Key("place the car by a click", "f6", SDLK_F6, request);
    Key("back to the start", "f2", SDLK_F2, request);
    ImGui::TextUnformatted("weather  (f7)");
    const auto weathers = weather::NamedWeathers();
    for (std::size_t i = 0; i < weathers.size(); ++i) {
      if (i % 3 != 0) ImGui::SameLine();
      if (ImGui::SmallButton(std::string(weathers[i].name).c_str())) request.weather = i;
    }
    Key("pause, and go on", "space", SDLK_SPACE, request);
    Key("one step", "return", SDLK_RETURN, request);
  }
  ImGui::Separator();
  Key("picture into a file", "f12", SDLK_F12, request);
  Key("full screen", "f", SDLK_f, request);
  Key(sight.live ? "close the window" : "end", "esc", SDLK_ESCAPE, request);
  return request;
}

}  // namespace rodeira::nodes
