// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/all_commands.hpp"

#include <memory>
#include <string>

#include "launch/rodeira/commands/info_command.hpp"

namespace rodeira::cli {

void AddInfo(CLI::App& app, ChosenCommand& chosen) {
  const auto file = std::make_shared<std::string>();
  CLI::App* info = app.add_subcommand("info", "contents of a recording, and whether samples are missing");
  info->add_option("FILE.mcap", *file, "recording")->required();
  chosen.When(*info, [file] { return Info(*file); });
}

}  // namespace rodeira::cli
