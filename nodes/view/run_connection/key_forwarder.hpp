// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>

#include "common/runtime/launch/live_keys.hpp"
#include "common/vehicle/input_devices/key_names.hpp"

union SDL_Event;

namespace rodeira::nodes {

// Gathers what is held in the window and says it to the node that drives: at every change, and again every kRepeat_s,
// because a message may be lost. Without the keyboard's focus nothing is held. Used on the thread of the window.
class KeyForwarder {
 public:
  static constexpr double kRepeat_s = 0.05;

  explicit KeyForwarder(std::unique_ptr<launch::LiveKeysSender> sender) : sender_(std::move(sender)) {}

  // Keys, mouse buttons, and the loss of focus; everything else is passed over. Not for keys that the window keeps
  // itself.
  void Take(const SDL_Event& event);
  // All keys count as up; Tell says so.
  void ReleaseAll();
  // Says what is due.
  void Tell(double now_s);

 private:
  void Set(input_devices::Key key, bool held);

  std::unique_ptr<launch::LiveKeysSender> sender_;
  std::map<input_devices::Key, launch::LiveKey> keys_;
  bool changed_ = true;
  double told_s_ = -1.0e9;
};

}  // namespace rodeira::nodes
