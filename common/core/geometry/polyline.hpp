// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"

namespace rodeira::geometry {

// A chain of points in space. Two of them or more, none standing over its neighbour. Stations are lengths in plan.
struct Polyline {
  std::vector<Eigen::Vector3d> points_W;
  bool has_z = true;  // false: z is 0 everywhere and not written

  // The last point is the first one again (within a micrometre in plan), and there are four or more.
  bool closed() const;
};

// The station of each point: 0, then the length in plan up to it.
std::vector<double> StationsOf(const Polyline& line);

// By a vector in W.
Polyline Translated(Polyline line, const Eigen::Vector3d& by_m);
// About a vertical axis, counted from east to north.
Polyline Rotated(Polyline line, double angle_rad, const Eigen::Vector2d& about_W);
// Away from `about`: plan and heights may grow differently. Factors greater than 0.
Polyline Scaled(Polyline line, double plan_factor, double z_factor, const Eigen::Vector3d& about_W);
// The same points from the last to the first.
Polyline Reversed(Polyline line);

// How lines are put together.
struct JoinRules {
  double within_m = 0.05;  // the distance in space that an end may have from the next beginning
  bool bridge = false;     // a larger one is bridged by a straight piece
  bool turn = false;       // a line with its end nearer than its beginning is turned round
};

// The lines one after the other; where an end and the next beginning lie within `within_m`, the next line's point is
// left out. Wrong input, naming both by `names`, where they lie farther apart; and where only some have heights.
base::Result<Polyline> Joined(std::span<const Polyline> lines, std::span<const std::string> names,
                              const JoinRules& rules);

// Reads a CSV file: a line of column names x_m, y_m and, if there are heights, z_m, in any order; then a point a line.
// Lines that are empty or begin with # are passed over. Wrong input, with file and line, for an unknown or missing
// column, what is no number, a number beyond 1e9, a point that stands over the one before, fewer than two points.
base::Result<Polyline> ReadPolyline(std::string_view text, const std::string& name);

// The same line as CSV: shortest decimals that read back to the same bits.
std::string PolylineCsv(const Polyline& line);

}  // namespace rodeira::geometry
