// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/runtime/launch/launch.hpp"

namespace rodeira::cli {

// `rodeira run LAUNCH.yaml …`
struct RunOptions {
  std::string launch_file;  // a path, or the name of a launch file (InputKind::kLaunch)
  bool list = false;        // only print the known launch files
  std::optional<double> duration_s;
  std::string pace;    // empty: as the launch file says, otherwise as fast as it can
  std::string record;  // empty: as the launch file says, otherwise a dated file in the folder of recordings
  bool no_record = false;
  std::optional<std::uint64_t> seed;
  launch::Overrides overrides;
  std::vector<std::string> meta;  // KEY=VALUE, for the recording
  bool in_process = false;
  bool headless = false;
  bool quiet = false;
  std::string lab;   // laboratory file; empty: as the launch file says
  std::string host;  // only what belongs to this host of the laboratory; empty: all
  std::string run;   // empty: a name of its own
  std::optional<std::uint32_t> domain;
};

// Runs it and prints progress and the closing table; the exit status of the program comes back.
int Run(const RunOptions& options);

}  // namespace rodeira::cli
