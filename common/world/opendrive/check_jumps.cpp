// SPDX-License-Identifier: Apache-2.0
// Widths and lane offsets that jump from one record to the next within a lane section, which moves lanes that are
// driven on.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/world/opendrive/checks.hpp"

namespace rodeira::opendrive {
namespace {

using geometry::Cubic;
using network::Lane;

constexpr double kEach_m = 6.0;  // the length over which a jump of a metre is smoothed
constexpr double kShortest_m = 5.0, kLongest_m = 100.0, kLeast_m = 1.0;

std::string CubicRecord(const char* name, const char* from, const Cubic& cubic, double origin_m) {
  return fmt::format("<{} {}=\"{}\" a=\"{}\" b=\"{}\" c=\"{}\" d=\"{}\"/>", name, from, cubic.from - origin_m, cubic.a,
                     cubic.b, cubic.c, cubic.d);
}

// In place of a record: a cubic from where the one before ends to where this one is some metres on, then this one.
Repair Smoothed(const std::vector<Node>& nodes, const Cubic& before, const Cubic& record, const char* from,
                double origin_m, double room_m) {
  const double jump_m = record.a - before.Value(record.from);
  const double length_m = std::min(room_m, std::clamp(kEach_m * std::fabs(jump_m), kShortest_m, kLongest_m)),
               to = record.from + length_m;
  const auto node = std::find_if(nodes.rbegin(), nodes.rend(), [&](const Node& each) {
    return std::fabs(each.xml().attribute(from).as_double() + origin_m - record.from) < 1e-9;
  });
  if (length_m < kLeast_m || node == nodes.rend()) return {RepairKind::kJumpKept, "it is driven as it lies"};
  const double low = before.Value(record.from), low_slope = before.Slope(record.from), high = record.Value(to),
               high_slope = record.Slope(to);
  const Cubic ramp{record.from, low, low_slope,
                   (3.0 * (high - low) / length_m - 2.0 * low_slope - high_slope) / length_m,
                   (2.0 * (low - high) / length_m + low_slope + high_slope) / (length_m * length_m)};
  std::string text = CubicRecord(node->xml().name(), from, ramp, origin_m);
  if (length_m < room_m)
    text += CubicRecord(node->xml().name(), from, {to, high, high_slope, 0.5 * record.Bend(to), record.d}, origin_m);
  return {RepairKind::kJumpSmoothed,
          fmt::format("it goes over within {:.3g} m", length_m),
          {node->Replace(std::move(text))}};
}

struct JumpChecker {
  const RoadReading& road;
  const Tolerance& tolerance;
  Findings& findings;

  // Records between two stations, which say `from` counted from the origin.
  void Table(const geometry::CubicTable& table, const std::vector<Node>& nodes, const char* from, double origin_m,
             double begin_m, double end_m, const char* what, std::optional<int> lane, std::size_t line) const {
    for (std::size_t i = 1; i < table.records().size(); ++i) {
      const Cubic &before = table.records()[i - 1], &record = table.records()[i];
      if (!(record.from > begin_m && record.from < end_m)) continue;
      const double jump_m = record.a - before.Value(record.from);
      if (!(std::fabs(jump_m) > LaneGap(tolerance))) continue;
      const double next = i + 1 < table.records().size() ? std::min(table.records()[i + 1].from, end_m) : end_m;
      findings.errors.push_back({"lane_smoothness.contact_point_no_horizontal_gaps",
                                 fmt::format("{} jumps by {:.4g} m from one record to the next; at most {:.3g} m was "
                                             "expected",
                                             what, jump_m, LaneGap(tolerance)),
                                 line, road.spec.id, lane, record.from,
                                 Smoothed(nodes, before, record, from, origin_m, next - record.from)});
    }
  }

  void Side(const std::vector<Lane>& lanes, std::size_t section) const {
    const double from_m = road.spec.sections[section].s_m;
    const double end_m =
        section + 1 < road.spec.sections.size() ? road.spec.sections[section + 1].s_m : road.spec.length_m;
    std::size_t moved = 0;  // lanes that lie inside of one that is driven on, and that one
    for (std::size_t i = 0; i < lanes.size(); ++i) {
      if (network::IsDrivable(lanes[i].type)) moved = i + 1;
    }
    const Node node(findings.source, road.lines.section_nodes[section]);
    for (std::size_t i = 0; i < moved; ++i) {
      const Lane& lane = lanes[i];
      if (lane.width.records().size() < 2) continue;
      for (const Node& each : node.Child(lane.id > 0 ? "left" : "right").Children("lane")) {
        if (each.xml().attribute("id").as_int() != lane.id) continue;
        Table(lane.width, each.Children("width"), "sOffset", from_m, from_m, end_m, "the lane's width", lane.id,
              each.line());
        break;
      }
    }
  }
};

}  // namespace

void CheckJumps(const RoadReading& road, const Tolerance& tolerance, Findings& findings) {
  const JumpChecker checker{road, tolerance, findings};
  const Node lanes = Node(findings.source, road.lines.node).Child("lanes");
  for (std::size_t i = 0; i < road.spec.sections.size(); ++i) {
    checker.Side(road.spec.sections[i].left, i);
    checker.Side(road.spec.sections[i].right, i);
    // Where a section begins, lanes go on into those of another one: their edges are compared.
    const double end_m = i + 1 < road.spec.sections.size() ? road.spec.sections[i + 1].s_m : road.spec.length_m;
    checker.Table(road.spec.lane_offset, lanes.Children("laneOffset"), "s", 0.0, road.spec.sections[i].s_m, end_m,
                  "the lane offset", std::nullopt, road.lines.sections[i]);
  }
}

}  // namespace rodeira::opendrive
