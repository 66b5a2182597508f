// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

namespace rodeira::bench {

// A line of a window's frame log (nodes/view/frame/frame_log): what was shown, and when.
struct Shown {
  double wall_s = 0.0, simulated_s = 0.0;
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;
  double eye_x_m = 0.0, eye_y_m = 0.0, eye_z_m = 0.0;
};

// The lines of a log with a simulated time between these two. Ends the program with a sentence where it cannot be
// read.
std::vector<Shown> ReadShown(const std::filesystem::path& file, double from_s, double to_s);

// The value below which this share of them lies; they need not be in order.
double Quantile(std::vector<double> values, double share);

}  // namespace rodeira::bench
