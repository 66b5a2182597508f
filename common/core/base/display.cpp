// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/display.hpp"

#include <cstdlib>

namespace rodeira::base {

std::string NamedDisplay() {
  for (const char* variable : {"WAYLAND_DISPLAY", "DISPLAY"}) {
    const char* name = std::getenv(variable);
    if (name != nullptr && *name != '\0') return std::string(variable) + "=" + name;
  }
  return "";
}

bool NamesDisplay() { return !NamedDisplay().empty(); }

}  // namespace rodeira::base
