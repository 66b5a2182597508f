// SPDX-License-Identifier: Apache-2.0
#include "common/view/window/input.hpp"

#include <imgui.h>

#include <array>
#include <cfloat>
#include <utility>

namespace rodeira::window {
namespace {

constexpr std::array<std::pair<ImGuiKey, SDL_Scancode>, 22> kKeys = {{{ImGuiKey_Tab, SDL_SCANCODE_TAB},
                                                                      {ImGuiKey_LeftArrow, SDL_SCANCODE_LEFT},
                                                                      {ImGuiKey_RightArrow, SDL_SCANCODE_RIGHT},
                                                                      {ImGuiKey_UpArrow, SDL_SCANCODE_UP},
                                                                      {ImGuiKey_DownArrow, SDL_SCANCODE_DOWN},
                                                                      {ImGuiKey_PageUp, SDL_SCANCODE_PAGEUP},
                                                                      {ImGuiKey_PageDown, SDL_SCANCODE_PAGEDOWN},
                                                                      {ImGuiKey_Home, SDL_SCANCODE_HOME},
                                                                      {ImGuiKey_End, SDL_SCANCODE_END},
                                                                      {ImGuiKey_Insert, SDL_SCANCODE_INSERT},
                                                                      {ImGuiKey_Delete, SDL_SCANCODE_DELETE},
                                                                      {ImGuiKey_Backspace, SDL_SCANCODE_BACKSPACE},
                                                                      {ImGuiKey_Space, SDL_SCANCODE_SPACE},
                                                                      {ImGuiKey_Enter, SDL_SCANCODE_RETURN},
                                                                      {ImGuiKey_Escape, SDL_SCANCODE_ESCAPE},
                                                                      {ImGuiKey_KeyPadEnter, SDL_SCANCODE_KP_ENTER},
                                                                      {ImGuiKey_A, SDL_SCANCODE_A},
                                                                      {ImGuiKey_C, SDL_SCANCODE_C},
                                                                      {ImGuiKey_V, SDL_SCANCODE_V},
                                                                      {ImGuiKey_X, SDL_SCANCODE_X},
                                                                      {ImGuiKey_Y, SDL_SCANCODE_Y},
                                                                      {ImGuiKey_Z, SDL_SCANCODE_Z}}};

int ButtonOf(const SDL_MouseButtonEvent& event) {
  switch (event.button) {
    case SDL_BUTTON_LEFT:
      return 0;
    case SDL_BUTTON_RIGHT:
      return 1;
    case SDL_BUTTON_MIDDLE:
      return 2;
    default:
      return -1;
  }
}

const char* ReadClipboard(void* user) {
  char*& held = *static_cast<char**>(user);
  SDL_free(held);
  held = SDL_GetClipboardText();
  return held;
}

void TakeKey(ImGuiIO& io, const SDL_KeyboardEvent& event) {
  const int scancode = event.keysym.scancode;
  if (scancode >= 0 && scancode < IM_ARRAYSIZE(io.KeysDown)) io.KeysDown[scancode] = event.type == SDL_KEYDOWN;
  io.KeyShift = (event.keysym.mod & KMOD_SHIFT) != 0;
  io.KeyCtrl = (event.keysym.mod & KMOD_CTRL) != 0;
  io.KeyAlt = (event.keysym.mod & KMOD_ALT) != 0;
}

void ReleaseAll(ImGuiIO& io) {
  for (bool& down : io.KeysDown) down = false;
  for (bool& down : io.MouseDown) down = false;
  io.KeyShift = io.KeyCtrl = io.KeyAlt = false;
}

}  // namespace

Input::Input() {
  ImGuiIO& io = ImGui::GetIO();
  for (const auto& [key, scancode] : kKeys) io.KeyMap[key] = scancode;
  io.ClipboardUserData = new char*(nullptr);
  io.GetClipboardTextFn = ReadClipboard;
  io.SetClipboardTextFn = [](void*, const char* text) { SDL_SetClipboardText(text); };
  io.MousePos = ImVec2(-FLT_MAX, -FLT_MAX);
}

Input::~Input() {
  char** held = static_cast<char**>(ImGui::GetIO().ClipboardUserData);
  SDL_free(*held);
  delete held;
}

bool Input::Take(int wait_ms) {
  SDL_Event event;
  if (events_.empty() && wait_ms > 0 && SDL_WaitEventTimeout(&event, wait_ms) == 1) events_.push_back(event);
  while (SDL_PollEvent(&event) == 1) events_.push_back(event);
  bool full = false;
  while (!events_.empty() && !full) {
    full = Give(events_.front());
    events_.pop_front();
  }
  // The letter of a key comes with it: a key that opens a field does not write into it.
  while (!events_.empty() && events_.front().type == SDL_TEXTINPUT) {
    Give(events_.front());
    events_.pop_front();
  }
  return !closing_;
}

// True: the frame has its press or release.
bool Input::Give(const SDL_Event& event) {
  ImGuiIO& io = ImGui::GetIO();
  switch (event.type) {
    case SDL_QUIT:
      closing_ = true;
      return true;
    case SDL_MOUSEMOTION:
      io.MousePos = ImVec2(static_cast<float>(event.motion.x), static_cast<float>(event.motion.y));
      return false;
    case SDL_MOUSEWHEEL:
      io.MouseWheel += event.wheel.preciseY != 0.0f ? event.wheel.preciseY : static_cast<float>(event.wheel.y);
      return false;
    case SDL_MOUSEBUTTONDOWN:
    case SDL_MOUSEBUTTONUP: {
      const int button = ButtonOf(event.button);
      io.MousePos = ImVec2(static_cast<float>(event.button.x), static_cast<float>(event.button.y));
      if (button >= 0) io.MouseDown[button] = event.type == SDL_MOUSEBUTTONDOWN;
      return button >= 0;
    }
    case SDL_TEXTINPUT:
      io.AddInputCharactersUTF8(event.text.text);
      return false;
    case SDL_KEYDOWN:
    case SDL_KEYUP:
      TakeKey(io, event.key);
      return true;
    case SDL_WINDOWEVENT:
      if (event.window.event == SDL_WINDOWEVENT_CLOSE) closing_ = true;
      if (event.window.event == SDL_WINDOWEVENT_FOCUS_LOST) ReleaseAll(io);
      return false;
    default:
      return false;
  }
}

}  // namespace rodeira::window
