// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/core/geometry/plan_axis.hpp"
#include "common/world/network/earthwork.hpp"
#include "common/world/network/furniture.hpp"
#include "common/world/network/lane.hpp"
#include "common/world/network/lateral.hpp"
#include "common/world/network/lean.hpp"
#include "common/world/network/line.hpp"

namespace rodeira::network {

class JunctionGround;

enum class End : std::uint8_t { kStart, kEnd };

// What a road goes on into at one of its ends.
struct RoadLink {
  bool junction = false;
  std::string id;             // of the road or junction
  End contact = End::kStart;  // the other road's end that is met
  // Where the other road is met in its middle, as by an entry to a yard: the station, at which one of its lane sections
  // begins. `contact` is then the end that is met of a lane section there: of the one that begins there its start, of
  // the one before it its end.
  std::optional<double> s_m = std::nullopt;
};

// The road's kind ("town", "motorway") and limit from a station on, until the next one.
struct RoadType {
  double s_m = 0.0;
  std::string type, country;
  std::optional<double> speed_mps;  // infinite: no limit
};

// A road as a file says it. Stations s along the reference line, t positive to its left; tables are over s.
struct RoadSpec {
  std::string id, name;
  std::string junction;  // the junction that a connecting road belongs to; empty: none
  bool left_hand = false;
  double length_m = 0.0;
  std::optional<RoadLink> predecessor, successor;
  std::vector<RoadType> types;
  geometry::CubicTable elevation;       // z over s
  geometry::CubicTable superelevation;  // angle over s; positive: the left side is higher
  LateralProfile lateral;
  geometry::CubicTable lane_offset;
  std::vector<LaneSection> sections;  // ascending; at least one
  std::vector<Signal> signals;
  std::vector<SignalReference> signal_references;
  std::vector<Object> objects;
  std::vector<ObjectReference> object_references;
  std::vector<Structure> structures;
  std::vector<CrgSurface> crg;
  std::shared_ptr<const JunctionGround>
      ground;  // its junction's, which takes the place of elevation, superelevation and lateral profile
  // OpenDRIVE has none of these.
  std::vector<PaintedLine> lines;
  std::vector<Unevenness> unevenness;
  std::optional<Earthwork> earthwork;  // none: the verge goes on level
};

// The lane section of the other road at the end that a link meets. It has at least one.
std::uint32_t SectionMet(const RoadLink& link, const RoadSpec& other);

// A point of the road's surface and how it moves with s and with t: the upward normal is their cross product.
struct SurfaceSample {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d ds_W = Eigen::Vector3d::UnitX();
  Eigen::Vector3d dt_W = Eigen::Vector3d::UnitY();
};

// A road: its reference line and everything along it. Immutable. s runs along the line, t to its left, metres.
// The surface is  c(s) + t e(s) + h(s, t) z:  c the reference line with its height, e its left, turned by the
// superelevation about the (climbing) line, h the rest of the lateral profile and of the lanes' heights, counted
// vertically. A level lane goes on horizontally from its inner edge.
class Road {
 public:
  Road(RoadSpec spec, geometry::PlanAxis axis);

  const RoadSpec& spec() const { return spec_; }
  const std::string& id() const { return spec_.id; }
  const geometry::PlanAxis& axis() const { return axis_; }
  // The smaller of what the file says and what its elements have.
  double length_m() const { return length_m_; }
  // Superelevated somewhere.
  bool rolled() const { return rolled_; }
  // Superelevated there: then (x, y) of a point does not follow from the plan alone.
  bool Leans(double s_m) const { return rolled_ && !IsZero(spec_.superelevation.At(s_m)); }
  // Superelevated somewhere from one station to another.
  bool LeansBetween(double low_s_m, double high_s_m) const;
  // A lateral profile, a lane's height, a level lane or a junction's ground: the lane at t counts for the surface.
  bool shaped() const { return shaped_; }
  // Across it is level everywhere: the elevation is all of its height.
  bool flat() const { return !rolled_ && !shaped_; }

