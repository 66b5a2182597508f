// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/all_commands.hpp"

#include <memory>

#include "launch/rodeira/commands/export_command.hpp"
#include "launch/rodeira/option_errors.hpp"

namespace rodeira::cli {

void AddExport(CLI::App& app, ChosenCommand& chosen) {
  const auto options = std::make_shared<ExportOptions>();
  CLI::App* tables = app.add_subcommand("export", "write a recording as tables");
  tables->add_option("--csv", options->csv, "new folder, one CSV file a topic")->required();
  tables->add_option("--topics", options->topics, "topics, separated by commas; default: all");
  tables->add_option("--columns", options->columns,
                     "columns or groups, separated by commas (position_w_m,wheels.load_n); default: all");
  tables->add_option("--rate", options->rate_hz, "samples a second of each source, at most; events are all written")
      ->check(Above0("a positive number of samples a second"));
  tables->add_option("--from", options->from_s, "simulated seconds; from this time on")->check(From0());
  tables->add_option("--to", options->to_s, "simulated seconds; before this time")->check(From0());
  tables->add_option("FILE.mcap", options->recording, "recording")->required();
  tables->add_flag("--quiet", options->quiet, "no progress, no list");
  chosen.When(*tables, [options] { return Export(*options); });
}

}  // namespace rodeira::cli
