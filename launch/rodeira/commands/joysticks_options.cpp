// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/all_commands.hpp"

#include <memory>

#include "launch/rodeira/commands/joysticks_command.hpp"
#include "launch/rodeira/option_errors.hpp"

namespace rodeira::cli {

void AddJoysticks(CLI::App& app, ChosenCommand& chosen) {
  const auto options = std::make_shared<JoysticksOptions>();
  CLI::App* joysticks = app.add_subcommand("joysticks", "connected wheels and joysticks, with their GUIDs");
  CLI::Option* watch = joysticks->add_flag("--watch", options->watch, "say which axis and button moves");
  joysticks->add_option("--for", options->duration_s, "seconds of watching")->check(PositiveSeconds())->needs(watch);
  chosen.When(*joysticks, [options] { return ListJoysticks(*options); });
}

}  // namespace rodeira::cli
