#pragma once

#include <filesystem>

namespace rodeira::window {

// Where DejaVu Sans is installed (Debian's fonts-dejavu-core); empty where it is not.
std::filesystem::path FontFile();

// The current Dear ImGui context writes with this file's letters: Latin, Greek, Cyrillic, punctuation and arrows; 13 pixels, as high as its own.
// Its own, of which ASCII and Latin-1 are there, where there is no such file.
void UseFont(const std::filesystem::path& file);

}  // namespace rodeira::window
