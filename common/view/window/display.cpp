// SPDX-License-Identifier: Apache-2.0
#include "common/view/window/display.hpp"

#include <string_view>

namespace rodeira::window {

bool IsDisplay(const char* driver) {
  const std::string_view name = driver != nullptr ? driver : "";
  return !name.empty() && name != "offscreen" && name != "dummy";
}

}  // namespace rodeira::window
