// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/tiles/tile_lines.hpp"

#include <algorithm>
#include <utility>

namespace rodeira::scene {
namespace {

using tessellation::GridLine;
using tessellation::GridPoint;

// Where the way from a to b meets the line on which its first coordinate is `at`: the second one, rounded. a.x != b.x.
std::int64_t Crossing(std::int64_t ax, std::int64_t ay, std::int64_t bx, std::int64_t by, std::int64_t at) {
  if (ax > bx) std::swap(ax, bx), std::swap(ay, by);  // the same for both directions
  const __int128 rise = static_cast<__int128>(by - ay) * (at - ax), run = bx - ax;
  const __int128 doubled = 2 * rise + run;
  __int128 whole = doubled / (2 * run);
  if (doubled % (2 * run) < 0) --whole;
  return ay + static_cast<std::int64_t>(whole);
}

// The lowest tile edge strictly between two coordinates; false where there is none.
bool EdgeBetween(std::int64_t from, std::int64_t to, std::int64_t& edge) {
  const std::int64_t low = std::min(from, to), high = std::max(from, to);
  edge = (TileOf(low) + 1) * kTileSteps;
  return edge > low && edge < high;
}

// Puts one line's segments into tiles.
class Cutter {
 public:
  explicit Cutter(TileLines& tiles) : tiles_(tiles) {}

  // Piece by piece, in the order of the way from a to b: however many tiles it passes.
  void Segment(const WorldStep& a, const WorldStep& b) {
    left_.assign(1, {a, b});
    while (!left_.empty()) {
      const auto [from, to] = left_.back();
      left_.pop_back();
      std::int64_t edge = 0;
      if (EdgeBetween(from.x, to.x, edge)) {
        CutAt({edge, Crossing(from.x, from.y, to.x, to.y, edge)}, from, to);
      } else if (EdgeBetween(from.y, to.y, edge)) {
        CutAt({Crossing(from.y, from.x, to.y, to.x, edge), edge}, from, to);
      } else {
        Whole(from, to);
      }
    }
  }

 private:
  void CutAt(const WorldStep& p, const WorldStep& from, const WorldStep& to) {
    left_.push_back({p, to});
    left_.push_back({from, p});  // is gone along first
  }

  // Within one tile.
  void Whole(const WorldStep& a, const WorldStep& b) {
    const std::int64_t column = TileOf(std::min(a.x, b.x)), row = TileOf(std::min(a.y, b.y));
    Put({column, row}, a, b);
    const bool on_west = a.x == b.x && a.x == column * kTileSteps, on_south = a.y == b.y && a.y == row * kTileSteps;
    if (on_west) Put({column - 1, row}, a, b);
    if (on_south) Put({column, row - 1}, a, b);
  }

  void Put(const TileKey& key, const WorldStep& a, const WorldStep& b) {
    std::vector<GridLine>& lines = tiles_[key];
    const GridPoint from = InTile(key, a), to = InTile(key, b);
    auto [open, fresh] = open_.try_emplace(key, lines.size());
    if (fresh || lines[open->second].back() != from) {
      open->second = lines.size();
      lines.push_back({from});
    }
    lines[open->second].push_back(to);
  }

  TileLines& tiles_;
  std::vector<std::pair<WorldStep, WorldStep>> left_;  // to be cut, the first piece of the way last
  std::map<TileKey, std::size_t> open_;                // the line that is being gone along
};

}  // namespace

void AddToTiles(std::span<const Line3> lines, TileLines& tiles) {
  for (const Line3& line : lines) {
    Cutter cutter(tiles);
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const WorldStep a = ToSteps(line[i].head<2>()), b = ToSteps(line[i + 1].head<2>());
      if (a != b) cutter.Segment(a, b);
    }
  }
}

void TileEdges::Add(const TileKey& tile, std::span<const tessellation::GridSegment> segments) {
  for (const tessellation::GridSegment& segment : segments) {
    for (const GridPoint& p : {segment.a, segment.b}) {
      if (p.x == 0) places_[{tile, true}].insert(p.y);
      if (p.y == 0) places_[{tile, false}].insert(p.x);
      if (p.x == kTileSteps) places_[{{tile.column + 1, tile.row}, true}].insert(p.y);
      if (p.y == kTileSteps) places_[{{tile.column, tile.row + 1}, false}].insert(p.x);
    }
  }
}

// Where one of the tiles at an edge has the terrain's own triangles the other one meets them.
std::vector<std::int32_t> TileEdges::Usual(const Edge& edge) const {
  const TileKey& tile = edge.tile;
  const TileKey beside{tile.column - (edge.west ? 1 : 0), tile.row - (edge.west ? 0 : 1)};
  if (posts_.Holds(tile) || posts_.Holds(beside)) {
    std::vector<std::int32_t> places = edge.west ? posts_.OnWest(tile) : posts_.OnSouth(tile);
    places.insert(places.end(), {0, static_cast<std::int32_t>(kTileSteps)});
    return places;
  }
  std::vector<std::int32_t> places;
  for (std::int32_t k = 0; k <= kTileSteps; k += kEvery) places.push_back(k);
  return places;
}

std::vector<GridPoint> TileEdges::Of(const TileKey& tile) const {
  const auto size = static_cast<std::int32_t>(kTileSteps);
  std::set<GridPoint> points;
  const auto add = [&](const Edge& edge, auto&& point_at) {
    for (const std::int32_t k : Usual(edge)) points.insert(point_at(k));
    if (const auto found = places_.find(edge); found != places_.end()) {
      for (const std::int32_t k : found->second) points.insert(point_at(k));
    }
  };
  add({tile, true}, [](std::int32_t k) { return GridPoint{0, k}; });
  add({tile, false}, [](std::int32_t k) { return GridPoint{k, 0}; });
  add({{tile.column + 1, tile.row}, true}, [&](std::int32_t k) { return GridPoint{size, k}; });
  add({{tile.column, tile.row + 1}, false}, [&](std::int32_t k) { return GridPoint{k, size}; });
  return {points.begin(), points.end()};
}

}  // namespace rodeira::scene
