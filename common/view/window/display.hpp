// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace rodeira::window {

// Whether the environment names a display. Without a name there is nobody to ask, and libraries that try complain
// aloud.
bool NamesDisplay();
// How it names it: "DISPLAY=:1"; empty where it does not.
std::string NamedDisplay();
// Whether a video driver of SDL shows anything to anybody; null: no driver. Where no display answers SDL draws for
// nobody.
bool IsDisplay(const char* driver);

}  // namespace rodeira::window
