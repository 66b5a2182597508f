// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/core/base/error_id.hpp"
#include "common/world/traffic_map/heights.hpp"
#include "common/world/traffic_map/map_file.hpp"

namespace rodeira::traffic_map {

enum class Severity {
  kError,
  kWarning
};  // an error: no traffic can use the map; a warning: it can, but is that meant?
enum class Element { kMap, kCurve, kLane, kConnection, kHeights, kLights, kSign, kFlow };

// Something that is wrong with one element of a map.
struct Finding {
  Severity severity = Severity::kError;
  Element element = Element::kMap;
  std::int32_t number =
      0;                 // of the curve or lane (also of its sign or flow); of a connection the lane that it comes from
  std::int32_t to = 0;   // of a connection the lane that it goes to
  std::size_t line = 0;  // of the file; 0: the whole map, or an element that is in no file yet
  base::ErrorId id;      // the rule
  std::string sentence;

  // "lane 3: its left curve 7 does not exist"
  std::string Text() const;
  // "FILE:LINE", or the file alone.
  std::string Place(const std::string& file) const;
};

// Everything that is wrong, errors and warnings in the order of the rules of docs/reference/traffic-maps.md and, in a
// rule, of the file. A map without errors can be made a LaneMap.
std::vector<Finding> CheckMap(const MapFile& map, const Heights& heights);

}  // namespace rodeira::traffic_map
