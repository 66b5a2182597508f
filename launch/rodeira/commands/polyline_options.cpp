// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/all_commands.hpp"

#include <memory>

#include "launch/rodeira/commands/polyline_command.hpp"
#include "launch/rodeira/option_errors.hpp"
#include "launch/rodeira/result_files.hpp"

namespace rodeira::cli {

void AddPolyline(CLI::App& app, ChosenCommand& chosen) {
  const auto options = std::make_shared<PolylineOptions>();
  CLI::App* polyline = app.add_subcommand(
      "polyline",
      "chains of points in CSV files (x_m,y_m,z_m) and axes of roads (WORLD.yaml#ROAD), put together and moved");
  polyline->require_subcommand(1);
  const auto add = [&](const char* name, const char* text, const char* file) {
    CLI::App* command = polyline->add_subcommand(name, text);
    CLI::Option* files =
        command->add_option(file, options->files, "CSV file, or a road's axis: WORLD.yaml#ROAD, FILE.xodr#ROAD")
            ->required();
    if (std::string(name) == "join")
      files->expected(2, CLI::detail::expected_max_vector_size);
    else
      files->expected(1);
    command->add_option("-o,--out", options->out, "CSV file to write")->required()->check(NewFile());
    command->add_option("--step", options->step_m, "metres between the points of a road's axis")
        ->check(Above0("a number above 0"))
        ->capture_default_str();
    chosen.When(*command, [options, name] {
      options->command = name;
      return Polylines(*options);
    });
    return command;
  };
  CLI::App* join = add("join", "one line after the other", "IN.csv");
  join->add_option("--within", options->within_m, "metres that an end may lie from the next beginning")
      ->check(From0())
      ->capture_default_str();
  join->add_flag("--bridge", options->bridge, "bridge larger gaps by a straight piece");
  join->add_flag("--turn", options->turn, "reverse a line if its end is nearer than its beginning");
  CLI::App* translate = add("translate", "shift", "IN.csv");
  translate->add_option("--by", options->by_m, "metres east, north and, if wanted, up")
      ->required()
      ->check(Finite())
      ->expected(2, 3);
  CLI::App* rotate = add("rotate", "turn about a vertical axis", "IN.csv");
  rotate->add_option("--deg", options->angle_deg, "degrees, from east to north")->required()->check(Finite());
  rotate->add_option("--about", options->about_m, "X Y of the axis; the first point otherwise")
      ->check(Finite())
      ->expected(2);
  CLI::App* scale = add("scale", "stretch or shrink", "IN.csv");
  scale->add_option("--by", options->factor, "factor, greater than 0")->required()->check(Above0("a number above 0"));
  scale->add_option("--z-by", options->z_factor, "another factor for the heights")->check(Above0("a number above 0"));
  scale->add_option("--about", options->about_m, "X Y [Z] that stays; the first point otherwise")
      ->check(Finite())
      ->expected(2, 3);
  CLI::App* offset = add("offset", "the line beside it", "IN.csv");
  offset->add_option("--left", options->left_m, "metres to the left; negative: to the right")
      ->required()
      ->check(Finite());
  offset->add_flag("--keep-length", options->keep_length,
                   "nodes move by the distance itself along their mitres: bends become narrower");
  offset->add_flag("--despite-faults", options->despite_faults, "write it even where it folds or crosses itself");
}

}  // namespace rodeira::cli
