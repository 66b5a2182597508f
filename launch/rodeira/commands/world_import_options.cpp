// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/all_commands.hpp"

#include <memory>

#include "launch/rodeira/commands/world_import.hpp"
#include "launch/rodeira/option_errors.hpp"
#include "launch/rodeira/result_files.hpp"

namespace rodeira::cli {

void AddWorldImport(CLI::App& world, ChosenCommand& chosen) {
  const auto options = std::make_shared<WorldImportOptions>();
  CLI::App* command = world.add_subcommand(
      "import", "make a world of a map of OpenStreetMap or a network of SUMO, by SUMO's netconvert (package sumo)");
  command->add_option("FILE", options->file, "map (.osm, .osm.gz) or network (.net.xml, .net.xml.gz)")->required();
  command->add_option("-o,--out", options->out, "file to write: OUT.yaml (with OUT.xodr beside it) or OUT.xodr")
      ->required()
      ->check(NewFile());
  command->add_option("--elevation", options->elevation,
                      "heights of the ground (GeoTIFF, .bt …), which the roads follow");
  command->add_flag("--quiet", options->quiet, "no progress");
  chosen.When(*command, [options, command] {
    options->force = IsForced(*command);
    return WorldImport(*options);
  });
}

}  // namespace rodeira::cli
