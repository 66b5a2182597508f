// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/terrain/lattice.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/assert.hpp"
#include "common/view/scene/ground_materials/colours.hpp"

namespace rodeira::scene {
namespace {

constexpr double kPlaneSpacing_m = 64.0;
constexpr double kPlaneMargin_m = 4096.0;  // of a plane shown beyond its roads and its start

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
  for (const road::Road& road : world.roads()) {
    low = low.cwiseMin(road.plan().low_W());
    high = high.cwiseMax(road.plan().high_W());
  }
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

Eigen::Vector2d Lattice::InPosts(double x_m, double y_m) const {
  return {(x_m - south_west_W_.x()) / spacing_m_.x(), (y_m - south_west_W_.y()) / spacing_m_.y()};
}

Eigen::Vector2i Lattice::CellAt(double x_m, double y_m) const {
  const Eigen::Vector2d at = InPosts(x_m, y_m);
  const auto hold = [](double value, int posts) {
    return static_cast<int>(std::clamp(std::floor(value), 0.0, posts - 2.0));
  };
  return {hold(at.x(), columns_), hold(at.y(), rows_)};
}

Lattice::Sample Lattice::At(double x_m, double y_m) const {
  Sample sample;
  const Eigen::Vector2d at = InPosts(x_m, y_m);
  if (!(at.x() >= 0.0 && at.y() >= 0.0 && at.x() <= columns_ - 1.0 && at.y() <= rows_ - 1.0)) return sample;
  const Eigen::Vector2i cell = CellAt(x_m, y_m);
  const double u = at.x() - cell.x(), v = at.y() - cell.y();
  const bool south_west = u + v <= 1.0;
  const Sample corner = south_west ? Post(cell.x(), cell.y()) : Post(cell.x() + 1, cell.y() + 1);
  const Sample south_east = Post(cell.x() + 1, cell.y());
  const Sample north_west = Post(cell.x(), cell.y() + 1);
  if (!corner.inside || !south_east.inside || !north_west.inside) return sample;
  const double along_x = south_west ? u : 1.0 - v;  // weights of the two corners on the diagonal
  const double along_y = south_west ? v : 1.0 - u;
  const double rest = 1.0 - along_x - along_y;
  sample.p_W = {x_m, y_m, rest * corner.p_W.z() + along_x * south_east.p_W.z() + along_y * north_west.p_W.z()};
  sample.normal_W =
      (rest * corner.normal_W + along_x * south_east.normal_W + along_y * north_west.normal_W).normalized();
  const auto part = [&](std::uint8_t a, std::uint8_t b, std::uint8_t c) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(rest * a + along_x * b + along_y * c, 0.0, 255.0)));
  };
  sample.colour = {part(corner.colour.red, south_east.colour.red, north_west.colour.red),
                   part(corner.colour.green, south_east.colour.green, north_west.colour.green),
                   part(corner.colour.blue, south_east.colour.blue, north_west.colour.blue)};
  sample.inside = true;
  return sample;
}

std::vector<double> Lattice::Crossings(const Eigen::Vector2d& a_W, const Eigen::Vector2d& b_W) const {
  const Eigen::Vector2d a = InPosts(a_W.x(), a_W.y()), b = InPosts(b_W.x(), b_W.y());
  std::vector<double> at;
  const auto cross = [&at](double from, double to) {  // where a value passes whole numbers
    for (double whole = std::ceil(std::min(from, to)); whole <= std::max(from, to); whole += 1.0) {
      if (from == to) return;
      const double t = (whole - from) / (to - from);
      if (t > 0.0 && t < 1.0) at.push_back(t);
    }
  };
  cross(a.x(), b.x());
  cross(a.y(), b.y());
  cross(a.x() + a.y(), b.x() + b.y());
  std::sort(at.begin(), at.end());
  const double least = 1e-6 / std::max((b_W - a_W).norm(), 1e-6);  // nearer than a micrometre: the same
  std::vector<double> kept;
  for (const double t : at) {
    if (t > least && t < 1.0 - least && (kept.empty() || t - kept.back() > least)) kept.push_back(t);
  }
  return kept;
}

}  // namespace rodeira::scene
