// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "common/core/base/result.hpp"
#include "common/vehicle/input_devices/pad_driver.hpp"

struct _SDL_GameController;

namespace rodeira::nodes {

// The first game pad that is plugged in, by SDL's mapping of game controllers: no setup. Nothing here waits.
class GamePad {
 public:
  // Wrong input where SDL cannot look at devices at all. There need not be a pad: one that comes later is taken.
  static base::Result<std::unique_ptr<GamePad>> Start();
  ~GamePad();
  GamePad(const GamePad&) = delete;
  GamePad& operator=(const GamePad&) = delete;

  // Reads what it says; sees it come and go.
  void Update();
  const input_devices::PadReading& reading() const { return reading_; }
  // As it calls itself, once it was there.
  const std::string& name() const { return name_; }

 private:
  GamePad() = default;
  void Find();

  _SDL_GameController* pad_ = nullptr;
  std::string name_;
  input_devices::PadReading reading_;
};

}  // namespace rodeira::nodes
