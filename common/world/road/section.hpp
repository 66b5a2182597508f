// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/core/ground/ground.hpp"

namespace rodeira::road {

// A lane of constant width. The id's sign is OpenDRIVE's: negative to the right of the axis as seen along s, positive
// to the left, counted from the axis outward (-1, -2 … and 1, 2 …).
struct Lane {
  int id = 0;
  int direction = 1;  // of traffic: +1 along s, -1 against it
  double width_m = 0.0;
  double speed_limit_mps = 0.0;
  double inner_t_m = 0.0;  // the edge nearer to the axis
  double outer_t_m = 0.0;

  double centre_t_m() const { return 0.5 * (inner_t_m + outer_t_m); }
};

// A strip of the cross-section between two t: height over the axis is from_z_m + slope (t - from_t_m).
struct Band {
  double from_t_m = 0.0;
  double to_t_m = 0.0;
  double from_z_m = 0.0;
  double slope = 0.0;  // dz/dt, positive: rising to the left
  ground::Surface surface = ground::Surface::kAsphalt;
};

// The strip beside the lanes on one side.
struct Shoulder {
  double width_m = 0.0;
  double fall = 0.0;  // positive: falling outward
  ground::Surface surface = ground::Surface::kAsphalt;
};

// The strip between the shoulder (or the lanes) and the terrain, the same on both sides.
struct Verge {
  double width_m = 0.0;
  double fall = 0.0;  // positive: falling outward
  ground::Surface surface = ground::Surface::kGrass;
};

// What an author says of a cross-section.
struct SectionSpec {
  std::vector<Lane> lanes;    // id, direction, width, speed limit; the edges are found by Section
  double fall_left = 0.025;   // crossfall of the lanes left of the axis, positive: falling to the left
  double fall_right = 0.025;  // and right of it, positive: falling to the right. One-sided: of opposite signs
  ground::Surface surface = ground::Surface::kAsphalt;
  Shoulder left, right;
  Verge verge;
  double blend_m = 10.0;  // > 0: over this width beyond the verge the ground passes into the terrain
};

// The cross-section of a road, the same along the whole of it: strips from the right verge to the left one.
class Section {
 public:
  explicit Section(SectionSpec spec);  // at least one lane; ids as Lane says, without gaps

  std::span<const Lane> lanes() const { return spec_.lanes; }  // from the rightmost to the leftmost
  const Lane* FindLane(int id) const;                          // null where there is none
  std::span<const Band> bands() const { return bands_; }       // from right to left, without gaps
  const SectionSpec& spec() const { return spec_; }

  // Edges, as t: of the lanes, of the shoulders, of the verges, of the blend. Right ones are negative.
  double lanes_left_m() const { return lanes_left_m_; }
  double lanes_right_m() const { return lanes_right_m_; }
  double paved_left_m() const { return lanes_left_m_ + spec_.left.width_m; }
  double paved_right_m() const { return lanes_right_m_ - spec_.right.width_m; }
  double verge_left_m() const { return paved_left_m() + spec_.verge.width_m; }
  double verge_right_m() const { return paved_right_m() - spec_.verge.width_m; }
  double blend_left_m() const { return verge_left_m() + spec_.blend_m; }
  double blend_right_m() const { return verge_right_m() - spec_.blend_m; }
  double reach_m() const;  // the farther of the two blends' outer edges

  // The band at t; beyond the verges the outermost one; its slope goes on.
  const Band& BandAt(double t_m) const;

 private:
  SectionSpec spec_;
  std::vector<Band> bands_;
  double lanes_left_m_ = 0.0;
  double lanes_right_m_ = 0.0;
};

}  // namespace rodeira::road
