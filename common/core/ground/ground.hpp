// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

namespace rodeira::ground {

// What the ground is made of at a point; the number is on the wire and in recordings: never renumber.
enum class Surface : std::uint32_t {
  kOutside = 0,  // no ground known here
  kAsphalt = 1,
  kConcrete = 2,
  kGravel = 3,
  kGrass = 4,
  kSoil = 5,
  kRoadMark = 6,
};

std::string_view SurfaceName(Surface surface);

// How far above the hint a surface may lie to be meant.
inline constexpr double kHintAbove_m = 0.5;

// One question to SUELO: where, and near which height. The hint selects among surfaces that lie over one another (the
// highest with z <= hint + kHintAbove_m); NaN means none is given and the top one is meant.
struct GroundQuery {
  double x_m = 0.0;
  double y_m = 0.0;
  double z_hint_m = std::numeric_limits<double>::quiet_NaN();
};

// SUELO's answer. Outside the world: inside false, z 0, normal up, friction 0, kOutside.
struct GroundPoint {
  double z_m = 0.0;
  Eigen::Vector3d normal_W = Eigen::Vector3d::UnitZ();  // unit length, upward
  double friction = 0.0;                                // coefficient of the dry surface, 1: dry asphalt
  Surface surface = Surface::kOutside;
  bool inside = false;
};

// A rectangle of points lying in the plane, as a tyre's contact needs it: `along` rows from the rear to the front, each
// of `across` points from the right to the left, spread evenly with the outermost on the edges (one: in the middle).
struct GroundPatch {
  double x_m = 0.0;  // of its middle
  double y_m = 0.0;
  double heading_rad = 0.0;  // of its length, from east to north
  double length_m = 0.0;
  double width_m = 0.0;
  int along = 1;
  int across = 1;
  double z_hint_m = std::numeric_limits<double>::quiet_NaN();

  std::size_t size() const { return static_cast<std::size_t>(along) * static_cast<std::size_t>(across); }
};

// SUELO (law L4): a pure function of the world. Batch, order and cache never change a bit of an answer.
class Ground {
 public:
  virtual ~Ground() = default;
  // Answers points[i] for queries[i]; the spans are of equal length.
  virtual void Query(std::span<const GroundQuery> queries, std::span<GroundPoint> points) = 0;

  GroundPoint At(double x_m, double y_m, double z_hint_m = std::numeric_limits<double>::quiet_NaN());
  // Answers points[i * across + j] for the patch's row i and column j, as one batch; the span has the patch's size.
  void Patch(const GroundPatch& patch, std::span<GroundPoint> points);
  // All surfaces at (x, y), from the top one down; empty where there is none. Those nearer to one another than a
  // micrometre count as one.
  std::vector<GroundPoint> Layers(double x_m, double y_m);
};

// Where the point of row i and column j of a patch lies.
GroundQuery PatchPoint(const GroundPatch& patch, int row, int column);

// An unbounded inclined plane through `origin`, for tests and studies: z = z0 + slope_x (x - x0) + slope_y (y - y0).
class PlaneGround final : public Ground {
 public:
  PlaneGround() = default;
  PlaneGround(Eigen::Vector3d origin, double slope_x, double slope_y, double friction = 1.0,
              Surface surface = Surface::kAsphalt);
  void Query(std::span<const GroundQuery> queries, std::span<GroundPoint> points) override;

 private:
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  double slope_x_ = 0.0;
  double slope_y_ = 0.0;
  double friction_ = 1.0;
  Surface surface_ = Surface::kAsphalt;
};

}  // namespace rodeira::ground
