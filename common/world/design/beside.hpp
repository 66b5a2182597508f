// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/core/config/declared.hpp"
#include "common/core/geometry/cubic.hpp"
#include "common/world/network/road.hpp"

namespace rodeira::design {

// Across a road: a t of its own ('t_m'), or beyond the outermost edge on a side ('side', 'beside_m').
class Beside {
 public:
  Beside(const config::DeclaredMap& item, const network::RoadSpec& spec, double usual_m, bool right_side);

  // t at s, positive to the left.
  double At(double s_m) const { return along_.Value(s_m) + beside_m_; }
  // Where the edge's course changes.
  std::vector<double> Knots() const;

 private:
  geometry::CubicTable along_;
  double beside_m_ = 0.0;
};

// Straight pieces, first and last point, that pass none of the points farther than `within_m` beside it. A chain has
// each end for its next beginning, otherwise the next piece begins at the next point. s ascends.
std::vector<std::pair<std::size_t, std::size_t>> StraightPieces(const std::vector<double>& s_m,
                                                                const std::vector<double>& t_m, double within_m,
                                                                bool chain);

// The lane that is driven on at (s, t) of a road that is not built yet; null where there is none within `reach_m`.
const network::Lane* DrivenLaneAt(const network::RoadSpec& spec, double s_m, double t_m, double reach_m = 0.0);

}  // namespace rodeira::design
