// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <utility>

#include "common/core/geometry/plan_axis.hpp"
#include "common/world/network/road.hpp"

// The edges of a road's outermost lanes, from which the ground beside it goes on.
namespace rodeira::road {

// What is added to a distance so that nothing beyond a reach counts: nothing over its first four fifths, then ever
// more, without bound at its end; and how that changes with the distance.
std::pair<double, double> Steepening(double distance_m, double reach_m);

// How far a panel's edges lie from the way between its ends at most, and how far from the line through both to either
// side of it.
struct EdgesAside {
  double beside_m, right_m, left_m;
};
// Never less than the true distances; more where the road leans.
EdgesAside EdgesBeside(const network::Road& road, const geometry::AxisPanel& panel);

// Added to distances and heights that are found from samples, for what lies between the samples.
inline constexpr double kSampleMargin_m = 1e-3;

// The lowest and the highest that a road's edges are between two stations, and some room for what lies between the
// samples.
struct EdgeHeights {
  double low_m, high_m;
};
EdgeHeights HeightsOfEdges(const network::Road& road, double from_s_m, double to_s_m);

// A part of a road.
struct Stretch {
  double from_s_m = 0.0, to_s_m = 0.0;
};

// The outermost edges of a stretch along which no lane's edge moves: what LaneSection::At says beyond them, to the bit,
// without asking lane by lane.
struct SteadyEdges {
  const network::LaneSection* section = nullptr;  // null: some edge moves
  network::LaneSpan right, left;                  // of the outermost lanes
  double centre_t_m = 0.0, right_t_m = 0.0, left_t_m = 0.0;

  // Nothing within the edges. outside_m: as LaneSection::At's.
  const network::LaneSpan* Beyond(double t_m, double& outside_m) const;
};
// Its section is null where an edge moves within the stretch.
SteadyEdges SteadyEdgesOf(const network::Road& road, const Stretch& stretch);

// The place on a stretch of a panel that lies across the road from a point, or at the stretch's nearer end: on the edge
// of the point's side, or as far aside as the point where that is between the edges.
struct EdgePlace {
  double s_m = 0.0;        // within the stretch
  double found_s_m = 0.0;  // the point's own, within the panel
  double found_t_m = 0.0;
  double beyond_m = 0.0;            // how far the point lies past the panel's end, along the tangent there
  double outside_m = 0.0;           // of the edge, across
  double t_m = 0.0, t_slope = 0.0;  // of the place, and as its edge goes with s
  bool beside = false;              // s is not held at an end
  double pace = 0.0;  // metres in the plane beside the point for one of s; 0: s stands still, or the point is near the
                      // middle of the bend
  geometry::PlanPoint axis;
  network::SurfaceSample sample;
};
// steady: of this stretch, if they are known; the place is the same without them.
EdgePlace PlaceOnEdge(const network::Road& road, const geometry::AxisPanel& panel, const Stretch& stretch,
                      const Eigen::Vector2d& p_W, const SteadyEdges& steady = {});
// The same place moved along the road to another station of the panel.
EdgePlace MovedTo(double s_m, const network::Road& road, const geometry::AxisPanel& panel, const EdgePlace& place,
                  const SteadyEdges& steady = {});

}  // namespace rodeira::road
