// SPDX-License-Identifier: Apache-2.0
#include "common/world/traffic_map/map_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/world/traffic_map/lane_map.hpp"
#include "common/world/traffic_map/picture.hpp"

namespace rodeira::traffic_map {
namespace {

std::string Row(std::string_view name, const std::string& value) { return fmt::format("{:<13}{}\n", name, value); }

template <class Value, class Test>
auto Count(const std::vector<Line<Value>>& lines, const Test& test) {
  return std::count_if(lines.begin(), lines.end(), [&](const Line<Value>& line) { return test(line.value); });
}

std::string DescribePicture(const MapFile& map) {
  if (map.picture.empty()) return "none";
  const auto picture = ReadPictureInfo(map.picture);
  if (!picture) return fmt::format("{} bytes of an unknown kind", map.picture.size());
  const double height_m = 10.0 * static_cast<double>(map.scale.value.value);
  return fmt::format("{}, {} x {} pixels, {} bytes, {:.6g} x {:.6g} m on the ground", picture->kind, picture->width_px,
                     picture->height_px, map.picture.size(), height_m * picture->width_px / picture->height_px,
                     height_m);
}

}  // namespace

std::string DescribeMap(const MapFile& map, const Heights& heights, const std::vector<Finding>& findings) {
  const auto start = Count(map.lanes, [](const Lane& lane) { return lane.mode == LaneMode::kStart; });
  const auto end = Count(map.lanes, [](const Lane& lane) { return lane.mode == LaneMode::kEnd; });
  const auto stops = Count(map.connections, [](const Connection& connection) { return connection.stop; });
  const auto errors =
      std::count_if(findings.begin(), findings.end(), [](const Finding& f) { return f.severity == Severity::kError; });
  std::string table =
      Row("curves", fmt::format("{}{}", map.curves.size(),
                                heights.curves.empty() ? "" : fmt::format(", {} with heights", heights.curves.size())));
  table += Row("lanes", fmt::format("{}: {} start, {} end", map.lanes.size(), start, end));
  if (const auto made = MakeLaneMap(map, heights, ""); made.ok()) {
    double length_m = 0.0;
    for (const MapLane& lane : made.value().lanes) length_m += lane.shape.length_m();
    table += Row("length", fmt::format("{:.1f} m of lanes", length_m));
  }
  table += Row("connections", fmt::format("{}, {} with STOP", map.connections.size(), stops));
  table += Row("picture", DescribePicture(map));
  return table + Row("found", fmt::format("{} errors, {} warnings", errors,
                                          static_cast<std::ptrdiff_t>(findings.size()) - errors));
}

}  // namespace rodeira::traffic_map
