// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/start_window/start_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "common/world/road/network_world.hpp"

namespace rodeira::cli {
namespace {

namespace fs = std::filesystem;

// Values in a launch file are relative to it; what lies elsewhere is named whole.
std::string Named(const fs::path& root, const fs::path& file) {
  const fs::path relative = file.lexically_relative(root);
  const bool within = !relative.empty() && *relative.begin() != "..";
  return within ? ("../" + relative.string()) : fs::absolute(file).lexically_normal().string();
}

// A path as a YAML text in double quotes.
std::string QuotedPath(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' || c == '\\' ? std::string{'\\', c} : std::string(1, c);
  return quoted + "\"";
}

std::string DriverValue(const StartFiles& files, const StartChoice& choice) {
  if (choice.driver == StartDriver::kKeyboard) return "{source: keyboard, keyboard: ../configs/drivers/keyboard.yaml}";
  if (choice.driver == StartDriver::kAutopilot) {
    return fmt::format("{{source: autopilot, driver: ../configs/drivers/default.yaml, vehicle: {}}}",
                       QuotedPath(Named(files.root, choice.vehicle)));
  }
  if (choice.driver == StartDriver::kPad) return "{source: gamepad}";
  return choice.wheel.empty()
             ? "{source: joystick, keyboard: ../configs/drivers/keyboard.yaml}"
             : fmt::format("{{source: joystick, wheel: {}}}", QuotedPath(Named(files.root, choice.wheel)));
}

}  // namespace

StartChoice DefaultChoice(const StartFiles& files) {
  const auto named = [](const std::vector<fs::path>& all, const char* name) {
    const auto found =
        std::find_if(all.begin(), all.end(), [name](const fs::path& file) { return file.filename() == name; });
    return found != all.end() ? *found : all.empty() ? fs::path() : all.front();
  };
  StartChoice choice;
  choice.world = named(files.worlds, "n222.yaml");
  choice.vehicle = named(files.vehicles, "default.yaml");
  if (!files.recordings.empty()) choice.recording = files.recordings.front();
  return choice;
}

std::string WhatIsMissing(const StartFiles& files, const StartChoice& choice) {
  std::error_code problem;
  if (choice.way == StartWay::kWatch) {
    if (choice.recording.empty()) return "choose a recording";
    return fs::is_regular_file(choice.recording, problem)
               ? ""
               : fmt::format("there is no file '{}'", choice.recording.string());
  }
  if (files.root.empty()) return "the folders launch and configs were found neither here nor beside the program";
  if (choice.world.empty()) return "choose a world";
  if (!fs::is_regular_file(choice.world, problem)) return fmt::format("there is no file '{}'", choice.world.string());
  const fs::path ending = choice.world.extension();
  if (ending != ".yaml" && !road::IsOpenDrive(choice.world) && ending != ".motors")
    return fmt::format("'{}' is no world; a file that ends on .yaml, .xodr or .motors was expected",
                       choice.world.string());
  if (choice.vehicle.empty()) return "choose a vehicle";
  return fs::is_regular_file(choice.vehicle, problem) ? ""
                                                      : fmt::format("there is no file '{}'", choice.vehicle.string());
}

std::vector<std::string> CommandOf(const StartFiles& files, const StartChoice& choice) {
  if (choice.way == StartWay::kWatch) return {"replay", choice.recording.string(), "--view"};
  std::vector<std::string> arguments{"run", (files.root / kStartLaunch).lexically_normal().string()};
  const auto set = [&](const std::string& key, const std::string& value) {
    arguments.emplace_back("--set");
    arguments.push_back(key + "=" + value);
  };
  set("world", QuotedPath(Named(files.root, choice.world)));
  set("nodes.ego.config.vehicle", QuotedPath(Named(files.root, choice.vehicle)));
  if (choice.driver != StartDriver::kKeyboard) set("nodes.driver.config", DriverValue(files, choice));
  if (choice.traffic > 0)
    set("nodes.traffic.config.vehicles", std::to_string(choice.traffic));
  else
    set("nodes.traffic.kind", "none");
  if (!choice.records) {
    set("nodes.recorder.kind", "none");
    arguments.emplace_back("--no-record");
  }
  return arguments;
}

std::string ShellText(const std::vector<std::string>& arguments) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("-_./=:,+@%").find(c) != std::string_view::npos;
  };
  std::string text = "rodeira";
  for (const std::string& argument : arguments) {
    text += ' ';
    if (!argument.empty() && std::all_of(argument.begin(), argument.end(), is_plain)) {
      text += argument;
      continue;
    }
    text += '\'';
    for (const char c : argument) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    text += '\'';
  }
  return text;
}

}  // namespace rodeira::cli
