// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "common/analysis/measures/lane_finder.hpp"
#include "common/analysis/measures/measure.hpp"

namespace rodeira::measures {

// Another road user near the subject.
struct OtherVehicle {
  std::int64_t id = 0;
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;
  double speed_mps = 0.0;
  double length_m = 0.0;
  double front_m = 0.0;  // from its reference point to its front
  double heading_rad = kMissing;
  double width_m = kMissing;
};

// The nearest vehicle ahead and behind along the lanes.
struct Near {
  const OtherVehicle* vehicle = nullptr;
  double gap_m = 0.0;  // from bumper to bumper along the lane
};
// Without a vehicle: null.
struct NearBoth {
  Near ahead, behind;
};

// How far neighbours are looked for, along the lanes.
inline constexpr double kNeighbourReach_m = 250.0;

// Finds neighbours up to kNeighbourReach_m along the lanes. For one thread.
class LeaderFinder {
 public:
  // The graph outlives it.
  explicit LeaderFinder(const lanes::Graph& graph) : graph_(graph), finder_(graph) {}

  // Where the others are; for the next calls. Those beside the lanes are left out.
  void SetOthers(std::span<const OtherVehicle> others);
  // Along the track from a distance on. Where a track goes on into several, the one that the subject is on later (or
  // was on before) is followed: `later` and `earlier` are the tracks in that order; where none of them is among them,
  // the first.
  NearBoth Find(std::uint32_t track, double along_m, double front_m, double rear_m,
                std::span<const std::uint32_t> later, std::span<const std::uint32_t> earlier) const;

 private:
  struct Placed {
    const OtherVehicle* vehicle = nullptr;
    double along_m = 0.0;
  };
  const lanes::Graph& graph_;
  LaneFinder finder_;
  std::map<std::int64_t, network::Hint> hints_;  // by id: they only make the answer faster
  std::map<std::uint32_t, std::vector<Placed>> on_track_;
};

}  // namespace rodeira::measures
