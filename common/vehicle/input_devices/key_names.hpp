// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rodeira::input_devices {

// A key by its place on the keyboard: the usage number of page 7 of the USB HID tables, which is SDL's scancode too.
// Names are those of a US keyboard: where a French one prints z and q, w and a are found. From kMouse on: buttons of
// the mouse.
using Key = std::uint32_t;
inline constexpr Key kMouse = 512;  // + 1 left, 2 middle, 3 right, 4 and 5 the thumb's

// Nothing for an unknown name; case counts.
std::optional<Key> KeyOf(std::string_view name);
// "?" where the key has none.
std::string NameOf(Key key);
std::vector<std::string> KeyNames();

// What a window keeps for itself: no car is driven by these.
struct WindowKey {
  Key key;
  std::string_view name;
  std::string_view does;
  bool goes_on;  // in a help it shares a line with the next one
};
// In the order of the help.
std::span<const WindowKey> WindowKeys();
// As a help shows those that are wanted: "f10 f11  quieter; louder", a line or several.
std::string WindowKeysText(const std::function<bool(const WindowKey&)>& wanted);
// Null where the key may drive.
const WindowKey* FindWindowKey(Key key);

}  // namespace rodeira::input_devices
