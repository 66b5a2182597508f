// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "common/core/geometry/plane.hpp"
#include "common/world/lanes/graph.hpp"

namespace rodeira::traffic {

// A rectangle along a chord of a lane's middle, narrower than the lane: all ground in it is that lane's.
struct alignas(64) Corridor {
  // Points are at most this far above or below the chord. The rest of a level is for what a chord neglects of its lane.
  static constexpr double kRise_m = network::Network::kLevel_m - 0.5;

  Eigen::Vector2d from_W = Eigen::Vector2d::Zero();
  Eigen::Vector2d ahead_W = Eigen::Vector2d::UnitX();
  double length_m = 0.0;
  double half_m = -1.0;  // to either side; negative: none of the lane is sure
  double z_m = 0.0;      // of the chord at its beginning
  double grade = 0.0;

  // Whether a point lies in it, on the lane's level.
  bool Holds(const Eigen::Vector3d& p_W) const;
  // Whether all points p + x · forward + y · left with |x| ≤ along and |y| ≤ aside do.
  bool HoldsAll(const Eigen::Vector3d& p_W, const Eigen::Vector3d& forward_W, const Eigen::Vector3d& left_W,
                double along_m, double aside_m) const;
};

inline bool Corridor::Holds(const Eigen::Vector3d& p_W) const {
  const Eigen::Vector2d d_W = p_W.head<2>() - from_W;
  const double along = ahead_W.dot(d_W);
  return along >= 0.0 && along <= length_m && std::fabs(geometry::Cross(ahead_W, d_W)) <= half_m &&
         std::fabs(p_W.z() - z_m - grade * along) <= kRise_m;
}

inline bool Corridor::HoldsAll(const Eigen::Vector3d& p_W, const Eigen::Vector3d& forward_W,
                               const Eigen::Vector3d& left_W, double along_m, double aside_m) const {
  const Eigen::Vector2d d_W = p_W.head<2>() - from_W, f_W = forward_W.head<2>(), l_W = left_W.head<2>();
  const double along = ahead_W.dot(d_W),
               reach = along_m * std::fabs(ahead_W.dot(f_W)) + aside_m * std::fabs(ahead_W.dot(l_W));
  if (along < reach || along + reach > length_m) return false;
  const double across =
      along_m * std::fabs(geometry::Cross(ahead_W, f_W)) + aside_m * std::fabs(geometry::Cross(ahead_W, l_W));
  if (std::fabs(geometry::Cross(ahead_W, d_W)) + across > half_m) return false;
  const double rise = along_m * std::fabs(forward_W.z()) + aside_m * std::fabs(left_W.z()) + std::fabs(grade) * reach;
  return std::fabs(p_W.z() - z_m - grade * along) + rise <= kRise_m;
}

// The corridors of a network's tracks, in the order in which their traffic passes them. Those of a track are made when
// first asked for. Indices stay valid; references hold until the next call.
class Corridors {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

  // The graph outlives it.
  explicit Corridors(const lanes::Graph& graph);

  const Corridor& operator[](std::uint32_t index) const { return corridors_[index]; }
  // The track that the corridor is a part of.
  std::uint32_t TrackOf(std::uint32_t index) const { return tracks_[index]; }
  // That beside which d of a track lies.
  std::uint32_t At(std::uint32_t track, double d_m);
  // Those that a vehicle may come to next: before and behind on its way, on the lanes beside,
  // and on those that part from where its lane begins.
  std::span<const std::uint32_t> Around(std::uint32_t index);

 private:
  struct Range {
    std::uint32_t first = kNone, end = kNone;
  };
  Range RangeOf(std::uint32_t track);
  void Make(std::uint32_t track);
  Corridor Between(const lanes::Curve& curve, std::size_t from, std::size_t to) const;
  void AddAhead(std::uint32_t index, double to_d_m, std::vector<std::uint32_t>& around);
  void AddParting(std::uint32_t index, std::vector<std::uint32_t>& around);
  void AddBeside(std::uint32_t index, std::uint32_t beside, std::vector<std::uint32_t>& around);

  const lanes::Graph& graph_;
  std::vector<Range> ranges_;        // by track
  std::vector<Corridor> corridors_;  // those of one track together, in its order
  std::vector<std::uint32_t> tracks_;
  std::vector<double> begins_d_m_;                  // by corridor
  std::vector<std::vector<std::uint32_t>> around_;  // by corridor; empty: not yet found
};

}  // namespace rodeira::traffic
