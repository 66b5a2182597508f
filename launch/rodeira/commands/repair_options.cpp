// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/all_commands.hpp"

#include <memory>
#include <string>

#include "launch/rodeira/commands/repair_command.hpp"

namespace rodeira::cli {

void AddRepair(CLI::App& app, ChosenCommand& chosen) {
  const auto file = std::make_shared<std::string>();
  const auto out = std::make_shared<std::string>();
  CLI::App* repair = app.add_subcommand("repair", "write the readable part of a damaged recording as a valid one");
  repair->add_option("FILE.mcap", *file, "recording")->required();
  repair->add_option("--out", *out, "the new file")->required();
  chosen.When(*repair, [file, out] { return RepairRecording(*file, *out); });
}

}  // namespace rodeira::cli
