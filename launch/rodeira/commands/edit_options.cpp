// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/all_commands.hpp"

#include <memory>

#include "launch/rodeira/commands/edit_command.hpp"

namespace rodeira::cli {

void AddEdit(CLI::App& app, ChosenCommand& chosen) {
  const auto options = std::make_shared<EditOptions>();
  CLI::App* edit = app.add_subcommand("edit", "draw a traffic map in a window");
  edit->add_option("FILE.motors", options->file, "traffic map; a new one otherwise");
  chosen.When(*edit, [options] { return Edit(*options); });
}

}  // namespace rodeira::cli
