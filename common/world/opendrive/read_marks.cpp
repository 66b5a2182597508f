// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "common/world/opendrive/measures.hpp"
#include "common/world/opendrive/read.hpp"

namespace rodeira::opendrive {
namespace {

network::MarkLine ReadLine(const Node& line) {
  network::MarkLine read;
  read.length_m = line.Number("length", 0.0);
  read.space_m = line.Number("space", 0.0);
  read.t_offset_m = line.Number("tOffset", 0.0);
  read.s_offset_m = line.Number("sOffset", 0.0);
  read.width_m = line.Number("width", 0.0);
  read.rule = line.Text("rule", "");
  read.colour = line.Text("color", "");
  const double pattern_m = read.length_m + read.space_m;
  if (read.length_m > 0.0 && read.space_m > 0.0 && pattern_m < kShortestPattern_m) {
    Source& source = line.source();
    source.warnings.push_back({"road.lane.roadMark",
                               fmt::format("the dashes of a line and the gaps between them are {:.6g} m long together; "
                                           "{:.6g} m at least were expected: it is painted without gaps",
                                           pattern_m, kShortestPattern_m),
                               line.line(), source.where.road, source.where.lane, source.where.s_m});
    read.space_m = 0.0;
  }
  return read;
}

}  // namespace

network::RoadMark ReadMark(const Node& mark, double section_s_m) {
  network::RoadMark read;
  read.type = mark.Text("type", "none");
  read.weight = mark.Text("weight", "standard");
  read.colour = mark.Text("color", "standard");
  read.material = mark.Text("material", "standard");
  read.lane_change = mark.Text("laneChange", "both");
  read.width_m = mark.Number("width", 0.0);
  read.height_m = mark.Number("height", 0.0);
  for (const Node& type : mark.Children("type")) {
    for (const Node& line : type.Children("line")) read.lines.push_back(ReadLine(line));
  }
  for (const Node& group : mark.Children("explicit")) {
    for (const Node& line : group.Children("line")) read.explicit_lines.push_back(ReadLine(line));
  }
  read.sway = ReadCubics(mark.Children("sway"), "ds", section_s_m + mark.Number("sOffset", 0.0),
                         "road.lane.roadMark.sway.elem_asc_order");
  return read;
}

}  // namespace rodeira::opendrive
