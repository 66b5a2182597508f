// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/input_devices/key_names.hpp"

#include <algorithm>
#include <array>

namespace rodeira::input_devices {
namespace {

struct Named {
  Key key;
  std::string_view name;
};

// Beside the letters (4 …), the digits (30 …) and f1 to f12 (58 …).
constexpr std::array kNamed = std::to_array<Named>({
    {40, "return"},
    {41, "escape"},
    {42, "backspace"},
    {43, "tab"},
    {44, "space"},
    {45, "minus"},
    {46, "equals"},
    {51, "semicolon"},
    {52, "apostrophe"},
    {54, "comma"},
    {55, "period"},
    {56, "slash"},
    {73, "insert"},
    {74, "home"},
    {75, "page_up"},
    {76, "delete"},
    {77, "end"},
    {78, "page_down"},
    {79, "right"},
    {80, "left"},
    {81, "down"},
    {82, "up"},
    {84, "kp_divide"},
    {85, "kp_multiply"},
    {86, "kp_minus"},
    {87, "kp_plus"},
    {88, "kp_enter"},
    {89, "kp_1"},
    {90, "kp_2"},
    {91, "kp_3"},
    {92, "kp_4"},
    {93, "kp_5"},
    {94, "kp_6"},
    {95, "kp_7"},
    {96, "kp_8"},
    {97, "kp_9"},
    {98, "kp_0"},
    {224, "left_ctrl"},
    {225, "left_shift"},
    {226, "left_alt"},
    {228, "right_ctrl"},
    {229, "right_shift"},
    {230, "right_alt"},
    {kMouse + 1, "mouse_left"},
    {kMouse + 2, "mouse_middle"},
    {kMouse + 3, "mouse_right"},
    {kMouse + 4, "mouse_back"},
    {kMouse + 5, "mouse_forward"},
});

constexpr std::array kWindow = std::to_array<WindowKey>({
    {58, "f1", "menu; also a click in the upper right corner", false},
    {14, "k", "camera", false},
    {43, "tab", "choose and follow the next vehicle; with shift the one before", false},
    {9, "f", "full screen", false},
    {60, "f3", "statistics", true},
    {61, "f4", "mirrors", true},
    {62, "f5", "sound on or off", false},
    {67, "f10", "quieter", true},
    {68, "f11", "louder", false},
    {63, "f6", "place the car: with the next click", true},
    {59, "f2", "back to its start", false},
    {64, "f7", "another weather", false},
    {65, "f8", "statistics of the traffic over the ground", false},
    {66, "f9", "from above, and back", false},
    {69, "f12", "picture into a file", false},
    {11, "h", "this help", false},
    {41, "escape", "close the window (the run goes on)", false},
    {44, "space", "pause the run, and go on", true},
    {40, "return", "one step, and stand", false},
});

std::vector<std::pair<Key, std::string>> AllNames() {
  std::vector<std::pair<Key, std::string>> all;
  for (char letter = 'a'; letter <= 'z'; ++letter)
    all.emplace_back(static_cast<Key>(4 + letter - 'a'), std::string(1, letter));
  for (char digit = '1'; digit <= '9'; ++digit)
    all.emplace_back(static_cast<Key>(30 + digit - '1'), std::string(1, digit));
  all.emplace_back(39, "0");
  for (Key f = 1; f <= 12; ++f) all.emplace_back(57 + f, "f" + std::to_string(f));
  for (const Named& named : kNamed) all.emplace_back(named.key, named.name);
  return all;
}

const std::vector<std::pair<Key, std::string>>& Names() {
  static const auto kNames = AllNames();
  return kNames;
}

}  // namespace

std::optional<Key> KeyOf(std::string_view name) {
  const auto found =
      std::find_if(Names().begin(), Names().end(), [name](const auto& entry) { return entry.second == name; });
  return found == Names().end() ? std::nullopt : std::optional(found->first);
}

std::string NameOf(Key key) {
  const auto found =
      std::find_if(Names().begin(), Names().end(), [key](const auto& entry) { return entry.first == key; });
  return found == Names().end() ? "?" : found->second;
}

std::vector<std::string> KeyNames() {
  std::vector<std::string> names;
  for (const auto& entry : Names()) names.push_back(entry.second);
  return names;
}

std::span<const WindowKey> WindowKeys() { return kWindow; }

std::string WindowKeysText(const std::function<bool(const WindowKey&)>& wanted) {
  std::string text, names, does;
  for (const WindowKey& key : kWindow) {
    if (wanted(key)) {
      names += (names.empty() ? "" : " ") + std::string(key.name);
      does += (does.empty() ? "" : "; ") + std::string(key.does);
    }
    if (key.goes_on || names.empty()) continue;
    text += (text.empty() ? "" : "\n") + names + "  " + does;
    names.clear(), does.clear();
  }
  return text;
}

const WindowKey* FindWindowKey(Key key) {
  const auto found =
      std::find_if(kWindow.begin(), kWindow.end(), [key](const WindowKey& window) { return window.key == key; });
  return found == kWindow.end() ? nullptr : &*found;
}

}  // namespace rodeira::input_devices
