// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <tuple>

#include "common/core/base/files.hpp"
#include "common/world/traffic_map/map_file.hpp"
#include "common/world/traffic_map/map_line.hpp"

namespace rodeira::traffic_map {
namespace {

template <class Value>
std::string TextOf(const Line<Value>& line) {
  if (!line.text.empty()) {
    const auto kept = ReadLine<Value>(WithoutLineEnd(line.text));
    if (kept && kept.value() == line.value) return line.text;
  }
  return LineText(line.value);
}

struct Placed {
  std::size_t behind;  // the line of the read file that it is or that it stands behind
  bool added;
  std::string text;
};

// `last` is the last line of the read file that the lines of this kind stand behind where they are new.
template <class Value>
void Place(const std::vector<Line<Value>>& lines, std::size_t& last, std::vector<Placed>& all) {
  for (const auto& line : lines) last = std::max(last, line.number);
  for (const auto& line : lines) all.push_back({line.number == 0 ? last : line.number, line.number == 0, TextOf(line)});
}

}  // namespace

std::string WriteMap(const MapFile& map) {
  std::vector<Placed> all;
  std::size_t last = 0;
  Place(map.curves, last, all);
  Place(map.lanes, last, all);
  Place(map.connections, last, all);
  Place(std::vector<Line<Scale>>{map.scale}, last, all);
  std::stable_sort(all.begin(), all.end(), [](const Placed& a, const Placed& b) {
    return std::tie(a.behind, a.added) < std::tie(b.behind, b.added);
  });
  std::string bytes;
  for (const Placed& line : all) bytes += line.text;
  return bytes + "i\n" + map.picture;
}

base::Status SaveMap(const MapFile& map, const std::filesystem::path& path) {
  return base::WriteWhole(path, WriteMap(map));
}

}  // namespace rodeira::traffic_map
