// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/visual_world/ground_tile.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <set>

#include "common/core/base/assert.hpp"
#include "common/core/base/thread_pool.hpp"
#include "common/core/tessellation/noding.hpp"
#include "common/view/scene/breaklines/laid_lines.hpp"
#include "common/view/scene/breaklines/structure_lines.hpp"
#include "common/view/scene/road_markings/road_paint.hpp"
#include "common/view/scene/tessellation/edge_points.hpp"
#include "common/view/scene/tessellation/levels_at.hpp"
#include "common/view/scene/visual_world/ground_digest.hpp"
#include "common/world/road/network_land.hpp"

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

// Tiles that a deck may touch.
void AddDeck(const network::Road& road, double from_s_m, double to_s_m, std::set<TileKey>& tiles) {
  constexpr double kApart_m = 16.0, kWidest_m = 48.0;
  for (double s_m = from_s_m; s_m < to_s_m + kApart_m; s_m += kApart_m) {
    const Eigen::Vector2d p_W = road.Surface(std::min(s_m, to_s_m), 0.0).p_W.head<2>(),
                          reach = Eigen::Vector2d::Constant(kWidest_m);
    const WorldStep low = ToSteps(p_W - reach), high = ToSteps(p_W + reach);
    for (std::int64_t column = TileOf(low.x); column <= TileOf(high.x); ++column) {
      for (std::int64_t row = TileOf(low.y); row <= TileOf(high.y); ++row) tiles.insert({column, row});
    }
  }
}

void AddDecks(const road::World& world, std::uint32_t index, std::set<TileKey>& tiles) {
  const network::Road& road = world.network()->roads()[index];
  if (world.land() != nullptr) {
    for (const road::Stretch& deck : world.land()->decks()[index]) AddDeck(road, deck.from_s_m, deck.to_s_m, tiles);
    return;
  }
  for (const network::Structure& structure : road.spec().structures) {
    if (structure.bridge)
      AddDeck(road, std::max(structure.s_m, 0.0), std::min(structure.s_m + structure.length_m, road.length_m()), tiles);
  }
}

void AddRectangle(const road::Extents& extents, std::set<TileKey>& tiles) {
  const WorldStep low = ToSteps({extents.west_m, extents.south_m}), high = ToSteps({extents.east_m, extents.north_m});
  for (std::int64_t column = TileOf(low.x); column <= TileOf(high.x); ++column) {
    for (std::int64_t row = TileOf(low.y); row <= TileOf(high.y); ++row) tiles.insert({column, row});
  }
}

// Where things stand at no road, and where the car starts: on a plane, which has no edge, the ground about them is
// seen.
Line3 PlacesOf(const road::World& world) {
  Line3 places{{world.start().x_m, world.start().y_m, 0.0}};
  for (const auto& thing : world.props()->placements) places.emplace_back(thing.at_W.x(), thing.at_W.y(), 0.0);
  for (const auto& run : world.props()->runs) {
    for (const Eigen::Vector2d& p : run.points_W) places.emplace_back(p.x(), p.y(), 0.0);
  }
  return places;
}

// Here SUELO ends: what is drawn beyond is a face of its own.
Line3 BorderOf(const road::Extents& e) {
  return {{e.west_m, e.south_m, 0.0},
          {e.east_m, e.south_m, 0.0},
          {e.east_m, e.north_m, 0.0},
          {e.west_m, e.north_m, 0.0},
          {e.west_m, e.south_m, 0.0}};
}

}  // namespace

void ForEachAtOnce(std::size_t count, unsigned threads, const std::function<void(std::size_t)>& work,
                   const std::function<void(std::size_t)>& told) {
  base::ThreadPool pool(threads);
  std::atomic<std::size_t> next{0}, done{0};
  const auto run = [&](const std::function<void(std::size_t)>& tell) {
    for (std::size_t i = next++; i < count; i = next++) {
      work(i);
      const std::size_t so_far = ++done;
      if (tell && so_far < count) tell(so_far);
    }
  };
  const std::function<void(std::size_t)> silent;
  pool.ParallelFor(pool.threads(), [&](std::size_t first, std::size_t) { run(first == 0 ? told : silent); });
  if (told) told(count);
}

