// SPDX-License-Identifier: Apache-2.0
#pragma once

/// @file
/// The ground: height, normal, friction and surface at points of the world.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

/// The ground below the vehicles, as the ground server (SUELO) knows it.
namespace rodeira::ground {

/// The material of the ground at a point. The numbers are on the wire and in recordings; they never change.
enum class Surface : std::uint32_t {
  kOutside = 0,   ///< no ground is known at the point
  kAsphalt = 1,   ///< asphalt
  kConcrete = 2,  ///< concrete
  kGravel = 3,    ///< gravel
  kGrass = 4,     ///< grass
  kSoil = 5,      ///< soil
  kRoadMark = 6,  ///< a painted mark on the road
};

/// Gives the name of a surface, as in files and tables.
/// @param surface the surface
/// @return lower-case name ("asphalt"); "unknown" for another number
std::string_view SurfaceName(Surface surface);

/// Greatest height of a surface above a query's height hint, in m.
inline constexpr double kMaxAboveHint_m = 0.5;

/// One query: a point in the world frame W (x east, y north, z up). Where surfaces lie over one another the height hint
/// selects the highest surface with z <= z_hint_m + kMaxAboveHint_m.
struct GroundQuery {
  double x_m = 0.0;                                            ///< east
  double y_m = 0.0;                                            ///< north
  double z_hint_m = std::numeric_limits<double>::quiet_NaN();  ///< height near the surface; NaN: the top surface
};

/// The answer to a query. The initial values are those of a point outside of the world.
struct GroundPoint {
  double z_m = 0.0;                                     ///< height of the surface
  Eigen::Vector3d normal_W = Eigen::Vector3d::UnitZ();  ///< normal in W, of unit length, upward
  double friction = 0.0;                                ///< coefficient of the dry surface, 1: dry asphalt
  Surface surface = Surface::kOutside;                  ///< material
  bool inside = false;                                  ///< false: the point is outside of the world
};

/// A horizontal rectangle of points, as a tyre's contact needs it: `along` rows from the rear to the front, each of
/// `across` points from the right to the left. The points are spread evenly with the outermost on the edges; a single
/// one lies in the middle.
struct GroundPatch {
  double x_m = 0.0;                                            ///< middle of the rectangle, east
  double y_m = 0.0;                                            ///< middle of the rectangle, north
  double heading_rad = 0.0;                                    ///< direction of the length, from east to north
  double length_m = 0.0;                                       ///< from the rear edge to the front edge
  double width_m = 0.0;                                        ///< from the right edge to the left edge
  int along = 1;                                               ///< number of rows, at least 1
  int across = 1;                                              ///< number of points in a row, at least 1
  double z_hint_m = std::numeric_limits<double>::quiet_NaN();  ///< height hint of all points (GroundQuery)

  /// Gives the number of points.
  /// @return along * across
  std::size_t size() const { return static_cast<std::size_t>(along) * static_cast<std::size_t>(across); }
};

/// The ground of a world: a pure function of the world (law L4). Batch, order and cache never change a bit of an
/// answer. Call an object from one thread at a time.
class Ground {
 public:
  virtual ~Ground() = default;
  /// Answers queries as one batch. With the ground server in another process a call is one round trip.
  /// @param queries the queries
  /// @param points receives the answer to queries[i] in points[i]; of the same length as `queries`
  virtual void Query(std::span<const GroundQuery> queries, std::span<GroundPoint> points) = 0;

  /// Answers one query.
  /// @param x_m east, in W
  /// @param y_m north, in W
  /// @param z_hint_m height near the surface; NaN: the top surface
  /// @return the answer
  GroundPoint At(double x_m, double y_m, double z_hint_m = std::numeric_limits<double>::quiet_NaN());
  /// Answers all points of a patch as one batch.
  /// @param patch the patch
  /// @param points receives the answer for row i and column j in points[i * across + j]; of the patch's size
  void Patch(const GroundPatch& patch, std::span<GroundPoint> points);
  /// Finds all surfaces at a point, by several batches. Surfaces with less than a micrometre between them count as one.
  /// @param x_m east, in W
  /// @param y_m north, in W
  /// @return the surfaces from the top one downward; empty outside of the world
  std::vector<GroundPoint> Layers(double x_m, double y_m);
};

/// Gives the query for one point of a patch.
/// @param patch the patch
/// @param row row of the point, from 0 at the rear
/// @param column column of the point, from 0 at the right
/// @return the query
GroundQuery PatchPoint(const GroundPatch& patch, int row, int column);

/// An unbounded inclined plane for tests and studies: z = z0 + slope_x (x - x0) + slope_y (y - y0).
class PlaneGround final : public Ground {
 public:
  /// Makes the plane z = 0 of dry asphalt.
  PlaneGround() = default;
  /// Makes a plane.
  /// @param origin a point (x0, y0, z0) of the plane in W, in m
  /// @param slope_x rise per metre eastward
  /// @param slope_y rise per metre northward
  /// @param friction friction coefficient everywhere
  /// @param surface material everywhere
  PlaneGround(Eigen::Vector3d origin, double slope_x, double slope_y, double friction = 1.0,
              Surface surface = Surface::kAsphalt);
  /// @copydoc Ground::Query
  void Query(std::span<const GroundQuery> queries, std::span<GroundPoint> points) override;

 private:
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  double slope_x_ = 0.0;
  double slope_y_ = 0.0;
  double friction_ = 1.0;
  Surface surface_ = Surface::kAsphalt;
};

}  // namespace rodeira::ground
