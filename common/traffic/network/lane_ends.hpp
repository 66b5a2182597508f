// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "common/world/lanes/edge_marks.hpp"
#include "common/world/lanes/graph.hpp"

namespace rodeira::traffic {

// Where lanes end: while the lane beside goes on, as an acceleration lane without a taper, or by narrowing to nothing.
class LaneEnds {
 public:
  // Both must outlive the call alone.
  LaneEnds(const lanes::Graph& graph, const lanes::EdgeMarks& marks);

  // Whether a vehicle on this track must change to the lane beside: the track has no successor and the one beside has
  // one, or all that follows the track is such an end, on which no lane change is possible.
  bool IsBlunt(std::uint32_t track) const { return blunt_[track]; }
  // Distance along the track, in metres, up to which a lane change is possible; below 0 where none is.
  double ChangeEnds_m(std::uint32_t track) const { return change_ends_m_[track]; }
  // Distance along the track, in metres, from which a lane that leads nowhere is narrower than 2 m, up to its end or to
  // a place where its width is 0: a vehicle's way ends there. 0 where all of the track is; infinite where the
  // track does not end so. A blunt lane does not: its vehicles change before.
  double NarrowsFrom_m(std::uint32_t track) const { return narrows_from_m_[track]; }

 private:
  std::vector<bool> blunt_;  // by track
  std::vector<double> change_ends_m_;
  std::vector<double> narrows_from_m_;
};

}  // namespace rodeira::traffic