GroundPlan::GroundPlan(const road::World& world, unsigned threads, ModelIsThere is_there)
    : seen_(world.AsSeen()),
      world_(*seen_),
      things_(world, std::move(is_there)),
      land_{PostLines(world), {}, {}},
      edges_(land_.posts) {
  const auto roads = world.network()->roads();
  std::vector<std::vector<Line3>> lines(roads.size());
  std::vector<std::array<TilePaint, kGroundLevels - 1>> paint(roads.size());
  ForEachAtOnce(roads.size(), threads, [&](std::size_t i) {
    lines[i] = RoadLinesOf(roads[i], kRoadTolerances[0]);
    MeetMeasured(world_, roads[i], kRoadTolerances[0], lines[i]);
    AddLaidLines(world_, roads[i], kRoadTolerances[0], lines[i]);
    AddStructureLines(roads[i],
                      world.land() != nullptr ? std::span(world.land()->decks()[i]) : std::span<const road::Stretch>(),
                      lines[i]);
    for (std::size_t level = 0; level < paint[i].size(); ++level)
      PaintRoad(roads[i], kPaintChords_m[level], paint[i][level]);
  });
  for (const network::Placed& placed : network::PlaceFurniture(*world.network()).things) {
    for (TilePaint& level : paint[placed.road]) PaintThing(*world.network(), placed, level);
  }
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
  for (const auto& [key, things] : things_.tiles()) tiles.insert(key);
  if (world.plane() && world.props() != nullptr) AddReach(PlacesOf(world), tiles);
  if (world.grid() != nullptr) {
    AddRectangle(world.extents(), tiles);
    const Line3 border = BorderOf(world.extents());
    AddToTiles({&border, 1}, pieces);
  }
  for (std::size_t i = 0; i < roads.size(); ++i) {
    if (!world.open_drive()) land_.slopes.Add(lines[i], LandReachOf(world_, roads[i]) + 1.0);
    AddDecks(world, static_cast<std::uint32_t>(i), land_.decks);
  }
  sources_ = TileSources(world_, lines);
  land_digest_ = LandDigest(world);
  tiles_.assign(tiles.begin(), tiles.end());
  std::vector<std::pair<const TileKey, std::vector<tessellation::GridLine>>*> open;
  for (auto& piece : pieces) open.push_back(&piece);
  std::vector<std::vector<tessellation::GridSegment>> noded(open.size());
  ForEachAtOnce(open.size(), threads, [&](std::size_t i) { noded[i] = tessellation::Node(open[i]->second); });
  for (std::size_t i = 0; i < open.size(); ++i) {
    edges_.Add(open[i]->first, noded[i]);
    segments_[open[i]->first] = std::move(noded[i]);
  }
}

TileBall GroundPlan::BallOf(const TileKey& key) const {
  TileBall ball;
  const Eigen::Vector2d middle = key.south_west_W() + Eigen::Vector2d::Constant(0.5 * kTile_m);
  std::vector<road::SurfacePoint> levels;
  LevelsAt(world_, middle, 1, levels);
  ball.centre_W = {middle.x(), middle.y(), levels.empty() ? 0.0 : levels.front().z_m};
  return ball;
}

int GroundPlan::FinestAlike(const TileKey& key, int level) const {
  const auto is_painted = [&](const TilePaint& paint) { return paint.contains(key); };
  if (!IsBare(key) || things_.tiles().contains(key) || std::any_of(paint_.begin(), paint_.end(), is_painted))
    return level;
  int finest = level;
  while (finest > 0 && land_.EveryPost(finest) == 1 && land_.EveryPost(finest - 1) == 1) --finest;
  return finest;
}

std::size_t GroundPlan::PiecesIn(const TileKey& key) const {
  const auto found = segments_.find(key);
  return found == segments_.end() ? 0 : found->second.size();
}

struct GroundPlan::Begun {
  TileKey key;
  std::span<const tessellation::GridSegment> finest;
  TileChains lines;
  bool bare;
  std::vector<tessellation::GridPoint> edge;
  WovenTile woven;
  int woven_level;  // -1: none yet
};

GroundPlan::Begun GroundPlan::Begin(const TileKey& key) const {
  const auto found = segments_.find(key);
  const auto finest =
      found == segments_.end() ? std::span<const tessellation::GridSegment>() : std::span(found->second);
  Begun begun{key, finest, TileChains(finest, key, world_), IsBare(key), edges_.Of(key), {}, -1};
  if (!begun.bare)
    RefineEdges(world_, key, begun.edge, land_.DecksAtEdges(key));  // the terrain's triangles have their points there
  return begun;
}

GroundLevel GroundPlan::LevelOf(Begun& begun, int level) const {
  const TileKey& key = begun.key;
  const auto at = static_cast<std::size_t>(level);
  int as = level;
  while (begun.bare && as > 0 && land_.EveryPost(as) == 1) --as;  // as the level before
  if (begun.woven_level != as) {
    const auto simplified = as == 0 || begun.finest.empty()
                                ? std::vector<tessellation::GridSegment>()
                                : begun.lines.Simplified(kRoadTolerances[static_cast<std::size_t>(as)]);
    begun.woven =
        WeaveTile(world_, PlanTile(world_, land_, key, as == 0 ? begun.finest : std::span(simplified), begun.edge, as));
    begun.woven_level = as;
  }
  GroundLevel made;
  made.ground = begun.woven.meshes;
  if (at < paint_.size()) {
    if (const auto paint = paint_[at].find(key); paint != paint_[at].end())
      made.marks = LayPaint(paint->second, key, begun.woven.triangles);
  }
  if (const auto things = things_.tiles().find(key); things != things_.tiles().end()) {
    DrawnStaticObjects drawn = DrawStaticObjects(things->second, key, level);
    made.things = std::move(drawn.meshes);
    made.repeated = std::move(drawn.repeated);
    made.models = ModelsOf(things->second, level);
  }
  return made;
}

GroundTile GroundPlan::Build(const TileKey& key) const {
  GroundTile tile;
  tile.key = key;
  Begun begun = Begin(key);
  for (int level = 0; level < kGroundLevels; ++level)
    tile.levels[static_cast<std::size_t>(level)] = LevelOf(begun, level);
  tile.ball = BallOf(key);
  return tile;
}

GroundLevel GroundPlan::BuildLevel(const TileKey& key, int level) const {
  Begun begun = Begin(key);
  return LevelOf(begun, level);
}

}  // namespace rodeira::scene
