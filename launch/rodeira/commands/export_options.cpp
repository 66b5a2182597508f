// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/all_commands.hpp"

#include <memory>

#include "launch/rodeira/commands/export_command.hpp"
#include "launch/rodeira/option_errors.hpp"

namespace rodeira::cli {

void AddExport(CLI::App& app, ChosenCommand& chosen) {
  const auto options = std::make_shared<ExportOptions>();
  CLI::App* tables =
      app.add_subcommand("export", "write a recording as tables: CSV, a .mat file, or floating car data");
  CLI::Option* csv = tables->add_option("--csv", options->csv, "new folder, one CSV file a topic");
  CLI::Option* mat =
      tables->add_option("--mat", options->mat, "new .mat file for MATLAB, Octave and SciPy, a structure a topic");
  mat->excludes(csv);
  CLI::Option* fcd = tables->add_option("--fcd", options->fcd,
                                        "new file of floating car data for SUMO's tools, of all vehicles; 10 timesteps "
                                        "a second without --rate");
  fcd->excludes(csv)->excludes(mat);
  tables->add_flag("--long", options->long_format, "CSV with a row a value: time, source, column, value")
      ->excludes(mat)
      ->excludes(fcd);
  tables->add_option("--topics", options->topics, "topics, separated by commas; default: all")->excludes(fcd);
  tables
      ->add_option("--columns", options->columns,
                   "columns or groups, separated by commas (position_w_m,wheels.load_n); default: all")
      ->excludes(fcd);
  tables->add_option("--rate", options->rate_hz, "samples a second of each source, at most; events are all written")
      ->check(Above0("a positive number of samples a second"));
  tables->add_option("--from", options->from, "from this time on: simulated seconds, mark:TEXT or event:NAME");
  tables->add_option("--to", options->to, "before this time; +SECONDS: so long after --from");
  tables->add_flag("--marks", options->marks, "also a table of marks and events")->excludes(fcd);
  CLI::Option* derived =
      tables->add_flag("--derived", options->derived, "also a table of lane, gap, TTC ... of one road user at 100 Hz")
          ->excludes(fcd);
  tables
      ->add_option("--subject", options->subject,
                   "of --derived: vehicle node, or agent:ID; otherwise the first vehicle")
      ->needs(derived);
  tables->add_option("FILE.mcap", options->recording, "recording")->required();
  tables->add_flag("--quiet", options->quiet, "no progress, no list");
  chosen.When(*tables, [options] { return Export(*options); });
}

}  // namespace rodeira::cli
