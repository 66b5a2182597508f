// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/world/traffic_map/check.hpp"
#include "common/world/traffic_map/heights.hpp"
#include "common/world/traffic_map/lane_shape.hpp"
#include "common/world/traffic_map/map_file.hpp"

namespace rodeira::traffic_map {

// Where a number stands: the index of the first element with it.
class NumberIndex {
 public:
  template <class Value>
  explicit NumberIndex(const std::vector<Line<Value>>& lines) {
    for (std::size_t i = 0; i < lines.size(); ++i) places_.emplace_back(lines[i].value.id, i);
    Sort();
  }
  // Nothing where no element has the number.
  std::optional<std::size_t> Find(std::int32_t number) const;

 private:
  void Sort();
  std::vector<std::pair<std::int32_t, std::size_t>> places_;
};

// A lane's side with its curve turned into the direction of the traffic.
Border BorderOf(const LaneSide& side, const Curve& curve, const Heights& heights);

// A lane of the map in the direction of its traffic.
struct MapLane {
  std::int32_t id = 0;
  LaneMode mode = LaneMode::kNone;
  BorderType left_type = BorderType::kNone;
  BorderType right_type = BorderType::kNone;
  LaneShape shape;
  std::vector<std::size_t> onward;  // connections that leave it, in the file's order
  std::vector<std::size_t> arriving;
  std::optional<std::size_t> left{},
      right{};  // the lane beside, which has the same curve for a side and lies across it; nothing where several do
};

// Traffic may go from the end of one lane to the beginning of another.
struct MapConnection {
  std::size_t from = 0;  // indices of lanes
  std::size_t to = 0;
  bool stop = false;
};

// A light at the end of a lane.
struct MapLight {
  std::size_t lane = 0;
  network::LightTimes times;
};

// A sign for the traffic of a lane.
struct MapSign {
  std::size_t lane = 0;
  SignKind kind = SignKind::kGiveWay;
  double s_m = 0.0;        // along the lane
  double limit_kmh = 0.0;  // of a speed limit
};

// A map as traffic uses it: every number resolved, every lane with its shape. Lanes and connections stand in the file's
// order. Immutable after it is made.
struct LaneMap {
  std::vector<MapLane> lanes;
  std::vector<MapConnection> connections;
  std::vector<std::size_t> start_lanes;
  std::vector<std::size_t> end_lanes;
  std::vector<MapLight> lights;  // at most one a lane
  bool left_hand = false;
  std::vector<MapSign> signs;  // in the file's order; STOP of connections stands there
  // The picture on the ground, centred on the origin; no size where there is none that can be read.
  double picture_width_m = 0.0;
  double picture_height_m = 0.0;
};

// Whether vehicles begin on every lane that no connection leads to, end on every lane that none leaves, and nowhere
// else: what any network says by itself.
bool BeginsAndEndsAtItsEdge(const LaneMap& map);

// Wrong input with the first error of CheckMap; warnings do not hinder. `name` stands for the file in messages.
base::Result<LaneMap> MakeLaneMap(const MapFile& file, const Heights& heights, const std::string& name);
// Reads the file and its companion with the heights. Wrong input where either cannot be read, or as MakeLaneMap.
base::Result<LaneMap> LoadLaneMap(const std::filesystem::path& path);

}  // namespace rodeira::traffic_map
