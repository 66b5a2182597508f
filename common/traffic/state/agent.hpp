// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <boost/container/small_vector.hpp>
#include <cstdint>
#include <memory>

#include "common/core/base/assert.hpp"
#include "common/core/base/state.hpp"
#include "common/driving/driver/footprint.hpp"
#include "common/traffic/motion/crashed.hpp"
#include "common/traffic/motion/drivetrain.hpp"
#include "common/traffic/overtaking/overtaking.hpp"
#include "common/traffic/state/traffic_settings.hpp"
#include "common/world/lanes/graph.hpp"

namespace rodeira::traffic {

struct RequestedRoute;

// One agent as others see it. B as for vehicles: midway between the axles, at the road's height; x forward, y left.
struct AgentPose {
  std::uint32_t id = 0;
  std::uint32_t trip = 0;  // how often it has entered the road; another trip is another appearance
  Eigen::Vector3d p_WB_W = Eigen::Vector3d::Zero();
  Eigen::Quaterniond q_WB = Eigen::Quaterniond::Identity();
  double speed_mps = 0.0;
  double acceleration_mps2 = 0.0;
  double steer_rad = 0.0;       // of the front wheels, positive to the left
  double wheel_spin_rad = 0.0;  // in (-pi, pi]
  bool braking = false;         // its brake lights
  std::int32_t road = 0;        // index into the network's roads
  std::int32_t lane = 0;        // id within that road
};

// The rectangle of an agent.
driver::Footprint FootprintOf(const AgentPose& pose, const AgentTraits& traits);

// How a car stands with axles on a straight line.
Eigen::Quaterniond AttitudeOn(const lanes::Curve::Straight& straight);
// Rise over plan distance of its length.
double GradeOf(const Eigen::Quaterniond& q_WB);

// A part of the path of one agent, by the agent's odometer: the middle of a track, which it approaches from where it
// came over blend_m from blend_from_m on, offset and slope going to 0 with the smooth polynomials of degree five. One
// that overtakes drives beside that middle, by aside_m, and the offset is from there.
struct Piece {
  std::uint32_t track = 0;
  double zero_m = 0.0;    // odometer where the track's d is 0
  double begin_m = 0.0;   // odometer from which the piece holds
  double offset_m = 0.0;  // at blend_from_m, to the left of the track's middle
  double slope = 0.0;     // of the path against the track there
  double blend_m = 1.0;
  double blend_from_m = 0.0;  // odometer; at begin_m or, where a change of lanes goes on from the track before, earlier
  double aside_m = 0.0;       // to the left
};

// Most are on one piece or two, which lie in the agent itself.
using Path = boost::container::small_vector<Piece, 2>;

// A change to the lane beside, in the odometer.
struct LaneChange {
  int side = 0;         // +1: to the left, -1: to the right, 0: none
  double from_m = 0.0;  // where its path leaves the old lane's middle …
  double to_m = 0.0;    // … and is on the new one's
};

// Conflict zones that an agent was granted together.
struct ZoneGrant {
  double to_m = 0.0;         // odometer at their end
  std::uint64_t number = 0;  // of two that hold a zone the lower one goes first
  bool sure = false;         // there is room behind the zones, so that nothing keeps the agent in them
  double light_m = -1.0;     // odometer of the line of a light before them; below 0: none
  double clear_m = 0.0;      // odometer at the end of the one that ends last, where that is beyond `to_m`
  std::int64_t light = -1;   // controller of the light past which the vehicle waits for oncoming traffic; below 0: none
};

// What changes about one agent. First, in one line of memory, what others ask of it.
struct alignas(64) Agent {
  static constexpr double kNoCap_mps = 1e3;

  bool on_road = false;        // drives
  bool is_crashed = false;     // has been hit, and drives no more
  bool seeks = false;          // drives slower to find a gap beside, for its route
  bool told_past = false;      // told to overtake its leader, and has not begun yet
  std::int32_t told_side = 0;  // told to go over to the lane on that side, +1 left, -1 right, and has not yet; 0: not
  double o_m = 0.0;            // odometer of its middle on this trip
  double speed_mps = 0.0;
  double acceleration_mps2 = 0.0;
  double desired_mps2 = 0.0;  // the acceleration from which its driver goes on
  double granted_m = 0.0;     // odometer to which the conflict zones on its way are its own
  double waited_s = 0.0;      // at rest for others to go first
  double brake_mps2 = 0.0;    // commanded; 0: not
  Path path;                  // from the piece under its rear bumper to that under its front bumper
  boost::container::small_vector<ZoneGrant, 1> grants;  // those that its rear has not left yet, as it meets them
  std::uint32_t entry = 0;                              // the track where it waits to enter
  std::uint32_t trip = 0;
  std::int32_t flow = -1;                           // to which it belongs; below 0: none
  std::uint32_t arrival = 0;                        // its number in the flow
  std::uint32_t links = 0;                          // passed on this trip: keys of the draws at branches
  std::uint32_t leg = 0;                            // how many roads of its route it has reached, at its front
  std::shared_ptr<const RequestedRoute> requested;  // null: its route is its flow's, if that has one
  double driven_m = 0.0;
  double fuel_mg = 0.0;    // burnt on this trip
  double fuel_mgps = 0.0;  // in the last step
  double grade = 0.0;      // that it stands on, rise over plan distance; found with its pose
  Driving driving;         // what its driver and its engine did in the last step
  double cap_mps = kNoCap_mps;
  double stopped_m = -1.0;      // odometer of the STOP line at which it has come to rest
  std::int64_t settled_ns = 0;  // until then it keeps to its lane
  std::int64_t eased_for =
      -1;  // the one that has come in before it and is still followed nearer than it likes; below 0: none
  LaneChange change;
  Overtaking overtaking;
  Crashed crashed;
  double crashed_z_m = 0.0;  // its height, where no lane is below it

  // That of a zone that begins there; nothing for zones that it came into without any.
  ZoneGrant GrantOf(double in_m) const {
    for (const ZoneGrant& grant : grants) {
      if (in_m < grant.to_m) return grant;
    }
    return {};
  }
  // It may stand in the zones that it was granted last, past their light, to wait for oncoming traffic.
  bool waits_inside() const { return !grants.empty() && grants.back().light >= 0; }

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);
};

// The path at an odometer.
struct PathFrame {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
  Eigen::Vector2d ahead_W = Eigen::Vector2d::UnitX();
  double curvature_1pm = 0.0;
  double bank = 0.0;
  double stretch = 1.0;   // distance driven over that of the odometer
  double offset_m = 0.0;  // from the track's middle, and its slope
  double slope = 0.0;
};
// Precondition: the path is not empty. Before its first piece that one is drawn on.
PathFrame FrameAt(const lanes::Graph& graph, const Path& path, double odometer_m);
// The piece on which an odometer lies, and the path there by the point of that piece's track.
inline const Piece& PieceAt(const Path& path, double odometer_m) {
  RODEIRA_ASSERT(!path.empty());
  std::size_t i = path.size() - 1;
  while (i > 0 && path[i].begin_m > odometer_m) --i;
  return path[i];
}
// `at`: the curve's point at the odometer's place on the piece's track.
PathFrame FrameOn(const Piece& piece, const lanes::CurvePoint& at, double odometer_m);

// The piece that begins at the end of the path's last one and goes on by a link, joining the new middle comfortably.
Piece Onward(const lanes::Graph& graph, const Path& path, const lanes::Link& link, double speed_mps);

}  // namespace rodeira::traffic
