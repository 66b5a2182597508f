// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/joysticks_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>

#include "common/core/base/print_error.hpp"
#include "common/vehicle/input_devices/device_access.hpp"
#include "launch/rodeira/graphics/graphics.hpp"
#include "launch/rodeira/interrupt.hpp"
#include "launch/rodeira/wall_clock.hpp"

namespace rodeira::cli {
namespace {

constexpr double kMoved = 655.0;  // a hundredth of an axis' whole way

void PrintMoves(input_devices::Joysticks& joysticks, const std::vector<input_devices::JoystickInfo>& connected,
                std::optional<double> duration_s) {
  CatchInterrupts();
  std::vector<std::string> guids;
  for (const input_devices::JoystickInfo& info : connected) guids.push_back(info.guid);
  joysticks.Use(guids);
  std::vector<input_devices::DeviceReading> before;
  for (std::size_t place = 0; place < guids.size(); ++place) before.push_back(joysticks.reading(place));
  const auto begin = WallClock::now();
  while (!Interrupted() && (!duration_s || SecondsSince(begin) < *duration_s)) {
    joysticks.Update();
    for (std::size_t place = 0; place < guids.size(); ++place) {
      fmt::print("{}", JoystickMoves(connected[place].name, before[place], joysticks.reading(place)));
    }
    std::fflush(stdout);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

}  // namespace

std::string JoystickTable(const std::vector<input_devices::JoystickInfo>& connected) {
  if (connected.empty()) return "no device is connected (or none that you may read: `rodeira doctor`)\n";
  std::string text = fmt::format("{:<32}  {:>4}  {:>7}  {}\n", "GUID", "axes", "buttons", "name");
  for (const input_devices::JoystickInfo& info : connected)
    text += fmt::format("{:<32}  {:>4}  {:>7}  {}\n", info.guid, info.axes, info.buttons, info.name);
  return text;
}

std::string JoystickMoves(const std::string& device, input_devices::DeviceReading& before,
                          const input_devices::DeviceReading& now) {
  std::string text;
  if (before.connected != now.connected)
    text += fmt::format("{}: {}\n", device, now.connected ? "is there" : "was unplugged");
  if (before.connected != now.connected || before.axes.size() != now.axes.size() ||
      before.buttons.size() != now.buttons.size()) {
    before = now;
    return text;
  }
  for (std::size_t axis = 0; axis < now.axes.size(); ++axis) {
    if (std::fabs(now.axes[axis] - before.axes[axis]) < kMoved) continue;
    text += fmt::format("{}: axis {}: {:.0f} -> {:.0f}\n", device, axis, before.axes[axis], now.axes[axis]);
    before.axes[axis] = now.axes[axis];
  }
  for (std::size_t button = 0; button < now.buttons.size(); ++button) {
    if (now.buttons[button] == before.buttons[button]) continue;
    text += fmt::format("{}: button {}: {}\n", device, button, now.buttons[button] != 0 ? "down" : "up");
    before.buttons[button] = now.buttons[button];
  }
  return text;
}

int ListJoysticks(const JoysticksOptions& options) {
  if (!input_devices::HasDeviceAccess()) return ContinueInGraphics("joysticks");
  auto joysticks = input_devices::Joysticks::Start();
  if (!joysticks) return base::PrintError("rodeira", joysticks.error());
  joysticks.value()->Update();
  const auto connected = joysticks.value()->Connected();
  fmt::print("{}", JoystickTable(connected));
  if (!options.watch || connected.empty()) return 0;
  fmt::print("move or press one thing at a time; Ctrl-C ends\n");
  PrintMoves(*joysticks.value(), connected, options.duration_s);
  return 0;
}

Finding CheckJoysticks(const std::vector<input_devices::JoystickInfo>& connected,
                       const std::filesystem::path& input_folder) {
  const std::string check = "joysticks";
  int closed = 0;
  std::error_code problem;
  for (const auto& entry : std::filesystem::directory_iterator(input_folder, problem)) {
    if (entry.path().filename().string().starts_with("event") && ::access(entry.path().c_str(), R_OK) != 0) ++closed;
  }
  // Keyboards and mice are among these, and closed to all users but root: only with no joystick at all is it worth a
  // word.
  if (connected.empty() && closed > 0) {
    return Warning(
        "device.not_readable", check,
        fmt::format(
            "none, but {} devices in {} may not be read: if a wheel is plugged in, add yourself to the group input "
            "(sudo usermod -aG input $USER) and log in again",
            closed, input_folder.string()));
  }
  if (connected.empty()) return Ok(check, "none is connected (only `source: joystick` needs one)");
  std::string names;
  for (const input_devices::JoystickInfo& info : connected)
    names += fmt::format("{}{} '{}' ({} axes, {} buttons)", names.empty() ? "" : ", ", info.guid, info.name, info.axes,
                         info.buttons);
  return Ok(check, names);
}

}  // namespace rodeira::cli
