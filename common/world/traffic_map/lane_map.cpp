// SPDX-License-Identifier: Apache-2.0
#include "common/world/traffic_map/lane_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "common/world/traffic_map/picture.hpp"

namespace rodeira::traffic_map {

std::optional<std::size_t> NumberIndex::Find(std::int32_t number) const {
  const auto at = std::lower_bound(places_.begin(), places_.end(), std::pair(number, std::size_t{0}));
  if (at == places_.end() || at->first != number) return std::nullopt;
  return at->second;
}

void NumberIndex::Sort() { std::sort(places_.begin(), places_.end()); }

Border BorderOf(const LaneSide& side, const Curve& curve, const Heights& heights) {
  Border border;
  border.z_m = heights.Of(curve.id);
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    border.plan.p_W[i] =
        Eigen::Vector2d(static_cast<double>(curve.points[i].x_m), static_cast<double>(curve.points[i].y_m));
  }
  if (side.inverted) {
    border.plan = border.plan.Reversed();
    std::reverse(border.z_m.begin(), border.z_m.end());
  }
  return border;
}

namespace {

// Two lanes and no more have the curve for a side, one to its left and one to its right.
void FindNeighbours(const MapFile& file, LaneMap& map) {
  struct Use {
    std::size_t lane;
    bool is_left;       // the lane's left side
    bool to_the_right;  // of the curve lies the lane
  };
  std::map<std::int32_t, std::vector<Use>> uses;  // by curve
  for (std::size_t i = 0; i < file.lanes.size(); ++i) {
    const Lane& lane = file.lanes[i].value;
    uses[lane.left.curve].push_back({i, true, !lane.left.inverted});
    uses[lane.right.curve].push_back({i, false, lane.right.inverted});
  }
  for (const auto& [curve, of] : uses) {
    if (of.size() != 2 || of[0].lane == of[1].lane || of[0].to_the_right == of[1].to_the_right) continue;
    for (const auto& [own, other] : {std::pair(of[0], of[1]), std::pair(of[1], of[0])}) {
      (own.is_left ? map.lanes[own.lane].left : map.lanes[own.lane].right) = other.lane;
    }
  }
}

}  // namespace

base::Result<LaneMap> MakeLaneMap(const MapFile& file, const Heights& heights, const std::string& name) {
  for (const Finding& finding : CheckMap(file, heights)) {
    if (finding.severity == Severity::kError) return base::WrongInput(finding.id, finding.Text(), finding.Place(name));
  }
  LaneMap map;
  map.left_hand = heights.left_hand;
  const NumberIndex curves(file.curves);
  const NumberIndex lanes(file.lanes);
  for (const auto& [lane, text, number] : file.lanes) {
    const Curve& left = file.curves[*curves.Find(lane.left.curve)].value;
    const Curve& right = file.curves[*curves.Find(lane.right.curve)].value;
    if (lane.mode == LaneMode::kStart) map.start_lanes.push_back(map.lanes.size());
    if (lane.mode == LaneMode::kEnd) map.end_lanes.push_back(map.lanes.size());
    const LaneShape shape(BorderOf(lane.left, left, heights), BorderOf(lane.right, right, heights));
    map.lanes.push_back({lane.id, lane.mode, lane.left.type, lane.right.type, shape, {}, {}});
  }
  FindNeighbours(file, map);
  for (const auto& [connection, text, number] : file.connections) {
    const std::size_t from = *lanes.Find(connection.from), to = *lanes.Find(connection.to);
    map.lanes[from].onward.push_back(map.connections.size());
    map.lanes[to].arriving.push_back(map.connections.size());
    map.connections.push_back({from, to, connection.stop});
  }
  for (const lights::LightPlan& plan : heights.lights) {
    for (const std::string& lane : plan.Names())
      map.lights.push_back({*lanes.Find(std::stoi(lane)), *lights::TimesOf(plan, lane)});
  }
  for (const LaneSign& sign : heights.signs) {
    const std::size_t lane = *lanes.Find(sign.lane);
    map.signs.push_back(
        {lane, sign.kind, std::max(0.0, map.lanes[lane].shape.length_m() - sign.before_end_m), sign.limit_kmh});
  }
  if (const auto picture = ReadPictureInfo(file.picture)) {
    map.picture_height_m = 10.0 * static_cast<double>(file.scale.value.value);
    map.picture_width_m = map.picture_height_m * picture->width_px / picture->height_px;
  }
  return map;
}

bool BeginsAndEndsAtItsEdge(const LaneMap& map) {
  return std::all_of(map.lanes.begin(), map.lanes.end(), [](const MapLane& lane) {
    return (lane.mode == LaneMode::kStart) == lane.arriving.empty() &&
           (lane.mode == LaneMode::kEnd) == lane.onward.empty();
  });
}

base::Result<LaneMap> LoadLaneMap(const std::filesystem::path& path) {
  const auto file = LoadMap(path);
  if (!file) return file.error();
  const auto heights = LoadHeightsOf(path);
  if (!heights) return heights.error();
  return MakeLaneMap(file.value(), heights.value(), path.string());
}

}  // namespace rodeira::traffic_map
