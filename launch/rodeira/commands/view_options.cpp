// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/all_commands.hpp"

#include <memory>

#include "launch/rodeira/commands/view_command.hpp"
#include "launch/rodeira/option_errors.hpp"

namespace rodeira::cli {

void AddView(CLI::App& app, ChosenCommand& chosen) {
  const auto options = std::make_shared<ViewOptions>();
  CLI::App* view = app.add_subcommand(
      "view",
      "the start window: choose what to drive, or what to watch; with a launch file: its run, by one of its views");
  view->add_option("LAUNCH.yaml", options->launch_file, "launch file, or its name");
  view->add_option("--screen", options->screen,
                   "of the laboratory: only the view that looks through it, as its PC's part of the run where the "
                   "launch file names one");
  view->add_flag("--headset", options->headset, "in a headset too");
  view->add_option("--for", options->duration_s, "simulated seconds")->check(PositiveSeconds());
  chosen.When(*view, [options] { return View(*options); });
}

}  // namespace rodeira::cli
