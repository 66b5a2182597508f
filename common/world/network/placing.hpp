// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string_view>
#include <vector>

#include "common/world/network/network.hpp"
#include "common/world/network/props.hpp"

// Where what stands at the roads stands.
namespace rodeira::network {

// A signal or an object at its place; of a repeated object one of them.
struct Placed {
  std::uint32_t road = 0;
  const Signal* signal = nullptr;  // one of these two is not null; both live as long as what they are from
  const Object* object = nullptr;
  double s_m = 0.0, t_m = 0.0, z_offset_m = 0.0;  // of a sign on a board: of the board's foot, and of the sign over it
  Eigen::Vector3d foot_W = Eigen::Vector3d::Zero();  // on the road's surface at (s, t), without the offset
  // Of its x axis, from east to north; it stands upright. An object's x axis points along the road, turned by its own
  // heading; a signal's is where its face looks: against the traffic that it is for (for both: against s), turned by
  // its own offset.
  double heading_rad = 0.0;
  bool both_sides = false;  // of a signal: it has a second face, which looks the other way
  double length_m = 0.0, width_m = 0.0, height_m = 0.0, radius_m = 0.0;
  std::optional<double> z_W_m;  // of a signal that is seen at a place in the world: its height, whatever the ground is;
                                // its foot's z is then the road's where it counts
};

// An object that goes on along a road: all but s are linear in s.
struct PlacedRun {
  std::uint32_t road = 0;
  const Object* object = nullptr;
  double from_s_m = 0.0, to_s_m = 0.0;
  double t_start_m = 0.0, t_end_m = 0.0;
  double z_start_m = 0.0, z_end_m = 0.0;  // over the road's surface
  double height_start_m = 0.0, height_end_m = 0.0;
  double width_start_m = 0.0, width_end_m = 0.0;
  bool straight = false;  // its ends are joined by a straight line, seen from above; t is theirs alone

  // A point of it on the road's surface (of a straight one: between the heights there of its ends), share 0 at its
  // beginning, 1 at its end; and what lies to its left there.
  struct Point {
    Eigen::Vector3d p_W;
    Eigen::Vector2d left_W;
  };
  Point At(const Road& on, double share) const;
  // The longest a piece of it may be, at most `longest_m`, so that its chord stays within `chord_m` of it.
  double Step(const Road& on, double longest_m, double chord_m) const;
};

// All that stands at a network's roads.
struct Furniture {
  std::vector<Placed> things;
  std::vector<PlacedRun> runs;
};

// Everything that stands at a network's roads, by road, then signals and objects as they were written. An object that
// is repeated every d metres over a length L stands at floor(L / d) + 1 stations as its repeats say, and not at its
// own; stations beyond the road's end are left out, and what is said once for a road that ends before counts to its
// end. A straight repeat stands evenly along its chord, heading along it, its s and t those of the road under it. A
// signal that is seen elsewhere than where it counts stands there, with that road; where there is no such road, at its
// own place.
Furniture PlaceFurniture(const Network& network);

// What stands at no road, on the ground that is given; of a road there are only zeros.
Placed PlaceProp(const Props& props, const Props::Placement& thing, const Eigen::Vector3d& foot_W);

// Whether something beside the road is for the traffic of a lane of it, by its orientation ("+", "-", "none") and
// lanes. along: the lane's traffic goes with growing s.
bool HoldsFor(int lane, bool along, std::string_view orientation, const std::vector<LaneValidity>& validity);

// A signal for a lane, at its place along the lane's road; it may stand at another road.
struct SignalOnLane {
  double s_m = 0.0;
  const Signal* signal = nullptr;  // lives as long as the network
};
// All signals for the traffic of a lane within its section, ascending in s; of a lane of both directions those for
// either. A reference to a signal that the network has nowhere is passed over.
std::vector<SignalOnLane> SignalsFor(const Network& network, const LaneKey& lane);

}  // namespace rodeira::network
