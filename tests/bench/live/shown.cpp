// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/live/shown.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

namespace rodeira::bench {

std::vector<Shown> ReadShown(const std::filesystem::path& file, double from_s, double to_s) {
  std::ifstream in(file);
  std::string line;
  std::vector<Shown> all;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    Shown shown;
    if (!(words >> shown.wall_s >> shown.simulated_s >> shown.x_m >> shown.y_m >> shown.z_m >> shown.eye_x_m >>
          shown.eye_y_m >> shown.eye_z_m))
      break;  // its last line may be cut
    if (shown.simulated_s >= from_s && shown.simulated_s <= to_s) all.push_back(shown);
  }
  if (all.size() < 10) {
    fmt::print(stderr, "{}: {} pictures between {} and {} s were found; at least 10 were expected\n", file.string(),
               all.size(), from_s, to_s);
    std::exit(1);
  }
  return all;
}

double Quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(std::lround(share * static_cast<double>(values.size() - 1)))];
}

}  // namespace rodeira::bench
