// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace rodeira::cli {

// The command line of `rodeira polyline`.
struct PolylineOptions {
  std::string command;  // join, translate, rotate, scale, offset
  std::vector<std::string> files;
  std::string out;
  std::vector<double> by_m;     // translate: 2 or 3 numbers
  std::vector<double> about_m;  // rotate, scale: 2 or 3 numbers; the first point otherwise
  double angle_deg = 0.0;
  double factor = 1.0;
  double z_factor = 0.0;  // 0: as the plan
  double left_m = 0.0;
  bool keep_length = false;
  bool despite_faults = false;
  double within_m = 0.05;
  bool bridge = false;
  bool turn = false;
  double step_m = 1.0;  // between the points of a road's axis
};

// `rodeira polyline`: chains of points in CSV files, and axes of roads ("WORLD.yaml#ROAD"), put together and moved.
// Returns the exit status.
int Polylines(const PolylineOptions& options);

}  // namespace rodeira::cli
