// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "launch/rodeira/shell/command_table.hpp"

namespace rodeira::cli {

// Manual page rodeira(1) in the language of man(7), from the same texts as --help.
std::string ManualPage(const std::vector<CommandEntry>& table, const std::string& version);

}  // namespace rodeira::cli
