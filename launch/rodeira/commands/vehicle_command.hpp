// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace rodeira::cli {

// The command line of `rodeira vehicle`.
struct VehicleOptions {
  std::string command;                  // "test", "rig", "tyre" or "list"
  std::string file;                     // a path, or the name of a vehicle (InputKind::kVehicle); a tyre file
  std::vector<std::string> manoeuvres;  // none: all
  double step_s = 0.001;
  std::string csv;  // of one manoeuvre
  std::string svg;
  std::string out;         // folder: both, of each; of the rig its tables and diagrams
  double travel_m = 0.06;  // of the rig, up and down
  bool forces = false;     // of joints and springs, in two more files of each manoeuvre
  bool quiet = false;
};

// `rodeira vehicle test`: the vehicle file on the proving ground, without a network. `rodeira vehicle list`: the known
// vehicle files. Returns the exit status: 1 if a manoeuvre failed, 2 for wrong input.
int Vehicle(const VehicleOptions& options);

}  // namespace rodeira::cli
