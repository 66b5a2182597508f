// SPDX-License-Identifier: Apache-2.0
#include "common/editor/export.hpp"

#include <fmt/format.h>

#include "common/world/traffic_map/lane_map.hpp"
#include "common/world/traffic_map/world_files.hpp"

namespace rodeira::editor {

base::Result<std::string> Export(const Document& document, const std::filesystem::path& path) {
  const auto lanes = traffic_map::MakeLaneMap(document.map, document.companion, "map");
  if (!lanes) return lanes.error().WithContext("");
  const auto drive = traffic_map::WriteWorld(lanes.value(), path, "drawn with rodeira edit");
  if (!drive) return drive.error();
  const bool alone = path.extension() == ".xodr";
  const std::string roads = std::filesystem::path(path).replace_extension(".xodr").filename().string();
  return fmt::format("exported {}{}: {} roads, {} junctions", alone ? "" : path.filename().string() + " and ", roads,
                     drive.value().roads, drive.value().junctions);
}

}  // namespace rodeira::editor
