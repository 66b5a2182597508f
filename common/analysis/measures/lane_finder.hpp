// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "common/world/lanes/graph.hpp"

namespace rodeira::measures {

// Where a vehicle is in the world, seen along its own direction.
struct LanePlace {
  network::LaneKey lane;
  std::int64_t track = -1;  // of the lane graph; below 0: none
  double along_m = 0.0;     // distance along that track
  double s_m = 0.0, t_m = 0.0;
  double width_m = 0.0;
  double position_m = 0.0;  // from the lane's middle, positive to the vehicle's left
  double heading_error_rad = 0.0;
  double curvature_1pm = 0.0;  // of the lane's middle, positive to the vehicle's left
  bool along_s = true;         // the vehicle's direction is that of the road's stations
  bool junction = false;
  std::optional<double> speed_limit_mps;  // none: nothing is said, or there is no limit
};

// Finds the lane of a point. A vehicle with its reference point on a lane that is not for driving, as a shoulder, keeps
// the position in the nearest driving lane, up to that lane's width beyond its edge; farther beside it is in none.
class LaneFinder {
 public:
  // The graph outlives it.
  explicit LaneFinder(const lanes::Graph& graph) : graph_(graph) {}

  // The nearest driving lane, at most a lane's width beside it; else nothing. The heading counts from east; the hint
  // only saves work.
  std::optional<LanePlace> Find(double x_m, double y_m, double z_m, double heading_rad, network::Hint& hint) const;
  // Only the track and the distance along it.
  struct OnTrack {
    std::uint32_t track = 0;
    double along_m = 0.0;
  };
  // The hint only saves work.
  std::optional<OnTrack> FindTrack(double x_m, double y_m, double z_m, network::Hint& hint) const;

 private:
  const lanes::Graph& graph_;
};

// +1: the second lane lies beside the first one on the vehicle's left; -1: on its right; 0: neither, or the same.
int SideOf(const network::Network& network, const LanePlace& from, const LanePlace& to);
// The second place is in the same lane, or in one that the first one's lane goes on into.
bool GoesOn(const lanes::Graph& graph, const LanePlace& from, const LanePlace& to);

}  // namespace rodeira::measures
