// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rodeira::cli {

// What may be chosen in the start window.
struct StartFiles {
  std::filesystem::path root;                     // the folder that holds launch/ and configs/; empty: none was found
  std::vector<std::filesystem::path> worlds;      // by name
  std::vector<std::filesystem::path> vehicles;    // by name
  std::vector<std::filesystem::path> wheels;      // set up by `rodeira input setup`, by name
  std::vector<std::filesystem::path> recordings;  // the newest first, at most kRecent
  static constexpr std::size_t kRecent = 12;
  std::filesystem::path data;  // the user's folder in which recordings are

  // Looks for recordings again: runs have ended meanwhile.
  void FindRecordings();
};

// Looks in `root` and in the user's folders. Worlds and vehicles are those of FindInputFiles. Unreadable directories
// count as empty.
StartFiles FindStartFiles(const std::filesystem::path& root, const std::filesystem::path& data,
                          const std::filesystem::path& config);
// The folder with launch/ and configs/ at or above one of these, the nearest first; empty where there is none.
std::filesystem::path FindStartRoot(const std::vector<std::filesystem::path>& near);

// The launch file that every drive of the start window begins with, from `root` on.
inline constexpr const char* kStartLaunch =
    "launch/keyboard.yaml";  // road, driver, ego, traffic, story, recorder, view

// A file as a person reads it in a list: what stands behind configs/worlds or configs/vehicles, a neighbour of launch
// by its name, others whole.
std::string ShownName(const std::filesystem::path& root, const std::filesystem::path& file);

}  // namespace rodeira::cli
