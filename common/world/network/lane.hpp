// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/geometry/cubic.hpp"

namespace rodeira::network {

// What a lane is for. The names are OpenDRIVE's.
enum class LaneType : std::uint8_t {
  kNone,
  kDriving,
  kStop,
  kShoulder,
  kBiking,
  kSidewalk,
  kWalking,
  kBorder,
  kRestricted,
  kParking,
  kBidirectional,
  kMedian,
  kCurb,
  kEntry,
  kExit,
  kOnRamp,
  kOffRamp,
  kConnectingRamp,
  kSlipLane,
  kShared,
  kTram,
  kRail,
  kBus,
  kTaxi,
  kHov,
  kMwyEntry,
  kMwyExit,
  kRoadWorks,
  kSpecial1,
  kSpecial2,
  kSpecial3,
};

// The word of OpenDRIVE: "driving".
std::string_view LaneTypeName(LaneType type);
// Nothing where OpenDRIVE has no such type.
std::optional<LaneType> LaneTypeByName(std::string_view name);
// In the order of LaneType.
std::vector<std::string> LaneTypeNames();
// Made for motor vehicles in motion: driving, bidirectional, ramps, entries and exits, bus, taxi and shared lanes.
bool IsDrivable(LaneType type);

// All s are stations of the road.
struct LaneHeight {
  double s_m = 0.0;
  double inner_m = 0.0;  // over the road's surface, at the lane's inner edge and
  double outer_m = 0.0;  // at its outer one
};

// One painted line of a mark; t_offset positive to the left of the mark's middle.
struct MarkLine {
  double length_m = 0.0;  // of a stroke; a continuous line: 0
  double space_m = 0.0;   // of the gap behind it
  double t_offset_m = 0.0;
  double s_offset_m = 0.0;  // of the first stroke; of an explicit line: from the mark's beginning
  double width_m = 0.0;     // 0: the mark's
  std::string rule;
  std::string colour;
};

// The mark on a lane's outer edge (the centre lane's: between left and right), in force until the next one.
struct RoadMark {
  double s_m = 0.0;
  std::string type = "none";  // none, solid, broken, solid solid, …
  std::string weight, colour, material, lane_change;
  double width_m = 0.0;  // 0: not said
  double height_m = 0.0;
  std::vector<MarkLine> lines;           // repeated along the mark
  std::vector<MarkLine> explicit_lines;  // once each
  geometry::CubicTable sway;             // lateral offset over s
};

// A limit in force until the next one. Infinite: none.
struct SpeedLimit {
  double s_m = 0.0;
  double speed_mps = 0.0;
};

// The limit by signs from a station on until the next one; nothing: no sign is in force.
struct SignSpeed {
  double s_m = 0.0;
  std::optional<double> speed_mps;

  bool operator==(const SignSpeed&) const = default;
};

// What a lane's surface is from s_m on. Friction and roughness as OpenDRIVE's <material> has them; nothing: the
// surface's usual ones.
struct LaneMaterial {
  double s_m = 0.0;
  std::string surface;
  std::optional<double> friction;
  std::optional<double> roughness;
  std::string texture;                                   // a picture's file; empty: the surface's usual look
  double texture_width_m = 0.0, texture_height_m = 0.0;  // of the picture on the ground; it repeats
};

// Which road users may use a lane from s_m on, in OpenDRIVE's words ("passengerCar").
struct LaneAccess {
  double s_m = 0.0;
  std::string rule;  // "allow": these and no others; "deny": all but these
  std::vector<std::string> restrictions;
};

// A lane of a road, by names.
struct LaneName {
  std::string road;
  int lane = 0;

  bool operator==(const LaneName&) const = default;
};

// A lane of one lane section. Records with an s are ascending, each in force until the next one.
struct Lane {
  int id = 0;  // positive to the left of the centre, negative to its right, counted outward; 0: the centre itself
  LaneType type = LaneType::kNone;
  bool level = false;  // exempt from superelevation and cross-section
  // What a network's file says of its traffic: vehicles begin where the lane's traffic comes onto it, and are gone
  // where it leaves it. Where no lane of a network is one to begin on they come in at its edge.
  bool traffic_begins = false, traffic_ends = false;
  // Seen along s, the lane of another road that shares this side with it from end to end, as neighbours of a traffic
  // map do. It counts where that one says so too.
  std::optional<LaneName> left_beside, right_beside;
  int direction = 1;           // of traffic: +1 along s, -1 against it, 0 both
  geometry::CubicTable width;  // over s; empty where the lane has a border instead
  geometry::CubicTable
      border;  // t of the outer edge over s, wherever the centre lane lies; it counts where there is no width
  std::vector<LaneHeight> heights;
  std::vector<RoadMark> marks;
  std::vector<SpeedLimit> speeds;
  std::vector<SignSpeed> sign_speeds;  // ascending; the network sets them from its signs
  std::vector<LaneMaterial> materials;
  std::vector<LaneAccess> access;
  std::vector<int> predecessors;  // ids in the section before, or in the road's predecessor
  std::vector<int> successors;

  bool bordered() const { return width.empty() && !border.empty(); }
};

// Whether cars may drive on a lane from its beginning to its end. Rules that name neither "passengerCar" nor
// "autonomousTraffic" are for others; one that allows only others closes it. A rule that says neither "allow" nor
// "deny" is passed over.
bool OpenToCars(const Lane& lane);

// A lane at one s: its edges as t, positive to the left, and how they move with s.
struct LaneSpan {
  const Lane* lane = nullptr;
  double inner_t_m = 0.0, outer_t_m = 0.0;
  double inner_slope = 0.0, outer_slope = 0.0;  // dt/ds

  double centre_t_m() const { return 0.5 * (inner_t_m + outer_t_m); }
  double width_m() const { return outer_t_m > inner_t_m ? outer_t_m - inner_t_m : inner_t_m - outer_t_m; }
};

// The lanes between two stations of a road.
struct LaneSection {
  double s_m = 0.0;
  double end_s_m = 0.0;
  bool single_side = false;
  Lane centre;
  std::vector<Lane> left;   // ids 1, 2 …
  std::vector<Lane> right;  // ids -1, -2 …

  const Lane* Find(int id) const;  // null where there is none; 0 is the centre
  // The lane's edges at s, where the centre of the lanes lies at `centre_t`. Nothing for the centre and unknown lanes.
  std::optional<LaneSpan> Span(int id, const geometry::CubicPoint& centre_t, double at_s_m) const;
  // The lane that holds t; beyond all of them the outermost one on that side (none where the side has no lane). On an
  // edge between two lanes: the inner one. outside_m: how far t lies beyond the lanes.
  LaneSpan At(double t_m, const geometry::CubicPoint& centre_t, double at_s_m, double& outside_m) const;
  // The smallest and the largest t of the lanes' edges in [low, high], by the sum of each part's extremes.
  void Bounds(const geometry::CubicTable& centre_t, double low_s_m, double high_s_m, double& right_t_m,
              double& left_t_m) const;
};

}  // namespace rodeira::network
