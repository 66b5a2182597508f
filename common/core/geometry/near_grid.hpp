// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace rodeira::geometry {

// A piece of a curve: no point of it is farther than bulge_m from the straight chord, nor the chord from it.
struct Chord {
  Eigen::Vector2d begin_W, end_W;
  double bulge_m;
};

// A static grid that answers: which pieces of a curve can hold the point nearest to (x, y)?
class NearGrid {
 public:
  NearGrid() = default;
  NearGrid(std::span<const Chord> chords, double reach_m);

  // Indices, ascending, of every piece that may be the nearest; none where (x, y) is certainly farther than reach_m
  // from the curve. (Close to the limit there may be an answer though it is a little farther.)
  std::span<const std::uint32_t> Candidates(double x_m, double y_m) const;

 private:
  struct Near {
    std::size_t cell;
    std::uint32_t piece;
    double distance_m;  // from the cell's centre to the chord
  };
  std::vector<Near> Pairs(std::span<const Chord> chords, double radius_m) const;

  Eigen::Vector2d origin_W_ = Eigen::Vector2d::Zero();
  double cell_m_ = 1.0;
  double columns_ = 0.0;  // whole numbers
  double rows_ = 0.0;
  std::vector<std::uint32_t> first_;  // per cell: where its pieces begin in pieces_; one more at the end
  std::vector<std::uint32_t> pieces_;
};

}  // namespace rodeira::geometry
