// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace rodeira::cli {

// The command line of `rodeira edit`.
struct EditOptions {
  std::string file;  // empty: a new map
};

// `rodeira edit`: the path editor in its window. The exit status.
int Edit(const EditOptions& options);

}  // namespace rodeira::cli
