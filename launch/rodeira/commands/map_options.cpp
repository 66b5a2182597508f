// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/all_commands.hpp"

#include <memory>

#include "launch/rodeira/commands/map_command.hpp"
#include "launch/rodeira/option_errors.hpp"
#include "launch/rodeira/result_files.hpp"

namespace rodeira::cli {

void AddMap(CLI::App& app, ChosenCommand& chosen) {
  const auto options = std::make_shared<MapOptions>();
  CLI::App* map = app.add_subcommand("map", "traffic maps (.motors): check and convert them");
  map->require_subcommand(1);
  for (const auto& [name, text] :
       {std::pair("check", "name every problem, and describe the map"),
        std::pair("convert",
                  "draw it (.svg), or write it as OpenDRIVE (.xodr) or as a world of this project (.yaml)")}) {
    CLI::App* command = map->add_subcommand(name, text);
    command->add_option("FILE.motors", options->file, "map")->required();
    if (std::string(name) == "convert")
      command
          ->add_option("-o,--out", options->out,
                       "file to write: OUT.svg, OUT.xodr or OUT.yaml (with OUT.xodr beside it)")
          ->required()
          ->check(NewFile())
          ->check(AlsoWrites(".xodr", ".yaml"));
    chosen.When(*command, [options, name] {
      options->command = name;
      return MapCommand(*options);
    });
  }
}

}  // namespace rodeira::cli