  // The lane section in force at s, as an index into RoadSpec::sections; beyond the road's ends the outermost one.
  std::size_t SectionIndex(double s_m) const;
  // That section itself.
  const LaneSection& SectionAt(double s_m) const { return spec_.sections[SectionIndex(s_m)]; }
  // t of the lanes' centre at s (the lane offset), and its slope over s.
  geometry::CubicPoint CentreAt(double s_m) const { return spec_.lane_offset.Evaluate(s_m); }
  // s held within a section. Its end is the last s before the next one begins; its lanes may lie elsewhere.
  double Held(std::size_t section, double s_m) const;
  // A lane at s, which is held within its section. Nothing for the centre and unknown lanes.
  std::optional<LaneSpan> SpanAt(std::size_t section, int lane, double s_m) const;

  // The surface at (s, t) in W; s within the road, t beyond the lanes too.
  SurfaceSample Surface(double s_m, double t_m) const;
  // The same where the lane at (s, t) is known, and the reference line there.
  SurfaceSample Surface(double s_m, double t_m, const LaneSection& section, const LaneSpan& span) const {
    return Surface(axis_.Evaluate(s_m), s_m, t_m, section, span);
  }
  // The same where the reference line's point at s, `at`, is known too.
  SurfaceSample Surface(const geometry::PlanPoint& at, double s_m, double t_m, const LaneSection& section,
                        const LaneSpan& span) const;
  // On a rolled road: moves (s, t), found in plan, to where the surface stands over (x, y), with s held in [low, high].
  // Returns how far that is from (x, y): 0 but where s is held. FootOnLean does the same sooner where it can.
  double Settle(const Eigen::Vector2d& p_W, double low_s_m, double high_s_m, double& s_m, double& t_m) const;
  // Where a leaning section that no lane is exempt from stands over a point that lies alongside the panel; its foot
  // in plan is known: the same place as Settle's, but for rounding. Nothing where that is not within [low, high], or
  // too far from the foot to be told so quickly.
  struct LeanFoot {
    double s_m, t_m;
    geometry::PlanPoint at;  // without its heading
  };
  std::optional<LeanFoot> FootOnLean(const geometry::AxisPanel& panel, const geometry::AxisFoot& foot, double low_s_m,
                                     double high_s_m) const;
  // The distance, seen from above, from (x, y) to the line of constant t; s moves to the nearest point.
  double DistanceToEdge(const Eigen::Vector2d& p_W, double low_s_m, double high_s_m, double t_m, double& s_m) const;
  // In force at s on a lane: the lane's own limit, otherwise that of the road's type. Infinite: none; nothing where
  // neither says one.
  std::optional<double> SaidSpeedLimitAt(const Lane& lane, double s_m) const;
  // The same, and where nothing is said the limit by signs (Lane::sign_speeds). The one answer for all that drive,
  // measure and draw.
  std::optional<double> SpeedLimitAt(const Lane& lane, double s_m) const;
  // The mark on a lane's outer edge, and what the lane is made of, in force at s; null where nothing is said.
  const RoadMark* MarkAt(const Lane& lane, double s_m) const;
  // The material record in force at s.
  const LaneMaterial* MaterialAt(const Lane& lane, double s_m) const;

 private:
  friend class Network;  // sets Lane::sign_speeds
  SurfaceSample OnGround(const geometry::PlanPoint& at, double s_m, double t_m, const LaneSpan& span) const;
  LateralPoint LaneHeightAt(const LaneSpan& span, double s_m, double t_m) const;
  Lean LeanAt(double s_m) const;  // superelevation has records

  RoadSpec spec_;
  geometry::PlanAxis axis_;
  double length_m_;
  bool rolled_;
  bool shaped_;
};

}  // namespace rodeira::network
