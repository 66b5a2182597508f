// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace rodeira::base {

// Whether the environment names a display. Without a name there is no display to ask, and libraries that try complain
// aloud.
bool NamesDisplay();
// How it names it: "DISPLAY=:1"; empty where it does not.
std::string NamedDisplay();

}  // namespace rodeira::base
