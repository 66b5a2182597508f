// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace rodeira::cli {

// The command line of `rodeira mechanism run`; texts are paths, empty: not written.
struct MechanismOptions {
  std::string file;
  double until_s = 0.0;
  double step_s = 0.0;
  std::string csv;
  std::string svg;
  bool quiet = false;
};

// `rodeira mechanism run`: a mechanism file alone, without a network. Returns the exit status.
int RunMechanismFile(const MechanismOptions& options);

}  // namespace rodeira::cli
