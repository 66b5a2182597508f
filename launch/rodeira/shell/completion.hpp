// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "launch/rodeira/shell/command_table.hpp"

// Completion of the command line by the Tab key.
namespace rodeira::cli {

// Script for bash-completion: commands, options, accepted words, names of launch files, worlds and vehicles, and files.
std::string BashCompletion(const std::vector<CommandEntry>& table);
// The same for zsh, with the descriptions of commands and options.
std::string ZshCompletion(const std::vector<CommandEntry>& table);

}  // namespace rodeira::cli
