// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/given_drive.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/core/base/suggest.hpp"

namespace rodeira::measures {
namespace {

bool Differs(const std::vector<double>& column, std::size_t k) {
  return column[k] != column[k - 1] && !(std::isnan(column[k]) && std::isnan(column[k - 1]));
}

// Times in one lane, and changes between them.
void FindEpisodes(Drive& d, bool has_lane) {
  constexpr double kUsualLane_m = 3.5;
  std::int32_t episode = 0;
  for (std::size_t k = 0; k < d.size(); ++k) {
    d.episode[k] = episode;
    if (k == 0) continue;
    const double jump = d.lane_position_m[k] - d.lane_position_m[k - 1];
    const double width = std::isnan(d.lane_width_m[k]) ? kUsualLane_m : d.lane_width_m[k];
    const bool jumps = std::abs(jump) > 0.5 * width;
    const bool leaves = has_lane ? Differs(d.lane, k) || Differs(d.road, k) : jumps;
    if (!leaves && !std::isnan(jump)) continue;
    d.episode[k] = ++episode;
    if (leaves && jumps) d.crossing[k] = jump < 0.0 ? 1 : -1;
  }
}

void FindLines(Drive& d) {
  for (std::size_t k = 0; k < d.size(); ++k) {
    const double error = std::isnan(d.heading_error_rad[k]) ? 0.0 : d.heading_error_rad[k];
    const double front = d.front_m * std::sin(error), rear = (d.front_m - d.length_m) * std::sin(error);
    const double half = 0.5 * d.width_m * std::abs(std::cos(error));
    d.left_line_m[k] = 0.5 * d.lane_width_m[k] - (d.lane_position_m[k] + std::max(front, rear) + half);
    d.right_line_m[k] = 0.5 * d.lane_width_m[k] + (d.lane_position_m[k] + std::min(front, rear) - half);
  }
}

}  // namespace

base::Result<Drive> DriveOf(const GivenDrive& given) {
  if (!(given.rate_hz > 0.0) || !std::isfinite(given.rate_hz))
    return base::WrongInput(
        "config.out_of_range",
        fmt::format("{:g} samples a second were found; a number above 0 was expected", given.rate_hz));
  Drive drive;
  drive.rate_hz = given.rate_hz;
  drive.subject = "given";
  drive.front_m = given.front_m;
  drive.length_m = given.length_m;
  drive.width_m = given.width_m;
  if (given.columns.empty()) return base::WrongInput("measure.unknown_column", "no column was given");
  GrowColumns(drive, given.columns.begin()->second.size());
  for (const auto& [name, values] : given.columns) {
    std::vector<double>* column = FindColumn(drive, name);
    if (column == nullptr) {
      std::vector<std::string> names;
      for (const DriveColumn& known : DriveColumns()) names.emplace_back(known.name);
      return base::WrongInput("measure.unknown_column",
                              fmt::format("there is no column '{}'{}", name, base::DidYouMean(name, names)));
    }
    if (values.size() != drive.size()) {
      return base::WrongInput("config.wrong_length", fmt::format("column '{}' has {} values; {} were expected", name,
                                                                 values.size(), drive.size()));
    }
    *column = values;
  }
  FindEpisodes(drive, given.columns.contains("lane"));
  if (!given.columns.contains("left_line_m") && !given.columns.contains("right_line_m")) FindLines(drive);
  return drive;
}

}  // namespace rodeira::measures
