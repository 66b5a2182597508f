// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

namespace rodeira::driver {

// The points of a line in boxes of eight neighbours each, these in boxes of eight, and so on.
class PointBoxes {
 public:
  explicit PointBoxes(std::vector<Eigen::Vector3d> points_W);  // at least one

  // The index of the first of the points that are nearest in plan and, if z is given, at most `level_m` above or below.
  // The search begins at the index `likely`, which only saves work.
  std::optional<std::size_t> Nearest(const Eigen::Vector2d& p_W, std::optional<double> z_m, double level_m,
                                     std::size_t likely) const;
  // An index that is probably close to the nearest in plan.
  std::size_t Likely(const Eigen::Vector2d& p_W) const;

 private:
  struct Box {
    Eigen::Vector3d low_W, high_W;
  };
  struct Search;
  static double Squared(const Box& box, const Eigen::Vector2d& p_W);
  void LookInto(Search& search, std::size_t level, std::size_t box) const;

  std::vector<Eigen::Vector3d> points_W_;
  std::vector<std::vector<Box>> levels_;  // the last has one box
};

}  // namespace rodeira::driver
