// SPDX-License-Identifier: Apache-2.0
#include "nodes/input/found_source.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <optional>
#include <utility>
#include <vector>

#include "common/core/base/log.hpp"
#include "common/vehicle/input_devices/device_access.hpp"
#include "common/vehicle/input_devices/game_pad.hpp"
#include "common/vehicle/input_devices/joysticks.hpp"
#include "common/vehicle/input_devices/plain_wheel.hpp"
#include "common/vehicle/input_devices/wheel_setup.hpp"
#include "nodes/input/joystick_source.hpp"
#include "nodes/input/keyboard_source.hpp"
#include "nodes/input/pad_source.hpp"

namespace rodeira::nodes {
namespace {

// What the search has come by.
struct Search {
  std::string node;
  std::vector<input_devices::JoystickInfo> connected;
  std::optional<input_devices::JoystickInfo> broken;  // the first device with a file that cannot be used

  void Say(const std::string& sentence) const { base::Log(base::LogLevel::kInfo, node, sentence); }
};

// Null: none of them was set up, or not well.
std::unique_ptr<Source> OwnWheel(Search& search, const config::Map& config) {
  for (const input_devices::JoystickInfo& info : search.connected) {
    const std::filesystem::path file = input_devices::WheelFileOf(info.guid);
    std::error_code problem;
    if (!std::filesystem::exists(file, problem)) continue;
    auto source = OpenWheelFile(file, config, search.node);
    if (source) return std::move(source).value();
    search.Say(fmt::format("{}; '{}' is not driven by this file (`rodeira input setup` writes a new one)",
                           source.error().Text(), info.name));
    if (!search.broken) search.broken = info;
  }
  return nullptr;
}

// Null: it cannot be guessed at. `why` it has to be.
std::unique_ptr<Source> Guess(const Search& search, const input_devices::JoystickInfo& info, const char* why) {
  const auto wheel = input_devices::PlainWheel({"wheel", info.guid, ""}, static_cast<std::size_t>(info.axes),
                                               static_cast<std::size_t>(info.buttons));
  if (!wheel) return nullptr;
  auto source = OpenWheel(*wheel, search.node);
  if (!source) return nullptr;
  search.Say(fmt::format("'{}' drives by a guess: {}{}", info.name, input_devices::AxesText(*wheel), why));
  return std::move(source).value();
}

// A wheel that was plugged in and never set up is meant to drive all the same.
std::unique_ptr<Source> NewWheel(const Search& search) {
  for (const input_devices::JoystickInfo& info : search.connected) {
    std::error_code problem;
    if (!info.is_wheel || std::filesystem::exists(input_devices::WheelFileOf(info.guid), problem)) continue;
    if (auto source =
            Guess(search, info, "; it was not set up: `rodeira input setup` finds its axes, ends and buttons"))
      return source;
  }
  return nullptr;
}

std::unique_ptr<Source> AnyPad(const Search& search) {
  auto pad = input_devices::GamePad::Start();
  if (!pad || !pad.value()->reading().connected) return nullptr;
  search.Say(fmt::format("no wheel that was set up is there; the game pad '{}' drives", pad.value()->name()));
  return MakePadSource(search.node, std::move(pad).value());
}

}  // namespace

base::Result<std::unique_ptr<Source>> MakeFoundSource(const config::Map& config, launch::NodeContext& context) {
  const bool has_keys = config.OptionalPath("keyboard").has_value();
  config.IgnoreKey("devices");
  if (auto status = context.launch().file().Finish(); !status) return status.error();
  Search search{context.spec().name, {}, std::nullopt};
  if (input_devices::HasDeviceAccess() || !has_keys) {
    auto joysticks = input_devices::Joysticks::Start();
    if (!joysticks) return joysticks.error();
    joysticks.value()->Update();
    search.connected = joysticks.value()->Connected();
  }
  auto wheel = OwnWheel(search, config);
  if (auto status = context.launch().file().Finish(); !status) return status.error();  // GUIDs that it says
  if (wheel != nullptr) return wheel;
  if (auto guessed = NewWheel(search)) return guessed;
  if (auto pad = AnyPad(search)) return pad;
  if (search.broken) {
    if (auto guessed = Guess(search, *search.broken, "")) return guessed;
  }
  if (has_keys) {
    search.Say(fmt::format(
        "no wheel that was set up (`rodeira input setup`) and no game pad is there ({}); the windows' keys drive",
        input_devices::ListJoysticks(search.connected)));
    return MakeKeyboardSource(config, context);
  }
  return base::WrongInput(
      "device.not_found",
      fmt::format("no 'wheel' is named, and none of the devices was set up (`rodeira input setup`) in {}; {}",
                  input_devices::WheelFolder().string(), input_devices::ListJoysticks(search.connected)),
      config.Place());
}

}  // namespace rodeira::nodes
