// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace rodeira::cli {

// `rodeira world check | info | map | query | build | export WORLD …`, `rodeira world list`
struct WorldOptions {
  std::string command;     // empty: another command was given
  std::string world_file;  // a path, or the name of a world (InputKind::kWorld)
  double x_m = 0.0;
  double y_m = 0.0;
  std::optional<double> z_hint_m;
  bool earth = false;  // X and Y are longitude and latitude
  std::string out;
  bool strict = false;
  bool verbose = false;
  bool no_repair = false;
  std::string repair;    // the repaired OpenDRIVE file is written here; empty: it is not
  unsigned threads = 0;  // 0: as many as the machine has
  bool quiet = false;
  std::string svg;
  std::string profile;
};

// Returns the exit status.
int World(const WorldOptions& options);

}  // namespace rodeira::cli
