// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/all_commands.hpp"

#include <memory>

#include "launch/rodeira/commands/surface_command.hpp"
#include "launch/rodeira/option_errors.hpp"
#include "launch/rodeira/result_files.hpp"

namespace rodeira::cli {

void AddSurface(CLI::App& app, ChosenCommand& chosen) {
  const auto options = std::make_shared<SurfaceOptions>();
  CLI::App* surface = app.add_subcommand("surface", "measured road surfaces, alone");
  surface->require_subcommand(1);
  CLI::App* check = surface->add_subcommand("check", "what an OpenCRG file holds, or what is wrong with it");
  check->add_option("FILE.crg", options->file, "OpenCRG file")->required();
  check->add_option("--svg", options->svg, "draw plan, heights and tracks into this file")->check(NewFile());
  options->command = "check";
  chosen.When(*check, [options] { return Surface(*options); });
}

}  // namespace rodeira::cli
