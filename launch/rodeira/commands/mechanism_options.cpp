// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/all_commands.hpp"

#include <memory>

#include "launch/rodeira/commands/mechanism_command.hpp"
#include "launch/rodeira/option_errors.hpp"
#include "launch/rodeira/result_files.hpp"

namespace rodeira::cli {

void AddMechanism(CLI::App& app, ChosenCommand& chosen) {
  const auto options = std::make_shared<MechanismOptions>();
  CLI::App* mechanism = app.add_subcommand("mechanism", "multibody mechanisms, alone");
  mechanism->require_subcommand(1);
  CLI::App* run = mechanism->add_subcommand("run", "simulate a mechanism file");
  run->add_option("MECHANISM.yaml", options->file, "mechanism file")->required();
  run->add_option("--until", options->until_s, "simulated seconds")->required()->check(PositiveSeconds());
  run->add_option("--step", options->step_s, "step in seconds")->required()->check(PositiveSeconds());
  run->add_option("--csv", options->csv, "write the outputs of every step into this file")->check(NewFile());
  run->add_option("--svg", options->svg, "draw the outputs over time into this file")->check(NewFile());
  run->add_flag("--quiet", options->quiet, "no progress, no table");
  chosen.When(*run, [options] { return RunMechanismFile(*options); });
}

}  // namespace rodeira::cli
