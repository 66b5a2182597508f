// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/world/terrain/elevation_grid.hpp"

namespace rodeira::terrain {

// Lets the processor fetch a large grid's heights before they are asked for: of many places at random each would be
// waited for. Changes no answer. The grid must outlive it.
class HeightsAhead {
 public:
  static constexpr std::size_t kAhead = 12;  // so many questions before

  explicit HeightsAhead(const ElevationGrid* grid) {  // null: there is none
    constexpr std::size_t kInTheCache = 1 << 20;      // heights
    if (grid == nullptr || grid->heights_m().size() <= kInTheCache) return;
    const ElevationGrid::Frame& frame = grid->frame();
    heights_m_ = grid->heights_m().data();
    west_m_ = frame.west_m, south_m_ = frame.south_m;
    columns_a_m_ = 1.0 / grid->spacing_x_m(), rows_a_m_ = 1.0 / grid->spacing_y_m();
    columns_ = frame.columns, rows_ = frame.rows;
  }

  bool any() const { return heights_m_ != nullptr; }
  // (x, y) in W that will be asked for about kAhead questions later. Without any() it does nothing.
  void Fetch(double x_m, double y_m) const {
    const double column = (x_m - west_m_) * columns_a_m_, row = (y_m - south_m_) * rows_a_m_;
    if (!(column >= 0.0 && column < columns_ - 1 && row >= 0.0 && row < rows_)) return;
    const float* west =
        heights_m_ + static_cast<std::size_t>(column) * static_cast<std::size_t>(rows_) + static_cast<std::size_t>(row);
    __builtin_prefetch(west);
    __builtin_prefetch(west + rows_);
  }

 private:
  const float* heights_m_ = nullptr;
  double west_m_ = 0.0, south_m_ = 0.0, columns_a_m_ = 0.0, rows_a_m_ = 0.0;
  int columns_ = 0, rows_ = 0;
};

}  // namespace rodeira::terrain
