// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "launch/rodeira/commands/world_command.hpp"
#include "tests/launch/rodeira/said.hpp"

namespace rodeira::cli {

// `rodeira world COMMAND WORLD [-o FOLDER]`, without its progress.
inline Said AskedOfWorld(const std::string& command, const std::filesystem::path& world,
                         const std::filesystem::path& folder = {}) {
  WorldOptions options;
  options.command = command;
  options.world_file = world;
  options.out = folder;
  options.quiet = true;
  return SaidBy<WorldOptions>(World, options);
}

}  // namespace rodeira::cli
