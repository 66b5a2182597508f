// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/all_commands.hpp"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/core/base/print_error.hpp"
#include "launch/rodeira/key_values.hpp"
#include "launch/rodeira/option_errors.hpp"
#include "launch/rodeira/run/run_command.hpp"

namespace rodeira::cli {

void AddRun(CLI::App& app, ChosenCommand& chosen) {
  const auto options = std::make_shared<RunOptions>();
  const auto sets = std::make_shared<std::vector<std::string>>();
  CLI::App* run = app.add_subcommand("run", "drive: start every process of a launch file");
  CLI::Option* file = run->add_option("LAUNCH.yaml", options->launch_file, "launch file, or its name (demo)");
  run->add_flag("--list", options->list, "print the launch files that can be named")->excludes(file);
  run->add_option("--for", options->duration_s, "simulated seconds")->check(PositiveSeconds());
  run->add_option("--pace", options->pace, "max, real or a factor of real time; otherwise the launch file's, or max");
  CLI::Option* record = run->add_option("--record", options->record,
                                        "recording (MCAP); otherwise a dated file in the folder of recordings");
  run->add_flag("--no-record", options->no_record, "no recording")->excludes(record);
  run->add_option("--seed", options->seed, "random seed")->check(WholeNumber());
  run->add_option("--set", *sets, "KEY=VALUE: replaces a value of the launch file; KEY=~ takes it out");
  run->add_option("--meta", options->meta, "KEY=VALUE: written into the recording (participant=P07)");
  run->add_flag("--in-process", options->in_process, "the same nodes in one process");
  run->add_flag("--headless", options->headless, "no window, even where there is a display");
  run->add_flag("--quiet", options->quiet, "no progress, no table");
  run->add_option("--lab", options->lab, "laboratory file: the PCs and their network");
  run->add_option("--host", options->host, "start only what belongs to this host of the laboratory");
  run->add_option("--run", options->run, "name of the run: only processes of the same name meet");
  run->add_option("--domain", options->domain, "DDS domain, 0 to 232 (default: the first free one)")
      ->check(Between(0, 232));
  chosen.When(*run, [options, sets] {
    auto overrides = KeyValues("--set", *sets);
    if (!overrides) return base::PrintError("rodeira", overrides.error());
    options->overrides = std::move(overrides).value();
    return Run(*options);
  });
}

}  // namespace rodeira::cli
