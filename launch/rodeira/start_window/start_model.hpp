// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "launch/rodeira/start_window/start_files.hpp"

namespace rodeira::cli {

enum class StartDriver { kKeyboard, kWheel, kPad, kAutopilot };
enum class StartWay { kDrive, kWatch };

// What a person has chosen in the start window.
struct StartChoice {
  StartWay way = StartWay::kDrive;
  std::filesystem::path world, vehicle;
  StartDriver driver = StartDriver::kKeyboard;
  std::filesystem::path wheel;  // of kWheel; empty: the one that is plugged in
  int traffic = 20;             // cars; 0: none
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

}  // namespace rodeira::cli
