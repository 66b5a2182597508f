// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/all_commands.hpp"

#include <memory>
#include <string>
#include <utility>

#include "common/world/road/logical_files.hpp"
#include "launch/rodeira/commands/world_command.hpp"
#include "launch/rodeira/graphics/graphics.hpp"
#include "launch/rodeira/option_errors.hpp"
#include "launch/rodeira/result_files.hpp"

namespace rodeira::cli {

void AddWorld(CLI::App& app, ChosenCommand& chosen) {
  const auto options = std::make_shared<WorldOptions>();
  CLI::App* world = app.add_subcommand("world", "check, describe and query a world");
  world->require_subcommand(1);
  const auto run = [&options](const char* name) {
    return [options, name] {
      options->command = name;
      return options->command == "build" && CanContinueInGraphics() ? ContinueInGraphics("world build")
                                                                    : World(*options);
    };
  };
  for (const auto& [name, text] :
       {std::pair("check", "name every problem of a world file, or of a folder that was built"),
        std::pair("info", "what the world is"), std::pair("map", "draw the plan as SVG"),
        std::pair("export", "write the roads as OpenDRIVE"),
        std::pair("query", "height, normal, friction and surface at X Y"),
        std::pair("build",
                  "write a world's files: its roads (.xodr), generated terrain (.bt), what it looks like (.osgb)")}) {
    CLI::App* command = world->add_subcommand(name, text);
    command
        ->add_option("WORLD", options->world_file, "world file (.yaml), or OpenDRIVE (.xodr), or a world's name (n222)")
        ->required();
    if (std::string(name) == "query") {
      command->add_option("X", options->x_m, "metres east")->required()->check(Finite());
      command->add_option("Y", options->y_m, "metres north")->required()->check(Finite());
      command->add_option("Z", options->z_hint_m, "near which height, where surfaces lie over one another")
          ->check(Finite());
      command->add_flag("--earth", options->earth,
                        "X and Y are longitude and latitude (WGS 84, degrees) by the world's projection");
    }
    if (std::string(name) == "build") {
      command->add_option("-o,--out", options->out, "folder")
          ->required()
          ->check(NewFolder())
          ->check(RenewedWith(road::kLogicalManifest));
      command->add_option("--threads", options->threads, "how many at once; as many as the machine has otherwise");
      command->add_flag("--quiet", options->quiet, "no progress");
    }
    if (std::string(name) == "map") {
      command->add_option("-o,--out", options->out, "file to draw the plan into")->required()->check(NewFile());
      command
          ->add_option("--profile", options->profile,
                       "draw heights, grades, curvatures and slopes across into this file")
          ->check(NewFile());
    }
    if (std::string(name) == "export")
      command->add_option("-o,--out,--opendrive", options->out, "file to write")->required()->check(NewFile());
    if (std::string(name) == "check") {
      command->add_flag("--strict", options->strict, "OpenDRIVE: ASAM's own tolerances, and nothing is repaired");
      command->add_flag("--no-repair", options->no_repair, "OpenDRIVE: errors stay errors, by the usual tolerances");
      command->add_flag("--verbose", options->verbose, "OpenDRIVE: every finding, not one of each kind");
      command->add_option("--repair", options->repair, "OpenDRIVE: write the repaired file here")->check(NewFile());
    }
    if (std::string(name) == "info") {
      command->add_option("--svg", options->svg, "draw the plan into this file")->check(NewFile());
      command
          ->add_option("--profile", options->profile,
                       "draw heights, grades, curvatures and slopes across into this file")
          ->check(NewFile());
    }
    chosen.When(*command, run(name));
  }
  chosen.When(*world->add_subcommand("list", "print the worlds that can be named, and where they are"), run("list"));
  AddWorldImport(*world, chosen);
}

}  // namespace rodeira::cli
