// SPDX-License-Identifier: Apache-2.0
#include "common/view/window/display.hpp"

#include <cstdlib>
#include <string_view>

namespace rodeira::window {

std::string NamedDisplay() {
  for (const char* variable : {"WAYLAND_DISPLAY", "DISPLAY"}) {
    const char* name = std::getenv(variable);
    if (name != nullptr && *name != '\0') return std::string(variable) + "=" + name;
  }
  return "";
}

bool NamesDisplay() { return !NamedDisplay().empty(); }

bool IsDisplay(const char* driver) {
  const std::string_view name = driver != nullptr ? driver : "";
  return !name.empty() && name != "offscreen" && name != "dummy";
}

}  // namespace rodeira::window
