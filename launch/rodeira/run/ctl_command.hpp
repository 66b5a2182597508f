// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace rodeira::cli {

// `rodeira ctl COMMAND …`: asks a run of this user on this PC, and prints its answer.
struct CtlOptions {
  std::vector<std::string> words;
  std::string run;  // empty: the only one
};
// 0 done, 1 the run cannot, 2 nonsense, no such run, or several.
int Ctl(const CtlOptions& options);

}  // namespace rodeira::cli
