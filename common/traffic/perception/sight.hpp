// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <boost/container/small_vector.hpp>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "common/driving/driver/speed_plan.hpp"
#include "common/driving/driver/way.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/world/lanes/curve.hpp"

namespace rodeira::traffic {

// What is where on the tracks, as agents see it in a step.

// A track on an agent's way, in its odometer, with what is asked of that track in each step: beside the agent it is in
// near memory.
struct RouteSegment {
  std::uint32_t track = 0;
  double zero_m = 0.0, begin_m = 0.0, end_m = 0.0;
  bool changes = false;      // goes over to the lane beside at its end
  bool goes_on = false;      // its track leads to others
  bool has_beside = false;   // there is another lane of its direction beside it
  bool has_lines = false;    // there are stop lines or lights on its track
  bool crosses = false;      // its track leads through conflict zones
  double limit_mps = -1.0;   // everywhere on the track; below 0: it has several
  double planned_mps = 0.0;  // that the track's plan allows where it begins here
};

// From the track under its rear bumper to as far as it looks: most look over no more than three, which lie in its own
// place in memory.
using RouteSegments = boost::container::small_vector<RouteSegment, 3>;

// Of the track below an agent's middle what is asked in each step, beside the agent in near memory: nothing that the
// map does not say.
struct CurrentTrackCache {
  std::uint32_t track = 0xFFFFFFFF;
  std::int32_t road = 0, lane = 0;
  bool goes_on = false;     // leads to other tracks
  bool has_beside = false;  // there is another lane of its direction beside it
  double length_m = 0.0;
  std::optional<lanes::Curve::Straight> straight;
  std::optional<Eigen::Quaterniond>
      turned;                    // how a car stands anywhere on a straight with a surface that does not twist …
  double grade = 0.0;            // … and climbs
  driver::SpeedPlan::Part plan;  // about that place
};

// Of what the stretches of a way were found from: as long as it is the same they are as well, but for how far they go.
struct WayKey {
  std::uint32_t trip = 0, links = 0, leg = 0, track = 0;
  std::size_t pieces = 0;
  double begin_m = 0.0, zero_m = 0.0;  // of the first piece; of the last one

  bool operator==(const WayKey&) const = default;
};

// Keys of the next choice of a way: links passed, and legs of the route.
struct Choice {
  std::uint32_t link = 0, leg = 0;
};

// A vehicle with all of its width farther than this from a lane's middle is not on that lane.
inline constexpr double kOnLaneOffset_m = 1.5;

// A vehicle that is no agent, on a track.
struct Block {
  driver::LaneSpan span;
  double middle_m = 0.0;
  std::uint32_t body = 0;  // its id
};

// An agent that overtakes, on the track of oncoming traffic, in its d: the front lies before the rear.
struct OncomingOvertaker {
  std::uint32_t id = 0;
  double front_m = 0.0, rear_m = 0.0;
};

// The next vehicle on a vehicle's way. gap_m: from its front to the leader's rear.
struct Leader {
  double gap_m = 1e9;
  double speed_mps = 0.0;
  std::int64_t id = -1;  // of an agent
  bool any = false;
  std::int64_t body = -1;  // of a vehicle that is no agent
  double length_m = 0.0;
  double left_m = 0.0, right_m = 0.0;  // how far it reaches to both sides of the lane's middle, both to the left
};

// The follower, on a track and up to a place on it.
struct Follower {
  double gap_m = 1e9;
  double speed_mps = 0.0;
  std::int64_t id = -1;  // of an agent
  std::uint32_t track = 0;
  double d_m = 0.0;  // of its front
  bool any = false;
};

// A change to the lane beside that could begin now, and the way then.
struct LaneChangeOption {
  Piece piece;
  int side = 0;
  double surplus_mps2 = 0.0;  // by which it is worth while
  RouteSegments stretches;
};

// The lane of oncoming traffic, as an overtaker sees it, in its odometer.
struct Oncoming {
  double from_m = 0.0;     // no oncoming vehicle is nearer than this …
  double speed_mps = 0.0;  // … nor faster
  bool own_way = false;    // a vehicle drives there that overtakes itself
};

}  // namespace rodeira::traffic
