// SPDX-License-Identifier: Apache-2.0
#include "common/world/terrain/elevation_grid.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/assert.hpp"
#include "common/core/base/huge_pages.hpp"

namespace rodeira::terrain {

ElevationGrid::ElevationGrid(Frame frame, std::vector<float> heights_m, std::string projection_wkt)
    : frame_(frame), heights_m_(std::move(heights_m)), projection_wkt_(std::move(projection_wkt)) {
  RODEIRA_ASSERT(frame_.columns >= 2 && frame_.rows >= 2);
  RODEIRA_ASSERT(frame_.east_m > frame_.west_m && frame_.north_m > frame_.south_m);
  RODEIRA_ASSERT(heights_m_.size() == static_cast<std::size_t>(frame_.columns) * static_cast<std::size_t>(frame_.rows));
  base::PreferHugePages(heights_m_.data(), heights_m_.size() * sizeof(float));
  spacing_x_m_ = (frame_.east_m - frame_.west_m) / (frame_.columns - 1);
  spacing_y_m_ = (frame_.north_m - frame_.south_m) / (frame_.rows - 1);
  cells_per_m_x_ = (frame_.columns - 1) / (frame_.east_m - frame_.west_m);
  cells_per_m_y_ = (frame_.rows - 1) / (frame_.north_m - frame_.south_m);
  has_voids_ = std::find(heights_m_.begin(), heights_m_.end(), kVoid) != heights_m_.end();
}

GridSample ElevationGrid::At(double x_m, double y_m) const {
  GridSample sample;
  const bool inside = x_m >= frame_.west_m && x_m <= frame_.east_m && y_m >= frame_.south_m && y_m <= frame_.north_m;
  if (!inside) return sample;  // NaN too
  const double across = (x_m - frame_.west_m) * cells_per_m_x_;
  const double along = (y_m - frame_.south_m) * cells_per_m_y_;
  const int column = std::min(static_cast<int>(across), frame_.columns - 2);
  const int row = std::min(static_cast<int>(along), frame_.rows - 2);
  const double u = across - column;
  const double v = along - row;
  const float* west =
      heights_m_.data() + static_cast<std::size_t>(column) * static_cast<std::size_t>(frame_.rows) + row;
  const float* east = west + frame_.rows;
  const bool south_west = u + v <= 1.0;  // of the diagonal from the south-east to the north-west corner
  const float corner_post = south_west ? west[0] : east[1];
  if (has_voids_ && (corner_post == kVoid || east[0] == kVoid || west[1] == kVoid)) return sample;
  const auto corner = static_cast<double>(corner_post), south_east = static_cast<double>(east[0]),
             north_west = static_cast<double>(west[1]);
  // Height differences over one whole cell, eastward and northward.
  const double eastward = south_west ? south_east - corner : corner - north_west;
  const double northward = south_west ? north_west - corner : corner - south_east;
  sample.z_m =
      south_west ? corner + u * eastward + v * northward : corner - (1.0 - u) * eastward - (1.0 - v) * northward;
  sample.slope_x = eastward * cells_per_m_x_;
  sample.slope_y = northward * cells_per_m_y_;
  sample.inside = true;
  return sample;
}

}  // namespace rodeira::terrain
