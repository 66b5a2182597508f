#include "common/scene/post_lines.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::scene {
namespace {

constexpr double kDensest_m = 8.0, kSparsest_m = 40.0;

}  // namespace

PostLines::PostLines(const road::World& world) {
  if (world.grid() == nullptr) return;
  const auto& frame = world.grid()->frame();
  south_west_W_ = {frame.west_m, frame.south_m}, north_east_W_ = {frame.east_m, frame.north_m};
  spacing_m_ = {world.grid()->spacing_x_m(), world.grid()->spacing_y_m()};
  any_ = spacing_m_.minCoeff() >= kDensest_m && spacing_m_.maxCoeff() <= kSparsest_m;
}

bool PostLines::Holds(const TileKey& tile) const {
  const Eigen::Vector2d low = tile.south_west_W(), high = low + Eigen::Vector2d::Constant(kTile_m);
  return any_ && (low.array() >= south_west_W_.array()).all() && (high.array() <= north_east_W_.array()).all();
}

std::vector<std::int32_t> PostLines::Places(double first_m, double spacing_m, double begin_m, double shift, int every) {
  std::vector<std::int32_t> places;
  const double from = std::ceil((begin_m - first_m) / spacing_m - shift), to = std::floor((begin_m + kTile_m - first_m) / spacing_m - shift);
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

}  // namespace rodeira::scene
