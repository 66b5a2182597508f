// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/world/traffic_map/heights.hpp"
#include "common/world/traffic_map/lane_map.hpp"
#include "common/world/traffic_map/map_file.hpp"

namespace rodeira::editor {

// A map as it is drawn: what the `.motors` file says, and what its companion `.motors.yaml` says beside it. It may be
// faulty: numbers twice, elements that are named and not there; of equal numbers the first element counts.
struct Document {
  traffic_map::MapFile map;
  traffic_map::Heights companion;
};

// What was loaded of the companion: what is not edited keeps these bytes.
struct LoadedCompanion {
  traffic_map::Heights value;
  std::string text;  // empty: there was no such file
};

// Where the first element with a number stands.
template <class Value>
std::optional<std::size_t> Find(const std::vector<traffic_map::Line<Value>>& lines, std::int32_t number) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].value.id == number) return i;
  }
  return std::nullopt;
}
// The first connection of these lanes.
std::optional<std::size_t> Find(const std::vector<traffic_map::Line<traffic_map::Connection>>& lines, std::int32_t from,
                                std::int32_t to);

// The number after the highest one, as the original editor counts; the lowest free one where there is none after it.
template <class Value>
std::int32_t NextNumber(const std::vector<traffic_map::Line<Value>>& lines) {
  std::int32_t highest = 0;
  for (const auto& line : lines) highest = line.value.id > highest ? line.value.id : highest;
  if (highest < INT32_MAX) return highest + 1;
  std::int32_t number = 1;
  while (Find(lines, number)) ++number;
  return number;
}

// A new map: nothing on it, the picture's scale 10.
Document EmptyDocument();

// Both files' bytes, one behind the other: equal documents have equal bytes.
std::string BytesOf(const Document& document);

// A lane's two borders in the direction of its traffic; nothing where one of its curves does not exist.
struct Borders {
  traffic_map::Cubic left, right;

  // The cubic with the means of both borders' control points.
  traffic_map::Cubic Middle() const;
};
// Of a lane that need not be in the document.
std::optional<Borders> BordersOf(const Document& document, const traffic_map::Lane& lane);
// The curve in double precision, in its own direction.
traffic_map::Cubic CubicOf(const traffic_map::Curve& curve);

}  // namespace rodeira::editor
