// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace rodeira::base {

// Whether the environment names a display. Without one, libraries that try to open a display print errors of their
// own.
bool NamesDisplay();
// The variable with its value: "DISPLAY=:1"; empty without a display.
std::string NamedDisplay();

}  // namespace rodeira::base
