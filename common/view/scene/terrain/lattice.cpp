// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/terrain/lattice.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/assert.hpp"
#include "common/view/scene/ground_materials/colours.hpp"

namespace rodeira::scene {
namespace {

constexpr double kPlaneSpacing_m = 64.0;
constexpr double kPlaneMargin_m = 4096.0;  // of a plane shown about the start

}  // namespace

Lattice::Lattice(const road::World& world) : world_(world) {
  if (const terrain::ElevationGrid* grid = world.grid()) {
    columns_ = grid->frame().columns;
    rows_ = grid->frame().rows;
    south_west_W_ = {grid->frame().west_m, grid->frame().south_m};
    spacing_m_ = {grid->spacing_x_m(), grid->spacing_y_m()};
    return;
  }
  Eigen::Vector2d low(world.start().x_m, world.start().y_m), high = low;
  const auto whole = [](double x) { return std::floor(x / kPlaneSpacing_m); };
  south_west_W_ = {whole(low.x() - kPlaneMargin_m) * kPlaneSpacing_m,
                   whole(low.y() - kPlaneMargin_m) * kPlaneSpacing_m};
  columns_ = static_cast<int>(whole(high.x() + kPlaneMargin_m - south_west_W_.x())) + 2;
  rows_ = static_cast<int>(whole(high.y() + kPlaneMargin_m - south_west_W_.y())) + 2;
  spacing_m_ = {kPlaneSpacing_m, kPlaneSpacing_m};
  material_ = Material::kCheckers;
}

double Lattice::Height(int column, int row) const {
  if (world_.grid() != nullptr) return static_cast<double>(world_.grid()->Post(column, row));
  const double x = south_west_W_.x() + column * spacing_m_.x(), y = south_west_W_.y() + row * spacing_m_.y();
  return world_.plane()->z_m + world_.plane()->slope_x * x + world_.plane()->slope_y * y;
}

bool Lattice::IsKnown(int column, int row) const {
  return world_.grid() == nullptr || world_.grid()->Post(column, row) != terrain::ElevationGrid::kVoid;
}

Lattice::Sample Lattice::Post(int column, int row) const {
  Sample sample;
  sample.p_W = {south_west_W_.x() + column * spacing_m_.x(), south_west_W_.y() + row * spacing_m_.y(), 0.0};
  sample.inside = IsKnown(column, row);
  if (!sample.inside) return sample;
  sample.p_W.z() = Height(column, row);
  // Central differences, one-sided at the edges and beside voids.
  const int west = column > 0 && IsKnown(column - 1, row) ? column - 1 : column;
  const int east = column + 1 < columns_ && IsKnown(column + 1, row) ? column + 1 : column;
  const int south = row > 0 && IsKnown(column, row - 1) ? row - 1 : row;
  const int north = row + 1 < rows_ && IsKnown(column, row + 1) ? row + 1 : row;
  const double slope_x = east > west ? (Height(east, row) - Height(west, row)) / ((east - west) * spacing_m_.x()) : 0.0;
  const double slope_y =
      north > south ? (Height(column, north) - Height(column, south)) / ((north - south) * spacing_m_.y()) : 0.0;
  sample.normal_W = Eigen::Vector3d(-slope_x, -slope_y, 1.0).normalized();
  sample.colour = GroundColour(world_.terrain_surface(), sample.p_W.x(), sample.p_W.y(), sample.normal_W);
  return sample;
}

}  // namespace rodeira::scene
