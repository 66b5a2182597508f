// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

// What stands at a road: signals, objects, tunnels and bridges, as OpenDRIVE describes them.
namespace rodeira::network {

// The lanes that something is for; without any it is for all.
struct LaneValidity {
  int from_lane = 0;
  int to_lane = 0;
};

// Where a signal is seen, if that is not where it counts: at another place of this or of another road, or anywhere.
struct SeenAtRoad {
  std::string road;
  double s_m = 0.0, t_m = 0.0, z_offset_m = 0.0;
  double h_offset_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0;
};
// A place in W (x east, y north, z up).
struct SeenInWorld {
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;
  double heading_rad = 0.0, pitch_rad = 0.0,
         roll_rad = 0.0;  // the heading of the traffic that reads it, as offsets of headings are
};

// The type of a light for pedestrians alone (German catalogue).
inline constexpr std::string_view kPedestrianSignal = "1000002";

// An OpenDRIVE <signal>: a sign or a light. s, t and z offset in the road's frame, t positive to the left; value in
// `unit`.
struct Signal {
  std::string id, name;
  double s_m = 0.0, t_m = 0.0, z_offset_m = 0.0;
  std::string orientation;  // "+": for traffic along s, "-": against it, "none": both
  bool dynamic = false;
  std::string country, type, subtype, unit, text;
  std::optional<double> value;
  double height_m = 0.0, width_m = 0.0;
  double h_offset_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0;
  std::vector<LaneValidity> validity;
  std::vector<std::string> depends_on;  // ids of signals
  std::string priority;  // what it means for the priority, whatever its country calls it: stop, yield, priorityRoad
                         // …; empty: not said
  std::variant<std::monostate, SeenAtRoad, SeenInWorld> seen;
  // Of a sign or a display on a board: the board's signal. Its own place is the board's, and the middle of its lower
  // edge lies so far to the left of the board's, as its reader sees it, and over the board's lower edge.
  std::string board;
  double board_left_m = 0.0, board_up_m = 0.0;
};

// Boards hold signs and displays: a signal of one of these types is no sign itself.
inline constexpr std::string_view kStaticBoard = "staticBoard", kDisplay = "vmsBoard", kMixedBoard = "multiBoard";
// By its type alone; the country does not count.
inline bool IsBoard(const Signal& signal) {
  return signal.type == kStaticBoard || signal.type == kDisplay || signal.type == kMixedBoard;
}

// A signal that stands at another road and is for this one.
struct SignalReference {
  double s_m = 0.0, t_m = 0.0;
  std::string id, orientation;
  std::vector<LaneValidity> validity;
};

// A corner of an outline, in the road's coordinates or in the object's.
struct Corner {
  bool local = false;
  double first_m = 0.0;   // s, or u
  double second_m = 0.0;  // t, or v
  double dz_m = 0.0;      // over the road, or z in the object
  double height_m = 0.0;
  std::string id;  // in its outline; may be empty
};

// Corners of an object's shape in order; closed: the last is joined to the first.
struct Outline {
  std::string id;
  bool closed = true;
  std::string fill;  // what lies within: grass, concrete, cobble, asphalt, pavement, gravel or soil; empty: not said
  std::vector<Corner> corners;
};

// An object said once for a stretch: every distance_m, or continuous where that is 0.
struct Repeat {
  double s_m = 0.0, length_m = 0.0, distance_m = 0.0;
  double t_start_m = 0.0, t_end_m = 0.0;
  double z_start_m = 0.0, z_end_m = 0.0;
  double height_start_m = 0.0, height_end_m = 0.0;
  double width_start_m = 0.0, width_end_m = 0.0;
  double length_start_m = 0.0, length_end_m = 0.0;
  double radius_start_m = 0.0, radius_end_m = 0.0;
  bool straight = false;  // from its beginning to its end, seen from above, whichever way the road bends
};

// A frame within an outline's edge, or along some of its corners: a kerb or a strip of concrete.
struct ObjectBorder {
  std::size_t outline = 0;           // of the object's
  std::vector<std::string> corners;  // their ids, in order; none: all of the outline
  double width_m = 0.0;
  std::string type;  // "concrete", "curb"
};

// A point of a skeleton: round with a radius, otherwise a rectangle across the line.
struct SkeletonPoint {
  bool local = false;  // as of Corner
  double first_m = 0.0, second_m = 0.0, dz_m = 0.0;
  double radius_m = 0.0;
  double width_m = 0.0, length_m = 0.0;
};
using SkeletonLine = std::vector<SkeletonPoint>;  // straight from each point to the next; at least two

// What the upper side of an object is made of; friction nothing: not said.
struct ObjectMaterial {
  std::string surface;  // as of LaneMaterial
  std::optional<double> friction;
  std::string colour;  // of its paint; empty: not said
};

// A line of paint along a side of an object, or from corner to corner of its outline.
struct ObjectMark {
  std::string side;  // "left", "right", "front" (where its x axis points) or "rear"; nothing where corners are named
  std::vector<std::string> corners;  // their ids, in order
  std::string colour = "white";
  double width_m = 0.0;
  double stroke_m = 0.0, gap_m = 0.0;                // without gaps: one stroke
  double start_offset_m = 0.0, stop_offset_m = 0.0;  // from the line's beginning and end, which stay without paint
};

// An OpenDRIVE <object>. s, t and z offset in the road's frame, angles about the road's direction, t positive to the
// left. A radius makes it round; otherwise length lies along its x axis.
struct Object {
  std::string id, name, type, subtype, orientation;
  double s_m = 0.0, t_m = 0.0, z_offset_m = 0.0;
  double hdg_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0;
  double length_m = 0.0, width_m = 0.0, height_m = 0.0, radius_m = 0.0;
  double valid_length_m = 0.0;
  bool dynamic = false;
  std::vector<Repeat> repeats;
  std::vector<Outline> outlines;
  std::vector<LaneValidity> validity;
  std::vector<ObjectMark> marks;
  std::vector<ObjectBorder> borders;
  std::vector<SkeletonLine> skeleton;
  ObjectMaterial material;
  std::string access;  // the users of a parking place: all, car, women, handicapped, bus, truck, electric,
                       // residents; empty: not said
};

// It is part of the ground, however high a file says that it is: crossings, parking places, paint, patches.
bool IsFlat(const Object& object);
// A piece of the road that is made of something else.
bool IsPatch(const Object& object);

// An object that stands at another road and is for this one.
struct ObjectReference {
  double s_m = 0.0, t_m = 0.0;
  std::string id, orientation;
};

// A tunnel or a bridge.
struct Structure {
  std::string id, name, type;
  bool bridge = false;
  double s_m = 0.0, length_m = 0.0;
};

// An OpenCRG surface laid on the road.
struct CrgSurface {
  std::string file, orientation, mode, purpose;
  double s_start_m = 0.0, s_end_m = 0.0;
  double s_offset_m = 0.0, t_offset_m = 0.0, z_offset_m = 0.0, z_scale = 1.0, h_offset_rad = 0.0;
};

// Made roughness (ISO 8608) between two stations, from edge to edge of the lanes that are paved.
struct Unevenness {
  double s_start_m = 0.0, s_end_m = 0.0;
  double s_offset_m = 0.0;  // of the made surface: its s is the road's and this
  double density_m3 = 0.0;  // at 0.1 cycles a metre
  std::uint64_t seed = 0;
};

}  // namespace rodeira::network
