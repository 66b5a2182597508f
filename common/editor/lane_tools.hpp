// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/editor/commands.hpp"

// Lanes in one gesture.
namespace rodeira::editor {

// Width, borders and mode of a lane that is drawn.
struct LaneLook {
  double width_m = 3.25;
  traffic_map::BorderType left = traffic_map::BorderType::kBoundary;
  traffic_map::BorderType right = traffic_map::BorderType::kBoundary;
  traffic_map::LaneMode mode = traffic_map::LaneMode::kNone;
};

// A lane along its middle, driven from the first point to the last: two curves and the lane.
base::Result<Edit> LaneAlong(Document& document, const Points& middle_W, const LaneLook& look);

// A lane beside a lane, on its left or right, as wide as that one at its beginning. They share the border between them,
// which becomes what separates lanes of one direction or of two. Driven the same way, or against it.
base::Result<Edit> LaneBeside(Document& document, std::int32_t lane, bool on_left, bool same_way);

// Control points of a curve from a place and direction to another one, handles of 4/3 tan(turn/4) radii, which is the
// circle where there is one; of a third of the chord where it turns by more than 162 degrees.
Points CurveBetween(const Eigen::Vector2d& from_W, double from_rad, const Eigen::Vector2d& to_W, double to_rad);

// Where a lane may be joined: an end or a beginning of a lane's middle, with the direction of its traffic there.
struct LaneEnd {
  Eigen::Vector2d p_W = Eigen::Vector2d::Zero();
  double heading_rad = 0.0;
};
// The nearest end (from which a new lane goes on) or beginning (to which it leads) within a radius.
std::optional<LaneEnd> LaneEndNear(const Document& document, bool beginning, const Eigen::Vector2d& p_W,
                                   double radius_m);
// The middle of a lane drawn from here to there: it leaves the lane that ends here, and meets the one that begins
// there, smoothly; with one of them an arc, with none of them straight.
Points MiddleBetween(const Document& document, const Eigen::Vector2d& from_W, const Eigen::Vector2d& to_W,
                     double radius_m);

// Lanes with ends that meet (within 0.3 m and 15 degrees) and that are not connected yet: from, to; ascending.
std::vector<std::pair<std::int32_t, std::int32_t>> MissingConnections(const Document& document);
// Of one lane alone: those that come to it or go on from it.
std::vector<std::pair<std::int32_t, std::int32_t>> MissingConnections(const Document& document, std::int32_t lane);
// At least one pair of lanes, from and to; none of these connections may be there yet.
base::Result<Edit> Connect(Document& document, const std::vector<std::pair<std::int32_t, std::int32_t>>& connections);

}  // namespace rodeira::editor
