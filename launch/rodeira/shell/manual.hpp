// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "launch/rodeira/shell/command_table.hpp"

namespace rodeira::cli {

// Manual page rodeira(1) in the language of man(7), from the same texts as --help.
std::string ManualPage(const std::vector<CommandEntry>& table, const std::string& version);
// The commands and options as Markdown, for the reference: a section `## ` for each command of the program, and inside
// it
// `### ` for each command of that one. Options that the program itself has stand in its own section only.
std::string ManualMarkdown(const std::vector<CommandEntry>& table);

}  // namespace rodeira::cli
