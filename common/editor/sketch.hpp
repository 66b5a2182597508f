// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "common/editor/commands.hpp"

namespace rodeira::editor {

// Where something stands and points, from east to north.
struct Pose {
  Eigen::Vector2d p_W = Eigen::Vector2d::Zero();
  double heading_rad = 0.0;

  // By so much in its own frame; the heading stays.
  Pose Moved(double ahead_m, double left_m) const;
  Pose Turned(double rad) const { return {p_W, heading_rad + rad}; }
};

// Several lanes drawn at once: lanes side by side share their curve. Numbers go on from the document's highest.
class Sketch {
 public:
  explicit Sketch(const Document& document);

  // From pose to pose of its middle; its number.
  std::int32_t Lane(const Pose& from, const Pose& to, double width_m, traffic_map::BorderType left,
                    traffic_map::BorderType right, traffic_map::LaneMode mode = traffic_map::LaneMode::kNone);
  // Numbers that Lane returned.
  void Connect(std::int32_t from, std::int32_t to, bool stop = false) { connections_.push_back({from, to, stop, {}}); }
  // A give-way sign at the lane's end.
  void GiveWay(std::int32_t lane) { signs_.push_back({lane, traffic_map::SignKind::kGiveWay, 0.0, 0.0, 0}); }

  // All of it into the document, or a sentence where it does not fit there.
  base::Result<Edit> Finish(Document& document, std::string what) const;

 private:
  traffic_map::LaneSide Side(const Points& points, traffic_map::BorderType type);

  std::int32_t next_curve_, next_lane_;
  std::vector<std::pair<std::int32_t, Points>> curves_;
  std::vector<traffic_map::Lane> lanes_;
  std::vector<traffic_map::Connection> connections_;
  std::vector<traffic_map::LaneSign> signs_;
};

}  // namespace rodeira::editor
