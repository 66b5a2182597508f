// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/run_connection/key_forwarder.hpp"

#include <SDL.h>

#include <utility>
#include <vector>

namespace rodeira::nodes {
namespace {

// SDL's numbers of the buttons, in ours: left, middle, right, back, forward.
input_devices::Key MouseKey(Uint8 button) { return input_devices::kMouse + button; }

}  // namespace

void KeyForwarder::Take(const SDL_Event& event) {
  switch (event.type) {
    case SDL_KEYDOWN:
    case SDL_KEYUP:
      if (event.key.repeat == 0)
        Set(static_cast<input_devices::Key>(event.key.keysym.scancode), event.type == SDL_KEYDOWN);
      break;
    case SDL_MOUSEBUTTONDOWN:
    case SDL_MOUSEBUTTONUP:
      Set(MouseKey(event.button.button), event.type == SDL_MOUSEBUTTONDOWN);
      break;
    case SDL_WINDOWEVENT:
      if (event.window.event == SDL_WINDOWEVENT_FOCUS_LOST) ReleaseAll();
      break;
    default:
      break;
  }
}

void KeyForwarder::Set(input_devices::Key key, bool held) {
  const auto known = keys_.find(key);
  if (known == keys_.end() && !held) return;
  launch::LiveKey& entry = keys_[key];
  if (entry.held == held) return;
  entry.key = key;
  entry.held = held;
  if (held) ++entry.presses;
  changed_ = true;
}

void KeyForwarder::ReleaseAll() {
  for (auto& [key, entry] : keys_) Set(key, false);
}

void KeyForwarder::Tell(double now_s) {
  if (!changed_ && now_s - told_s_ < kRepeat_s) return;
  std::vector<launch::LiveKey> all;
  for (const auto& [key, entry] : keys_) all.push_back(entry);
  sender_->Say(std::move(all));
  changed_ = false;
  told_s_ = now_s;
}

}  // namespace rodeira::nodes
