#include "launch/recording_folder.hpp"

#include <cstdlib>

namespace rodeira::front {

std::filesystem::path RecordingFolder() {
  const char* data = std::getenv("XDG_DATA_HOME");
  if (data != nullptr && *data != '\0') return std::filesystem::path(data) / "rodeira";
  const char* home = std::getenv("HOME");
  return std::filesystem::path(home != nullptr ? home : ".") / ".local/share/rodeira";
}

}  // namespace rodeira::front
