// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "common/core/base/hash.hpp"
#include "common/core/geometry/plan_axis.hpp"

namespace rodeira::network {

// A height and how it changes with x and y.
struct GroundHeight {
  double z_m = 0.0;
  double slope_x = 0.0, slope_y = 0.0;
};

// Heights across a junction's reference line: on it, then a spacing, two spacings ... to its left and right.
struct JunctionGridRow {
  double centre_m = 0.0;
  std::vector<double> left_m, right_m;
};

// The heights that an OpenDRIVE file gives to all of a junction (1.8, 12.11): a square grid beside the junction's
// reference line. Within a square the height is bicubic by the cubics through the four heights along each of its lines,
// straight where there are not four.
class JunctionGrid {
 public:
  // Rows a spacing apart from the line's s `start_m` on. Nothing where two neighbouring rows have no square between
  // them.
  static std::optional<JunctionGrid> Make(geometry::PlanAxis line, double start_m, double spacing_m,
                                          std::vector<JunctionGridRow> rows);

  // Of all of its numbers.
  base::Digest Digest() const;
  // Whether a square is there.
  bool Covers(const Eigen::Vector2d& p_W) const;
  // Beyond its squares it goes on level across their edge.
  GroundHeight At(const Eigen::Vector2d& p_W) const;

 private:
  // A place among the rows: counted in spacings from the first row, and to the left.
  struct Spot {
    double row, left;
    double row_per_m;  // how much of a row a metre along the tangent is
    Eigen::Vector2d tangent_W;
  };
  JunctionGrid(geometry::PlanAxis line, double start_m, double spacing_m, std::vector<JunctionGridRow> rows)
      : line_(std::move(line)), start_m_(start_m), spacing_m_(spacing_m), rows_(std::move(rows)) {}
  Spot Find(const Eigen::Vector2d& p_W) const;
  const double* HeightAt(int row, int left) const;
  void Tangents(int row, int left, bool along, double& first, double& second) const;

  geometry::PlanAxis line_;
  double start_m_, spacing_m_;
  std::vector<JunctionGridRow> rows_;
};

}  // namespace rodeira::network
