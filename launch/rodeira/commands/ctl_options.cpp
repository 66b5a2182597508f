// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/all_commands.hpp"

#include <memory>

#include "launch/rodeira/run/ctl_command.hpp"

namespace rodeira::cli {

void AddCtl(CLI::App& app, ChosenCommand& chosen) {
  const auto options = std::make_shared<CtlOptions>();
  CLI::App* ctl = app.add_subcommand(
      "ctl",
      "control a running simulation: pause | resume | step [N] | pace X | mark TEXT | stop | restart NODE | state");
  ctl->add_option("COMMAND", options->words, "what to do")->required();
  ctl->add_option("--run", options->run, "name of the run; the only one otherwise");
  chosen.When(*ctl, [options] { return Ctl(*options); });
}

}  // namespace rodeira::cli
