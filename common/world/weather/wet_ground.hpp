// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/ground/ground.hpp"

namespace rodeira::weather {

// What is left of a dry surface's friction under a closed film of water, from 0 to 1 (docs/explanation/vehicle.md:
// chosen).
double FrictionLeft(ground::Surface surface);

// SUELO as a tyre feels it: SUELO's friction is the dry surface's (law L4); here it is
//   mu = mu_dry (1 - wetness (1 - FrictionLeft(surface))).
// All else is SUELO's answer, bit by bit; so is the friction where the wetness is 0.
class WetGround final : public ground::Ground {
 public:
  // The ground must outlive it.
  explicit WetGround(ground::Ground& dry) : dry_(dry) {}

  // From 0 (dry) to 1 (a closed film of water); it counts from the next query on.
  void set_wetness(double wetness) { wetness_ = wetness; }
  void Query(std::span<const ground::GroundQuery> queries, std::span<ground::GroundPoint> points) override;

 private:
  ground::Ground& dry_;
  double wetness_ = 0.0;  // 0 dry … 1
};

}  // namespace rodeira::weather
