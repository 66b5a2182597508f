#include "common/scene/ground_tile.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <set>
#include <thread>

#include "common/base/assert.hpp"
#include "common/partition/noding.hpp"

namespace rodeira::scene {
namespace {

constexpr std::array<double, kGroundLevels - 1> kPaintChords_m = {0.001, 0.01, 0.05};

// Tiles within reach of a road's lines.
void AddReach(const Line3& line, std::set<TileKey>& tiles) {
  const auto reach = static_cast<std::int64_t>(GroundPlan::kAround_m / kStep_m);
  for (const Eigen::Vector3d& p : line) {
    const WorldStep at = ToSteps(p.head<2>());
    for (std::int64_t column = TileOf(at.x - reach); column <= TileOf(at.x + reach); ++column) {
      for (std::int64_t row = TileOf(at.y - reach); row <= TileOf(at.y + reach); ++row) tiles.insert({column, row});
    }
  }
}

void Measure(GroundTile& tile) {
  Eigen::AlignedBox3d box;
  for (const Mesh& mesh : tile.levels.back().ground) {
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) box.extend(mesh.PositionW(i));
  }
  if (box.isEmpty()) return;
  tile.centre_W = box.center();
  tile.radius_m = 0.5 * box.diagonal().norm();
}

}  // namespace

void ForEachAtOnce(std::size_t count, unsigned threads, const std::function<void(std::size_t)>& work) {
  if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
  std::atomic<std::size_t> next{0};
  const auto run = [&] {
    for (std::size_t i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::thread> others;
  for (unsigned i = 1; i < threads && i < count; ++i) others.emplace_back(run);
  run();
  for (std::thread& other : others) other.join();
}

GroundPlan::GroundPlan(const road::World& world, unsigned threads) : world_(world) {
  RODEIRA_ASSERT(world.network() != nullptr);
  const auto roads = world.network()->roads();
  std::vector<std::vector<Line3>> lines(roads.size());
  std::vector<std::array<TilePaint, kGroundLevels - 1>> paint(roads.size());
  ForEachAtOnce(roads.size(), threads, [&](std::size_t i) {
    lines[i] = RoadLinesOf(roads[i], kRoadTolerances[0]);
    for (std::size_t level = 0; level < paint[i].size(); ++level) PaintRoad(roads[i], kPaintChords_m[level], paint[i][level]);
  });
  TileLines pieces;
  std::set<TileKey> tiles;
  for (std::size_t i = 0; i < roads.size(); ++i) {
    AddToTiles(lines[i], pieces);
    for (const Line3& line : lines[i]) AddReach(line, tiles);
    for (std::size_t level = 0; level < paint[i].size(); ++level) {
      for (auto& [key, some] : paint[i][level]) {
        auto& all = paint_[level][key];
        all.insert(all.end(), some.begin(), some.end());
      }
    }
  }
  tiles_.assign(tiles.begin(), tiles.end());
  std::vector<std::pair<const TileKey, std::vector<partition::GridLine>>*> open;
  for (auto& piece : pieces) open.push_back(&piece);
  std::vector<std::vector<partition::GridSegment>> noded(open.size());
  ForEachAtOnce(open.size(), threads, [&](std::size_t i) { noded[i] = partition::Node(open[i]->second); });
  for (std::size_t i = 0; i < open.size(); ++i) {
    edges_.Add(open[i]->first, noded[i]);
    segments_[open[i]->first] = std::move(noded[i]);
  }
}

GroundTile GroundPlan::Build(const TileKey& key) const {
  GroundTile tile;
  tile.key = key;
  static const std::vector<partition::GridSegment> kNone;
  const auto found = segments_.find(key);
  const auto& finest = found == segments_.end() ? kNone : found->second;
  const std::vector<partition::GridPoint> edge = edges_.Of(key);
  for (int level = 0; level < kGroundLevels; ++level) {
    const auto at = static_cast<std::size_t>(level);
    const auto segments = level == 0 || finest.empty() ? finest : Simplify(finest, key, world_, kRoadTolerances[at]);
    const TilePlan plan = PlanTile(world_, key, segments, edge, level);
    WovenTile woven = WeaveTile(world_, plan);
    if (at < paint_.size()) {
      if (const auto paint = paint_[at].find(key); paint != paint_[at].end()) tile.levels[at].marks = LayPaint(paint->second, key, woven.triangles);
    }
    tile.levels[at].ground = std::move(woven.meshes);
  }
  Measure(tile);
  return tile;
}

}  // namespace rodeira::scene
