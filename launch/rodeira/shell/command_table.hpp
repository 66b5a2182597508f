// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

// The commands of a program as a list, from its parser: the source of the manual page and of the shells' completion.
namespace rodeira::cli {

// An option or an argument of a command.
struct OptionEntry {
  std::vector<std::string> names;  // "--driver", "-o"; of an argument only its name, "LAUNCH.yaml"
  bool is_argument = false;
  bool required = false;
  bool takes_value = false;
  std::string value;  // in a manual: "standard|motors", "NUMBER", "FILE", "TEXT"; empty of a flag or an argument
  std::vector<std::string> choices;  // the only accepted words; empty: any
  std::string description;
};

// A command, and what it takes.
struct CommandEntry {
  std::string path;  // "rodeira world info"
  std::string description;
  std::vector<OptionEntry> options;   // arguments first; hidden options left out
  std::vector<std::string> commands;  // names of its own commands
};

// Depth first, in the order of declaration; the program itself comes first.
std::vector<CommandEntry> CommandTable(const CLI::App& app);

}  // namespace rodeira::cli
