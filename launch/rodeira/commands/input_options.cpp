// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/all_commands.hpp"

#include <memory>

#include "launch/rodeira/commands/input_command.hpp"
#include "launch/rodeira/option_errors.hpp"
#include "launch/rodeira/result_files.hpp"

namespace rodeira::cli {

void AddInput(CLI::App& app, ChosenCommand& chosen) {
  const auto options = std::make_shared<InputOptions>();
  CLI::App* input = app.add_subcommand("input", "steering wheels and pedals");
  input->require_subcommand(1);
  CLI::App* setup =
      input->add_subcommand("setup", "find out what turns and what is pressed, by moving it, and write a wheel file");
  setup
      ->add_option("-o,--out", options->out,
                   "wheel file; otherwise one in the user's configuration, by the device's GUID")
      ->check(NewFile());
  setup
      ->add_option("--lock-deg", options->lock_deg,
                   "angle of the car's steering wheel at the device's end, from straight ahead")
      ->check(Between(10.0, 1800.0));
  chosen.When(*setup, [options] { return SetUpInput(*options); });
}

}  // namespace rodeira::cli
