// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "launch/rodeira/commands/all_commands.hpp"
#include "launch/rodeira/commands/report_command.hpp"
#include "launch/rodeira/result_files.hpp"

namespace rodeira::cli {

void AddReport(CLI::App& app, ChosenCommand& chosen) {
  const auto options = std::make_shared<ReportOptions>();
  CLI::App* command = app.add_subcommand(
      "report", "write a page about recordings: map, curves over time, distributions, measures (HTML, one file)");
  command->add_option("FILE.mcap", options->recordings, "recordings, side by side on the page")->required();
  command->add_option("-o,--out", options->out, "page to write, .html")->required()->check(NewFile());
  command->add_option("--spec", options->spec, "measures file (YAML): intervals, measures and their options");
  command->add_option("--intervals", options->intervals, "NAME=FROM..TO or NAME=while CONDITION, as of `measures`");
  command->add_option("--baseline", options->baseline, "name of the interval that is the driver's baseline");
  command->add_option("--subject", options->subject, "vehicle node, or agent:ID; otherwise the first vehicle");
  command->add_flag("--quiet", options->quiet, "no progress");
  chosen.When(*command, [options] { return Report(*options); });
}

}  // namespace rodeira::cli
