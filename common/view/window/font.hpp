// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "common/core/base/font_file.hpp"

namespace rodeira::window {

using base::FontFile;

// The current Dear ImGui context writes with this file's letters: Latin, Greek, Cyrillic, punctuation and arrows; 13
// pixels, as high as its own. Its own, of which ASCII and Latin-1 are there, where there is no such file.
void UseFont(const std::filesystem::path& file);

}  // namespace rodeira::window
