// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/all_commands.hpp"

#include <memory>

#include "launch/rodeira/commands/measures_command.hpp"
#include "launch/rodeira/option_errors.hpp"
#include "launch/rodeira/result_files.hpp"

namespace rodeira::cli {

void AddMeasures(CLI::App& app, ChosenCommand& chosen) {
  const auto options = std::make_shared<MeasuresOptions>();
  CLI::App* command = app.add_subcommand(
      "measures", "compute measures of recordings, as a table: lane position, steering, speed, gaps, responses ...");
  CLI::Option* files = command->add_option("FILE.mcap", options->recordings, "recordings; one table of all of them");
  command->add_option("--spec", options->spec, "measures file (YAML): intervals, measures and their options");
  command->add_option(
      "--intervals", options->intervals,
      "NAME=FROM..TO, instead of the spec's; a point is start, end, seconds, mark:TEXT or event:NAME; TO "
      "may be +SECONDS (task=mark:begin..+20); or NAME=while CONDITION (fast=while speed_mps > 20)");
  command->add_option("--baseline", options->baseline, "name of the interval that is the driver's baseline");
  command->add_option("--subject", options->subject, "vehicle node, or agent:ID; otherwise the first vehicle");
  command->add_option("-o,--out", options->out, "table to write, .csv or .json; otherwise a text is printed")
      ->check(NewFile())
      ->check(AlsoWrites(".measures.yaml"));
  command->add_flag("--long", options->long_format, "a row a value, with unit, n, valid share and options");
  command->add_option("--series", options->series, "write the time series of one recording into this CSV file")
      ->check(NewFile());
  command->add_flag("--list", options->list, "print every measure in a line")->excludes(files);
  command->add_option("--explain", options->explain, "print equation, options and traps of a measure")->excludes(files);
  command->add_flag("--quiet", options->quiet, "no progress");
  chosen.When(*command, [options] { return Measures(*options); });
}

}  // namespace rodeira::cli
