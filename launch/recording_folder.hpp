#pragma once

#include <filesystem>

namespace rodeira::front {

// Where recordings go that are given no name: $XDG_DATA_HOME/rodeira, else ~/.local/share/rodeira.
std::filesystem::path RecordingFolder();

}  // namespace rodeira::front
