// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/input_devices/device_access.hpp"

#include <fmt/format.h>

namespace rodeira::input_devices {
namespace {

DeviceAccess g_access;

base::Error NoAccess() {
  return base::WrongInput("device.not_built_in",
                          "this program reads no wheels or game pads: it was built without SDL2 (RODEIRA_VIEW=OFF)");
}

}  // namespace

void UseDeviceAccess(const DeviceAccess& access) { g_access = access; }
bool HasDeviceAccess() { return g_access.joysticks != nullptr; }

std::string ListJoysticks(const std::vector<JoystickInfo>& connected) {
  if (connected.empty()) return "no device is connected";
  std::string text = "connected: ";
  for (std::size_t i = 0; i < connected.size(); ++i)
    text += fmt::format("{}{} ('{}')", i == 0 ? "" : ", ", connected[i].guid, connected[i].name);
  return text;
}

base::Result<std::unique_ptr<Joysticks>> Joysticks::Start() {
  if (g_access.joysticks == nullptr) return NoAccess();
  return g_access.joysticks();
}

base::Result<std::unique_ptr<GamePad>> GamePad::Start() {
  if (g_access.game_pad == nullptr) return NoAccess();
  return g_access.game_pad();
}

}  // namespace rodeira::input_devices
