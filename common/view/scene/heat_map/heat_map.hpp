// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string_view>

#include "common/view/scene/mesh/mesh.hpp"
#include "common/view/scene/vehicles/scene_snapshot.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::scene {

enum class HeatKind { kSpeed, kFlow, kDensity, kFuel };
inline constexpr std::size_t kHeatKinds = 4;

// A statistic's scale. Red is at `red`, green at `green`, yellow in the middle.
struct HeatScale {
  std::string_view name, unit;
  double red = 0.0, green = 1.0;  // in the unit
};
// Of the mean speed green is the limit of the lane, so its scale is in per cent of that.
const HeatScale& ScaleOf(HeatKind kind);

// From 0 (red) through one half (yellow) to 1 (green); cut outside.
Colour HeatColour(double share);
inline constexpr double kHeatShare = 0.7;  // of that colour, over 0.3 of the ground (MOTORS, 5.2)

// What a square of the ground has seen: sums over all vehicles' middles (Edie 1963).
struct HeatCell {
  double time_s = 0.0, distance_m = 0.0;
  double fuel_l = 0.0, fuel_distance_m = 0.0;  // of those with a known consumption
  double limit_mps = 0.0;                      // of the lane there; 0: none is known
  double height_ms = 0.0;                      // the integral of the height over the time
};

// Statistics of all that drives, by squares of the ground, gathered from the moments that are shown: live or of a
// recording, forward or backward. From moment to moment each vehicle's way, time and fuel are shared out among the
// squares that it crosses, in pieces of a quarter of a square at most.
class HeatMap {
 public:
  static constexpr double kSquare_m = 4.0;
  static constexpr double kLongest_s = 1.0;  // two moments farther apart are a leap: all begins anew

  // The world must outlive it.
  explicit HeatMap(const road::World& world) : world_(world) {}

  // The next moment that is shown. The same one again changes nothing.
  void Add(const SceneSnapshot& moment);
  // Begins anew.
  void Clear();
  double watched_s() const { return watched_s_; }

  // West and south edge, and level, in whole squares (levels: of 5 m).
  struct Key {
    std::int64_t column = 0, row = 0, level = 0;
    auto operator<=>(const Key&) const = default;
  };
  const std::map<Key, HeatCell>& cells() const { return cells_; }
  // In the scale's unit: flow q = distance / (side · time), density k = time / (side · time), mean speed v = distance /
  // time in per cent of the limit (100 km/h where none is known), consumption. Nothing where none was, or none
  // with a known consumption.
  std::optional<double> Value(HeatKind kind, const HeatCell& cell) const;

 private:
  void AddWay(const Eigen::Vector3d& from_W, const Eigen::Vector3d& to_W, double time_s, std::optional<double> fuel_l);
  HeatCell& CellAt(const Eigen::Vector3d& p_W);

  const road::World& world_;
  std::map<Key, HeatCell> cells_;
  std::optional<SceneSnapshot> before_;
  double watched_s_ = 0.0;
};

}  // namespace rodeira::scene
