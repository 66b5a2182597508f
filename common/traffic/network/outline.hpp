// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "common/traffic/state/agent.hpp"
#include "common/world/lanes/swath.hpp"
#include "common/world/lanes/zones.hpp"

namespace rodeira::traffic {

// How far to either side of the lines of its tracks a car of this size reaches, of all places at which it was noted.
class Outline {
 public:
  Outline(const lanes::Graph& graph, const lanes::LargestCar& car);

  // The car with its middle here, `ahead` its heading; `o_m` is the odometer beside its middle. Of its sides `points` +
  // 1 points each are noted, from its rear to its front.
  void Note(const Path& path, const Eigen::Vector2d& middle_W, const Eigen::Vector2d& ahead_W, double o_m, int points);
  // The odometer beside a point, one turn nearer than `near_m`.
  double FootOf(const Path& path, const Eigen::Vector2d& p_W, double near_m) const;

  // What is no more than a margin beyond HalfSwath_m of a node's curvature is none.
  void DropWhatCurvaturesSay(double margin_m);
  lanes::Swings Take() { return std::move(swings_); }

 private:
  void Note(std::uint32_t track, double d_m, double offset_m);

  const lanes::Graph& graph_;
  lanes::LargestCar car_;
  lanes::Swings swings_;
};

}  // namespace rodeira::traffic
