// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/runtime/launch/launch.hpp"
#include "launch/rodeira/replay/watch_command.hpp"

namespace rodeira::cli {

// The command line of `rodeira replay`.
struct ReplayOptions {
  std::string file;
  bool verify = false;
  bool view = false;
  WatchOptions watch;  // --view, --frames: what is theirs alone
  std::optional<double> from_s;
  std::vector<std::pair<std::string, std::string>> changes;    // --branch
  std::vector<std::pair<std::string, std::string>> libraries;  // --library: node, shared object
  std::optional<double> for_s;                                 // of the branch: simulated seconds behind it
  std::string record;                                          // of the branch
  std::optional<std::string> pace;  // of the branch; none: real where a person drives or watches
  bool quiet = false;
};

// What `--library` adds to the recorded launch file. Wrong input if the recording has no such external node.
base::Result<launch::Overrides> LibrariesOf(const ReplayOptions& options);

// `rodeira replay`: exit status 0, 1 where a verification found a difference, 2 for wrong input.
int Replay(const ReplayOptions& options);

}  // namespace rodeira::cli
