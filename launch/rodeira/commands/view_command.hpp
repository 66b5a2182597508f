// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "launch/rodeira/run/run_command.hpp"

namespace rodeira::cli {

// `rodeira view LAUNCH.yaml [--screen NAME] [--headset]`: a run's picture on this PC.
struct ViewOptions {
  std::string launch_file;  // empty: the start window
  std::string screen;       // of the laboratory
  bool headset = false;
  std::optional<double> duration_s;
};

// The run that shows it. Where the launch file gives the screen's view to a host: that host's part of the run, which
// waits for the clock; otherwise the whole run, with this one of its views alone. Wrong input where no view, or none
// with that screen, is in the launch file.
base::Result<RunOptions> RunOf(const ViewOptions& options);

// The exit status of the program comes back.
int View(const ViewOptions& options);

}  // namespace rodeira::cli
