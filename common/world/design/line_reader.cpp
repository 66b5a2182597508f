// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/line_reader.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "common/world/design/section_reader.hpp"
#include "common/world/design/station.hpp"
#include "common/world/design/tables.hpp"
#include "common/world/network/line_kinds.hpp"

namespace rodeira::design {
namespace {

using config::DeclaredMap;
using network::LineKind;
using network::PaintedLine;

// A painted line, or half of a double one. A gap of 0 is continuous.
struct Stroke {
  double stroke_m = 0.0, gap_m = 0.0;
};

// The lane on the outer edge of which a line lies.
std::optional<int> LaneOf(const DeclaredMap& keys) {
  const auto lane = keys.OptionalInteger("lane");
  return lane ? std::optional(static_cast<int>(*lane)) : std::nullopt;
}

geometry::CubicTable MiddleOf(const DeclaredMap& keys, const network::RoadSpec& spec) {
  const config::Map& item = keys.map();
  const double offset = keys.Number("offset_m");
  const bool has_t = item.Has("t_m") || item.Has("ts");
  if (item.Has("lane") == has_t) {
    item.Problem(item.Has("lane") ? "lane" : "",
                 "a line lies on the outer edge of a 'lane' (0: between left and right) or at a 't_m'");
  }
  if (!item.Has("lane"))
    return has_t ? Sum(ReadTable(keys, "t_m", "ts", "t_m", IfAbsent::kProblem), Constant(offset)) : Constant(offset);
  const int lane = *LaneOf(keys);
  if (lane != 0 && spec.sections[0].Find(lane) == nullptr) {
    item.Problem("lane", "world.unknown_lane", fmt::format("the road has no lane {}", lane));
    return Constant(0.0);
  }
  return Sum(EdgeOf(spec, lane), Constant(offset));
}

Stroke ReadStroke(const DeclaredMap& item, const LineKind& kind, bool dashed) {
  if (!dashed) return {};
  return {item.Number("stroke_m", kind.stroke_m), item.Number("gap_m", kind.gap_m)};
}

void ReadLine(const DeclaredMap& item, bool of_template, double length_m, network::RoadSpec& spec) {
  if (of_template && item.map().Has("lane") && spec.sections[0].Find(*LaneOf(item)) == nullptr) return;
  const std::string name = item.Word("kind");
  const LineKind& kind = network::LineKindByName(name);
  PaintedLine line;
  line.t = MiddleOf(item, spec);
  line.width_m = item.Number("width_m", kind.width_m);
  line.from_s_m = Station(item, "from_s_m", length_m, 0.0);
  line.to_s_m = Station(item, "to_s_m", length_m, length_m);
  line.colour = item.Word("colour");
  if (!(line.from_s_m < line.to_s_m))
    item.map().Problem("to_s_m", "config.wrong_order",
                       "a line must end after its beginning: 'to_s_m' above 'from_s_m'");
  bool dashed_left = kind.dashed_left, dashed_right = kind.dashed_right;
  if (name == "mixed") {
    dashed_left = item.Word("left") == "dashed";
    dashed_right = item.Word("right") == "dashed";
  }
  const double apart = kind.lines == 2 ? 0.5 * (item.Number("apart_m") + line.width_m) : 0.0;
  for (int i = 0; i < kind.lines; ++i) {
    const Stroke stroke = ReadStroke(item, kind, i == 0 ? dashed_left : dashed_right);
    PaintedLine painted = line;
    painted.stroke_m = stroke.stroke_m;
    painted.gap_m = stroke.gap_m;
    if (apart > 0.0) painted.t = Sum(line.t, Constant(i == 0 ? apart : -apart));
    spec.lines.push_back(std::move(painted));
  }
}

}  // namespace

void ReadLines(const DeclaredMap& map, bool of_template, double length_m, network::RoadSpec& spec) {
  const config::DeclaredList lines = map.Items("lines");
  for (std::size_t i = 0; i < lines.size(); ++i) ReadLine(lines.At(i), of_template, length_m, spec);
}

}  // namespace rodeira::design
