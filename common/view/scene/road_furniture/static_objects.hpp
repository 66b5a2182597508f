// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/core/base/hash.hpp"
#include "common/view/scene/mesh/mesh.hpp"
#include "common/view/scene/mesh/repeated.hpp"
#include "common/view/scene/mesh/solids.hpp"
#include "common/view/scene/tiles/tile_grid.hpp"
#include "common/world/network/placing.hpp"
#include "common/world/network/tubes.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::scene {

// What is lower lies: it is not drawn as a thing.
inline constexpr double kFlatThing_m = 0.02;
// Pieces of walls and rails are no longer, so that they follow the ground.
inline constexpr double kMaxRailPiece_m = 4.0;

enum class ThingKind {
  kTree,
  kBush,
  kHouse,
  kFillingStation,
  kPost,
  kLamp,
  kPlain,
  kOutline,
  kSign,
  kTrafficLight,
  kModel,
  kBar
};

// Something that stands, as it is to be drawn.
struct Thing {
  ThingKind kind = ThingKind::kPlain;
  Stand stand;           // on the ground, and the way it looks (models.hpp says of each)
  double above_m = 0.0;  // over the ground: of a plate its lower edge
  double length_m = 0.0, width_m = 0.0, height_m = 0.0, radius_m = 0.0;
  std::string face;    // of a sign
  std::string file;    // of a model: a graphics library reads it
  std::string signal;  // of a traffic light: the signal's id
  bool both_sides = false;
  bool on_post = false;                 // of signs and traffic lights; what hangs over a lane has none
  Colour colour;                        // of plain ones and outlines
  std::vector<Eigen::Vector3d> feet_W;  // of an outline; of a bar its two ends
  std::vector<double>
      heights_m;              // of a bar the halves of what BarEnd calls wide and high, at its beginning and at its end
  bool closed = true;         // of a bar: it is round
  std::optional<Colour> top;  // of an outline; nothing: as its walls, a little darker
};

// A piece of a rail or wall. Neighbours meet in the same points.
struct RailPiece {
  bool wall = false;
  std::array<Eigen::Vector3d, 2> foot_W = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  std::array<Eigen::Vector2d, 2> left_W = {Eigen::Vector2d::UnitY(), Eigen::Vector2d::UnitY()};
  std::array<double, 2> height_m{}, width_m{};
};

// Whether the file of a model can be read; without one: each can.
using ModelIsThere = std::function<bool(const std::string& file)>;

// What stands at a network's roads and around them in tunnels, and at none, by the tiles in which it stands. Pure
// functions of the world. Feet are on SUELO's ground, on the level nearest to the road's own surface at (s, t), which
// counts itself where SUELO knows no ground: what stands is seen to stand on what is drawn. Objects without any height
// (markings, parking places) and signals that are only paint are left out.
class StaticObjects {
 public:
  // world.network() must not be null; the network must outlive this.
  // In place of a model that is not there stands what is drawn without one.
  explicit StaticObjects(const road::World& world, ModelIsThere is_there = {});

  // What stands in it, in W.
  struct Tile {
    std::vector<Thing> things;
    std::vector<RailPiece> rails;
    std::vector<network::TubePiece> tubes;
  };
  const std::map<TileKey, Tile>& tiles() const { return tiles_; }
  // Of everything that stands in a tile; 0 where nothing does.
  base::Digest DigestOf(const TileKey& tile) const;

 private:
  static Thing ThingAt(const network::Placed& placed, const Eigen::Vector3d& foot_W);  // its kind is still open
  void AddThing(const road::World& world, const network::Placed& placed);
  void AddSignal(const network::Road& road, const network::Placed& placed, Thing thing);
  void AddObject(const network::Road* road, const network::Placed& placed, Thing thing);  // null: at no road
  void AddOutlines(const network::Road* road, const network::Placed& placed, const Thing& thing);
  void AddSkeleton(const network::Road* road, const network::Placed& placed, const Thing& thing);
  void AddRun(const road::World& world, const network::PlacedRun& run);
  void AddProps(const road::World& world, const network::Props& props);
  void Keep(Thing thing);
  void KeepRail(const RailPiece& piece);

  ModelIsThere is_there_;
  std::map<TileKey, Tile> tiles_;
};

// A model from a file at its place: x forward, z up, in metres.
struct PlacedModel {
  std::string file;
  Stand stand;
};

// A tile's models at a level of detail: all of them but at level 3, where there are none.
std::vector<PlacedModel> ModelsOf(const StaticObjects::Tile& tile, int level);

// What of a tile's things is drawn once, and what at many places; all with the same origin.
struct DrawnStaticObjects {
  std::vector<Mesh> meshes;
  std::vector<Repeated> repeated;  // trees, posts, lamps …, each at kFewestPlaces or more
};
inline constexpr std::size_t kFewestPlaces = 8;

// A tile's things at a level of detail: at level 0 and 1 everything, simpler at 1; at 2 trees,
// houses and rails as plain as can be; at 3 only houses and what else is large. Tunnels are tubes at all of them.
DrawnStaticObjects DrawStaticObjects(const StaticObjects::Tile& tile, const TileKey& key, int level);

}  // namespace rodeira::scene
