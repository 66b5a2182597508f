// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/tiles/post_lines.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::scene {
namespace {

constexpr double kDensest_m = 8.0, kSparsest_m = 40.0;

}  // namespace

PostLines::PostLines(const road::World& world) {
  grid_ = world.grid();
  if (grid_ == nullptr) return;
  const auto& frame = world.grid()->frame();
  south_west_W_ = {frame.west_m, frame.south_m}, north_east_W_ = {frame.east_m, frame.north_m};
  spacing_m_ = {world.grid()->spacing_x_m(), world.grid()->spacing_y_m()};
  any_ = spacing_m_.minCoeff() >= kDensest_m && spacing_m_.maxCoeff() <= kSparsest_m;
}

bool PostLines::Holds(const TileKey& tile) const {
  const Eigen::Vector2d low = tile.south_west_W(), high = low + Eigen::Vector2d::Constant(kTile_m);
  return any_ && (low.array() >= south_west_W_.array()).all() && (high.array() <= north_east_W_.array()).all();
}

bool PostLines::HoldsAll(const TileKey& tile) const {
  if (!Holds(tile)) return false;
  const Eigen::Array2d low = (tile.south_west_W() - south_west_W_).array() / spacing_m_.array(),
                       high = low + kTile_m / spacing_m_.array();
  const int last_column = std::min(static_cast<int>(std::ceil(high.x())), grid_->frame().columns - 1),
            last_row = std::min(static_cast<int>(std::ceil(high.y())), grid_->frame().rows - 1);
  for (int column = static_cast<int>(low.x()); column <= last_column; ++column) {
    for (int row = static_cast<int>(low.y()); row <= last_row; ++row) {
      if (grid_->Post(column, row) == terrain::ElevationGrid::kVoid) return false;
    }
  }
  return true;
}

std::vector<std::int32_t> PostLines::Places(double first_m, double spacing_m, double begin_m, double shift, int every) {
  std::vector<std::int32_t> places;
  const double from = std::ceil((begin_m - first_m) / spacing_m - shift),
               to = std::floor((begin_m + kTile_m - first_m) / spacing_m - shift);
  for (double k = from; k <= to; k += 1.0) {
    if (std::fmod(k, every) != 0.0) continue;
    const auto place = std::llround((first_m + (k + shift) * spacing_m - begin_m) / kStep_m);
    if (place > 0 && place < kTileSteps) places.push_back(static_cast<std::int32_t>(place));
  }
  return places;
}

std::vector<std::int32_t> PostLines::Columns(const TileKey& tile, int every) const {
  return Places(south_west_W_.x(), spacing_m_.x(), tile.south_west_W().x(), 0.0, every);
}

std::vector<std::int32_t> PostLines::Rows(const TileKey& tile, int every) const {
  return Places(south_west_W_.y(), spacing_m_.y(), tile.south_west_W().y(), 0.0, every);
}

// A cell's diagonal goes from its south-east to its north-west corner.
std::vector<std::int32_t> PostLines::OnWest(const TileKey& tile) const {
  const Eigen::Vector2d low = tile.south_west_W();
  const double u = (low.x() - south_west_W_.x()) / spacing_m_.x();
  std::vector<std::int32_t> places = Rows(tile, 1);
  const auto diagonals = Places(south_west_W_.y(), spacing_m_.y(), low.y(), 1.0 - (u - std::floor(u)), 1);
  places.insert(places.end(), diagonals.begin(), diagonals.end());
  return places;
}

std::vector<std::int32_t> PostLines::OnSouth(const TileKey& tile) const {
  const Eigen::Vector2d low = tile.south_west_W();
  const double v = (low.y() - south_west_W_.y()) / spacing_m_.y();
  std::vector<std::int32_t> places = Columns(tile, 1);
  const auto diagonals = Places(south_west_W_.x(), spacing_m_.x(), low.x(), 1.0 - (v - std::floor(v)), 1);
  places.insert(places.end(), diagonals.begin(), diagonals.end());
  return places;
}

std::vector<std::array<tessellation::GridPoint, 2>> PostLines::Sides(const TileKey& tile) const {
  using tessellation::GridPoint;
  const auto size = static_cast<std::int32_t>(kTileSteps);
  const std::vector<std::int32_t> columns = Columns(tile, 1), rows = Rows(tile, 1);
  std::vector<std::array<GridPoint, 2>> sides;
  const auto add = [&sides](const std::vector<GridPoint>& line) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) sides.push_back({line[i], line[i + 1]});
  };
  const auto along = [&](const std::vector<std::int32_t>& across, const std::vector<std::int32_t>& places,
                         const auto& point) {
    for (const std::int32_t at : across) {
      std::vector<GridPoint> line = {point(at, 0)};
      for (const std::int32_t place : places) line.push_back(point(at, place));
      line.push_back(point(at, size));
      add(line);
    }
  };
  along(columns, rows, [](std::int32_t at, std::int32_t place) { return GridPoint{at, place}; });
  along(rows, columns, [](std::int32_t at, std::int32_t place) { return GridPoint{place, at}; });

  // Diagonals: u + v = k, counted in cells from the first post. Where they meet the edge the places are those of the
  // edge's owner.
  const Eigen::Vector2d low = ((tile.south_west_W() - south_west_W_).array() / spacing_m_.array()).matrix();
  const Eigen::Vector2d high = low + (Eigen::Vector2d::Constant(kTile_m).array() / spacing_m_.array()).matrix();
  const auto west = OnWest(tile), east = OnWest({tile.column + 1, tile.row}), south = OnSouth(tile),
             north = OnSouth({tile.column, tile.row + 1});
  constexpr std::int32_t kRounding = 2;  // steps
  const auto first_column = static_cast<std::int64_t>(std::floor(low.x())) + 1,
             first_row = static_cast<std::int64_t>(std::floor(low.y())) + 1;
  for (double k = std::ceil(low.sum()); k <= high.sum(); k += 1.0) {
    std::vector<GridPoint> line;
    const auto meet = [&](double part, const std::vector<std::int32_t>& places,
                          const auto& point) {  // of the edge's length
      const double wanted = part * size;
      for (const std::int32_t place : places) {
        if (std::fabs(place - wanted) <= kRounding) {
          line.push_back(point(place));
          return;
        }
      }
      for (const std::int32_t corner : {0, size}) {
        if (std::fabs(corner - wanted) <= kRounding) line.push_back(point(corner));
      }
    };
    const Eigen::Vector2d cells = high - low;
    meet((k - low.x() - low.y()) / cells.y(), west, [](std::int32_t at) { return GridPoint{0, at}; });
    meet((k - high.x() - low.y()) / cells.y(), east, [size](std::int32_t at) { return GridPoint{size, at}; });
    meet((k - low.y() - low.x()) / cells.x(), south, [](std::int32_t at) { return GridPoint{at, 0}; });
    meet((k - high.y() - low.x()) / cells.x(), north, [size](std::int32_t at) { return GridPoint{at, size}; });
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const std::int64_t j = static_cast<std::int64_t>(k) - (first_column + static_cast<std::int64_t>(i)) - first_row;
      if (j >= 0 && j < static_cast<std::int64_t>(rows.size()))
        line.push_back({columns[i], rows[static_cast<std::size_t>(j)]});
    }
    std::sort(line.begin(), line.end());
    line.erase(std::unique(line.begin(), line.end()), line.end());
    add(line);
  }
  return sides;
}

}  // namespace rodeira::scene
