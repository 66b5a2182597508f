// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace rodeira::cli {

struct VehicleOptions {
  bool asked = false;
  std::string file;
  std::vector<std::string> manoeuvres;  // none: all
  double step_s = 0.001;
  std::string csv;  // of one manoeuvre
  std::string svg;
  std::string out;  // folder: both, of each
  bool quiet = false;
};

// `rodeira vehicle test`: a vehicle file on the proving ground, without a network. Returns the exit status: 1 where a
// manoeuvre could not be driven, 2 for wrong input.
int TestVehicle(const VehicleOptions& options);

}  // namespace rodeira::cli
