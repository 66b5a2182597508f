// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <span>

#include "common/core/ground/ground.hpp"

namespace rodeira::manoeuvres {

// Asphalt without end for manoeuvres, in the plane y to the left of a car that goes along x.
struct ProvingGroundSettings {
  double slope = 0.0;           // dz/dx
  double friction_left = 1.0;   // where y > 0
  double friction_right = 1.0;  // elsewhere
  // A bump right across, of the shape height/2 (1 - cos(2 pi (x - at) / length)).
  double bump_height_m = 0.0;
  double bump_length_m = 1.0;
  double bump_at_m = std::numeric_limits<double>::infinity();
};

// SUELO of an endless plane.
class ProvingGround final : public ground::Ground {
 public:
  explicit ProvingGround(const ProvingGroundSettings& settings) : settings_(settings) {}
  void Query(std::span<const ground::GroundQuery> queries, std::span<ground::GroundPoint> points) override;

 private:
  ProvingGroundSettings settings_;
};

}  // namespace rodeira::manoeuvres
