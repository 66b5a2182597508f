// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace rodeira::cli {

// The command line of `rodeira surface`.
struct SurfaceOptions {
  std::string command;  // check
  std::string file;
  std::string svg;
};

// `rodeira surface check`: a surface file alone, without a world. Returns the exit status.
int Surface(const SurfaceOptions& options);

}  // namespace rodeira::cli
