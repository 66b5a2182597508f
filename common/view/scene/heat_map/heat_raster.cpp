// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/heat_map/heat_raster.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace rodeira::scene {
namespace {

constexpr double kMinRange_m = 10.0;

// One place of the ground that was driven on.
struct Surface {
  std::int64_t column = 0, row = 0;
  HeatCell cell;

  double height_m() const { return cell.height_ms / cell.time_s; }
  bool SharesSquareWith(const Surface& other) const { return column == other.column && row == other.row; }
};

void Join(HeatCell& sum, const HeatCell& other) {
  sum.time_s += other.time_s, sum.distance_m += other.distance_m, sum.height_ms += other.height_ms;
  sum.fuel_l += other.fuel_l, sum.fuel_distance_m += other.fuel_distance_m;
  if (sum.limit_mps == 0.0) sum.limit_mps = other.limit_mps;
}

// Near the place, from below on each square; of the map's levels those are joined that belong to one road.
std::vector<Surface> SurfacesOf(const HeatMap& map, const Eigen::Vector3d& about_W) {
  const auto number = [](double x) { return static_cast<std::int64_t>(std::floor(x / HeatMap::kSquare_m)); };
  const std::int64_t column = number(about_W.x()), row = number(about_W.y());
  std::vector<Surface> surfaces;
  for (const auto& [key, cell] : map.cells()) {
    if (std::abs(key.column - column) > kHeatReach || std::abs(key.row - row) > kHeatReach || cell.time_s <= 0.0)
      continue;
    const Surface next{key.column, key.row, cell};
    const bool joins = !surfaces.empty() && next.SharesSquareWith(surfaces.back()) &&
                       next.height_m() - surfaces.back().height_m() < kHeatSurface_m;
    if (joins)
      Join(surfaces.back().cell, cell);
    else
      surfaces.push_back(next);
  }
  return surfaces;
}

std::uint16_t TexelOf(double share, double least) {
  return static_cast<std::uint16_t>(std::lround(std::clamp(65535.0 * share, least, 65535.0)));
}

}  // namespace

HeatRaster MakeHeatRaster(const HeatMap& map, HeatKind kind, const Eigen::Vector3d& about_W) {
  HeatRaster raster;
  const std::vector<Surface> surfaces = SurfacesOf(map, about_W);
  if (surfaces.empty()) return raster;
  const Surface& first = surfaces.front();
  std::int64_t west = first.column, east = west, south = first.row, north = south;
  double lowest_m = first.height_m(), highest_m = lowest_m;
  for (const Surface& surface : surfaces) {
    west = std::min(west, surface.column), east = std::max(east, surface.column);
    south = std::min(south, surface.row), north = std::max(north, surface.row);
    lowest_m = std::min(lowest_m, surface.height_m()), highest_m = std::max(highest_m, surface.height_m());
  }
  raster.west_m = static_cast<double>(west) * HeatMap::kSquare_m;
  raster.south_m = static_cast<double>(south) * HeatMap::kSquare_m;
  raster.lowest_m = lowest_m;
  raster.range_m = std::max(kMinRange_m, highest_m - lowest_m);
  raster.columns = static_cast<std::size_t>(east - west + 1);
  raster.rows = static_cast<std::size_t>(north - south + 1);
  raster.texels.assign(4 * raster.columns * raster.rows, 0);
  const HeatScale& scale = ScaleOf(kind);
  for (const Surface& surface : surfaces) {
    const auto value = map.Value(kind, surface.cell);
    if (!value) continue;
    std::uint16_t* texel = &raster.texels[4 * (static_cast<std::size_t>(surface.row - south) * raster.columns +
                                               static_cast<std::size_t>(surface.column - west))];
    if (texel[1] != 0) texel += 2;  // above the lowest; of more than two the highest stays
    texel[0] = TexelOf((*value - scale.red) / (scale.green - scale.red), 0.0);
    texel[1] = TexelOf((surface.height_m() - lowest_m) / raster.range_m, 1.0);
  }
  return raster;
}

}  // namespace rodeira::scene
