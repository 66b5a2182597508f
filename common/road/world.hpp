#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/hash.hpp"
#include "common/base/result.hpp"
#include "common/road/road.hpp"
#include "common/terrain/elevation_grid.hpp"
#include "common/terrain/ground.hpp"

namespace rodeira::road {

// Where the driver's car stands when the simulation begins.
struct StartPose {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;  // from east to north
  // On a road: which one (an index into World::roads()), which lane, where along it. Otherwise -1, 0, 0.
  int road = -1;
  int lane = 0;
  double s_m = 0.0;
};

// An unbounded inclined plane: z = z_m + slope_x x + slope_y y.
struct PlaneSpec {
  double z_m = 0.0;
  double slope_x = 0.0;
  double slope_y = 0.0;
};

// The rectangle in which the ground is known; infinite for a plane.
struct Extents {
  double west_m = 0.0;
  double south_m = 0.0;
  double east_m = 0.0;
  double north_m = 0.0;
};

// Friction coefficients by surface, indexed by the Surface's number.
using FrictionTable = std::array<double, 7>;

struct WorldSpec;

// A world: terrain (an elevation grid or a plane), roads, their marks. Immutable and shared; the same file gives the
// same content hash, and the same content hash the same answers, bit by bit.
class World : public std::enable_shared_from_this<World> {
 public:
  // Reads a world file (docs/formats.md) and all files that it names. Wrong input where anything is missing, broken,
  // out of range or does not fit together.
  static base::Result<std::shared_ptr<const World>> Load(const std::filesystem::path& world_yaml);
  // The same from a text; `name` stands for the path in messages, and relative paths start at its folder.
  static base::Result<std::shared_ptr<const World>> Parse(std::string_view text, const std::filesystem::path& name);
  // From its parts, checked by the caller.
  static std::shared_ptr<const World> Make(WorldSpec spec);

  const std::string& name() const { return name_; }
  std::span<const Road> roads() const { return roads_; }
  // The elevation grid under the roads, for meshes, or null for a plane. Near a road the ground is not the grid's:
  // ask MakeGround() for heights.
  const terrain::ElevationGrid* grid() const { return grid_.get(); }
  const std::optional<PlaneSpec>& plane() const { return plane_; }
  Extents extents() const;
  const StartPose& start() const { return start_; }
  terrain::Surface terrain_surface() const { return terrain_surface_; }
  double Friction(terrain::Surface surface) const;
  // The coordinate system as WKT, from the .prj; empty where there is none. Not part of the content hash.
  const std::string& projection() const;

  // SUELO on this world, which it keeps alive. Any number of them, on any threads.
  std::unique_ptr<terrain::Ground> MakeGround() const;
  // Of everything that can change an answer (numbers of roads, lanes, marks, terrain, friction, start), and of nothing
  // else: names, comments, paths, the order of keys.
  base::Digest content_hash() const { return content_hash_; }

 private:
  explicit World(WorldSpec spec);

  std::string name_;
  std::vector<Road> roads_;
  std::shared_ptr<const terrain::ElevationGrid> grid_;
  std::optional<PlaneSpec> plane_;
  terrain::Surface terrain_surface_;
  FrictionTable friction_;
  StartPose start_;
  base::Digest content_hash_ = 0;
};

}  // namespace rodeira::road
