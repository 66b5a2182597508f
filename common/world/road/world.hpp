// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/hash.hpp"
#include "common/core/base/result.hpp"
#include "common/core/ground/ground.hpp"
#include "common/world/road/bare_terrain.hpp"
#include "common/world/road/lane_grounds.hpp"
#include "common/world/road/world_spec.hpp"
#include "common/world/terrain/elevation_grid.hpp"

namespace rodeira::road {

class BuiltGround;
class MarkPaint;
class NetworkLand;

// The rectangle in which the ground is known, in W (x east, y north); infinite for a plane.
struct Extents {
  double west_m = 0.0;
  double south_m = 0.0;
  double east_m = 0.0;
  double north_m = 0.0;
};

// A world: terrain (an elevation grid or a plane) and a network of roads; or the roads of an OpenDRIVE file alone.
// Immutable and shared; the same file gives the same content hash, and the same content hash the same answers, bit by
// bit. Any number of threads may ask at the same time. Coordinates are in W: x east, y north, z up, metres.
class World : public std::enable_shared_from_this<World> {
 public:
  // Reads a world file (docs/reference/world-files.md) and all files that it names, or an OpenDRIVE file (`.xodr`), or
  // a traffic map (`.motors`). Wrong input where anything is missing, broken, out of range or does not fit together.
  static base::Result<std::shared_ptr<const World>> Load(const std::filesystem::path& world_yaml);
  // The same from a text; `name` stands for the path in messages, and relative paths start at its folder.
  static base::Result<std::shared_ptr<const World>> Parse(std::string_view text, const std::filesystem::path& name);
  // From its parts, which must fit together as a world file's do; they are not checked.
  static std::shared_ptr<const World> Make(WorldSpec spec);

  const std::string& name() const { return name_; }
  // The roads, of every kind of file; null where the world has none. The outermost lanes are the verges.
  const network::Network* network() const { return network_.get(); }
  // The elevation grid under the roads, for meshes, or null for a plane. Near a road the ground is not the grid's:
  // ask MakeGround() for heights.
  const terrain::ElevationGrid* grid() const { return terrain_.grid.get(); }
  // The plane under the roads; nothing where the world has a grid, or is an OpenDRIVE file.
  const std::optional<PlaneSpec>& plane() const { return terrain_.plane; }
  // The world is an OpenDRIVE file: it has no terrain of its own.
  bool open_drive() const { return terrain_.grid == nullptr && !terrain_.plane; }
  // What lies beside and under such roads; null where the world is none.
  const NetworkLand* land() const { return land_.get(); }
  // Of the grid, else of the roads of an OpenDRIVE file, else infinite.
  Extents extents() const;
  // Where a car starts that is told no other place.
  const StartPose& start() const { return start_; }
  // Of the terrain without roads: its surface, and its friction (1: dry asphalt).
  ground::Surface terrain_surface() const { return terrain_.surface; }
  double terrain_friction() const { return terrain_.friction; }
  // What lies on the terrain to be seen, and changes no answer; null: nothing.
  const terrain::LaidPicture* ground_picture() const { return ground_picture_ ? &*ground_picture_ : nullptr; }
  // What stands on the ground at no road, on SUELO's highest surface there; null: nothing.
  const network::Props* props() const { return props_.get(); }
  // Of what lies on a road between two stations, measured or laid by an author, as SurfaceDetail::DigestOn says; 0:
  // nothing.
  base::Digest DetailDigest(std::uint32_t road, double from_s_m, double to_s_m) const;
  // The surfaces of the junctions of a network that is built into a terrain.
  std::span<const std::shared_ptr<const design::JunctionSurface>> junctions() const;
  // What was repaired in an OpenDRIVE file: one sentence a kind, with its place.
  std::span<const std::string> warnings() const { return warnings_; }
  // The coefficient of a surface in this world, dry; 1: asphalt.
  double Friction(ground::Surface surface) const { return friction_[static_cast<std::size_t>(surface)]; }

  // SUELO (law L4) on this world, which it keeps alive. Any number of them, on any threads. Where surfaces lie over one
  // another, the height hint chooses.
  std::unique_ptr<ground::Ground> MakeGround() const;
  // One of its answers: the road within its verges, and beside it the terrain, which Earthworks shapes to meet it. The
  // hint chooses between surfaces as in ground::GroundQuery. Outside of the extents `inside` is false.
  SurfacePoint At(double x_m, double y_m, double z_hint_m = std::numeric_limits<double>::quiet_NaN()) const;
  // The world as it is drawn: its roads without what is too fine for a picture, made roughness and the short waves of
  // measured surfaces. This world itself where it has neither; the same network, hash and everything else.
  std::shared_ptr<const World> AsSeen() const;
  // The terrain without any road.
  SurfacePoint TerrainAt(double x_m, double y_m) const { return terrain_.At(x_m, y_m); }

  // Of everything that can change an answer (numbers of roads, lanes, marks, terrain, friction, start), and of nothing
  // else: names, comments, paths, the coordinate system's name, the order of keys.
  base::Digest content_hash() const { return content_hash_; }

 private:
  explicit World(WorldSpec spec);
  World(const World&) = default;

  std::string name_;
  BareTerrain terrain_;
  std::shared_ptr<const network::Network> network_;
  std::shared_ptr<const network::Props> props_;
  std::shared_ptr<const SurfaceDetail> detail_;
  std::shared_ptr<const BuiltGround> built_;  // of a network in a terrain or on a plane
  std::optional<terrain::LaidPicture> ground_picture_;
  FrictionTable friction_;
  LaneGrounds grounds_;                      // of an OpenDRIVE file
  std::shared_ptr<const MarkPaint> paint_;   // the same
  std::shared_ptr<const NetworkLand> land_;  // the same
  StartPose start_;
  std::vector<std::string> warnings_;
  base::Digest content_hash_ = 0;
};

}  // namespace rodeira::road
