// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/vehicle/input_devices/wheel_driver.hpp"

struct _SDL_Joystick;

namespace rodeira::nodes {

// A device that is plugged in.
struct JoystickInfo {
  std::string name;
  std::string guid;
  int axes = 0;
  int buttons = 0;
  bool is_wheel = false;  // SDL knows it as a steering wheel; many are not known to it
};

// "'G29' 030000…, 'Pedals' 0300…", or "no device is connected".
std::string ListJoysticks(const std::vector<JoystickInfo>& connected);

// SDL's joysticks, raw: the game-controller layer leaves wheels out. Nothing here waits.
class Joysticks {
 public:
  // Wrong input where SDL cannot look at devices at all.
  static base::Result<std::unique_ptr<Joysticks>> Start();
  ~Joysticks();
  Joysticks(const Joysticks&) = delete;
  Joysticks& operator=(const Joysticks&) = delete;

  // Reads what all devices say; sees who comes and goes.
  void Update();
  std::vector<JoystickInfo> Connected() const;

  // Devices to be read, by GUID; their readings come in this order. Two with the same GUID are taken as they come.
  void Use(const std::vector<std::string>& guids);
  // The one of this place in the list; empty where it is not there.
  const input_devices::DeviceReading& reading(std::size_t place) const { return used_[place].reading; }
  const std::string& name(std::size_t place) const { return used_[place].name; }
  // SDL's own; null where it is not there. Another one, or none, after each Update.
  _SDL_Joystick* joystick(std::size_t place) const { return used_[place].joystick; }

 private:
  struct Used {
    std::string guid;
    std::string name;  // as the device calls itself, once it was there
    _SDL_Joystick* joystick = nullptr;
    input_devices::DeviceReading reading;
  };
  Joysticks() = default;
  void OpenMissing();
  static void Read(Used& used);

  std::vector<Used> used_;
};

}  // namespace rodeira::nodes
