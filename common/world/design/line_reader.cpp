// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/line_reader.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "common/world/design/section_reader.hpp"
#include "common/world/design/tables.hpp"
#include "common/world/network/line_kinds.hpp"

namespace rodeira::design {
namespace {

using config::Map;
using network::LineKind;
using network::PaintedLine;

// A painted line, or half of a double one. A gap of 0 is continuous.
struct Stroke {
  double stroke_m = 0.0, gap_m = 0.0;
};

geometry::CubicTable MiddleOf(const Map& item, const network::RoadSpec& spec) {
  const double offset = item.Number("offset_m", {-50.0, 50.0}, 0.0);
  if (item.Has("lane") == (item.Has("t_m") || item.Has("ts"))) {
    item.Problem(item.Has("lane") ? "lane" : "",
                 "a line lies on the outer edge of a 'lane' (0: between left and right) or at a 't_m'");
  }
  if (!item.Has("lane")) return Sum(ReadTable(item, "t_m", "ts", "t_m", {-200.0, 200.0}, 0.0), Constant(offset));
  const int lane = static_cast<int>(item.Integer("lane", -30, 30));
  if (lane != 0 && spec.sections[0].Find(lane) == nullptr) {
    item.Problem("lane", "world.unknown_lane", fmt::format("the road has no lane {}", lane));
    return Constant(0.0);
  }
  return Sum(EdgeOf(spec, lane), Constant(offset));
}

Stroke ReadStroke(const Map& item, const LineKind& kind, bool dashed) {
  if (!dashed) return {};
  return {item.Number("stroke_m", {0.1, 100.0}, kind.stroke_m), item.Number("gap_m", {0.1, 100.0}, kind.gap_m)};
}

void ReadLine(const Map& item, bool of_template, double length_m, network::RoadSpec& spec) {
  if (of_template && item.Has("lane") &&
      spec.sections[0].Find(static_cast<int>(item.Integer("lane", -30, 30))) == nullptr)
    return;
  std::vector<std::string> names;
  for (const LineKind& kind : network::kLineKinds) names.emplace_back(kind.name);
  const std::string name = item.Choice("kind", names);
  const LineKind& kind = network::LineKindByName(name);
  PaintedLine line;
  line.t = MiddleOf(item, spec);
  line.width_m = item.Number("width_m", {0.01, 5.0}, kind.width_m);
  line.from_s_m = item.Number("from_s_m", {0.0, length_m}, 0.0);
  line.to_s_m = item.Number("to_s_m", {0.0, length_m}, length_m);
  line.colour = item.Choice("colour", {"white", "yellow", "blue", "red", "orange"}, "white");
  if (!(line.from_s_m < line.to_s_m))
    item.Problem("to_s_m", "config.wrong_order", "a line must end after its beginning: 'to_s_m' above 'from_s_m'");
  bool dashed_left = kind.dashed_left, dashed_right = kind.dashed_right;
  if (name == "mixed") {
    dashed_left = item.Choice("left", {"continuous", "dashed"}, "continuous") == "dashed";
    dashed_right = item.Choice("right", {"continuous", "dashed"}, "dashed") == "dashed";
  }
  const double apart =
      kind.lines == 2 ? 0.5 * (item.Number("apart_m", {0.02, 5.0}, network::kLinesApart_m) + line.width_m) : 0.0;
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

void ReadLines(const Map& map, bool of_template, double length_m, network::RoadSpec& spec) {
  const config::List lines = map.OptionalItems("lines");
  for (std::size_t i = 0; i < lines.size(); ++i) ReadLine(lines.At(i), of_template, length_m, spec);
}

}  // namespace rodeira::design
