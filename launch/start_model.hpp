#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rodeira::front {

// What may be chosen in the start window.
struct StartFiles {
  std::filesystem::path root;                      // the folder that holds launch/ and configs/; empty: none was found
  std::vector<std::filesystem::path> worlds;       // by name
  std::vector<std::filesystem::path> vehicles;     // by name
  std::vector<std::filesystem::path> wheels;       // set up by `rodeira input setup`, by name
  std::vector<std::filesystem::path> recordings;   // the newest first, at most kRecent
  static constexpr std::size_t kRecent = 12;
};

// Looks in `root` and in the user's folders. What cannot be read is not there.
StartFiles FindStartFiles(const std::filesystem::path& root, const std::filesystem::path& data, const std::filesystem::path& config);
// The folder with launch/ and configs/ at or above one of these, the nearest first; empty where there is none.
std::filesystem::path FindStartRoot(const std::vector<std::filesystem::path>& near);

enum class StartDriver { kKeyboard, kWheel, kPad, kAutopilot };
enum class StartWay { kDrive, kWatch };

struct StartChoice {
  StartWay way = StartWay::kDrive;
  std::filesystem::path world, vehicle;
  StartDriver driver = StartDriver::kKeyboard;
  std::filesystem::path wheel;   // of kWheel; empty: the one that is plugged in
  int traffic = 20;              // cars; 0: none
  bool records = true;
  std::filesystem::path recording;  // of kWatch
};

// N222 with the default car, where they are; otherwise the first of each.
StartChoice DefaultChoice(const StartFiles& files);

// What is still missing, as a sentence; empty where the command can be given.
std::string WhatIsMissing(const StartFiles& files, const StartChoice& choice);

// The arguments behind `rodeira` that do what was chosen.
std::vector<std::string> CommandOf(const StartFiles& files, const StartChoice& choice);
// As a person would type it in a shell.
std::string ShellText(const std::vector<std::string>& arguments);

}  // namespace rodeira::front
