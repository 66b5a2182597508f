// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <set>

#include "common/world/traffic_map/check_rules.hpp"
#include "common/world/traffic_map/lane_map.hpp"

namespace rodeira::traffic_map {
namespace {

template <class Value>
void CheckTwice(const std::vector<Line<Value>>& lines, Findings& findings) {
  const NumberIndex first(lines);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::size_t found = *first.Find(lines[i].value.id);
    if (found != i)
      findings.Add(Severity::kError, lines[i], "map.duplicate_number",
                   fmt::format("its number is taken already, in line {}", lines[found].number));
  }
}

// A connection's index among those with the same two lanes; the lines are compared in the file's order.
void CheckConnectionsTwice(const MapFile& map, Findings& findings) {
  const auto& lines = map.connections;
  std::vector<std::size_t> order(lines.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto key = [&](std::size_t i) { return std::pair(lines[i].value.from, lines[i].value.to); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (key(order[i]) != key(order[i - 1])) continue;
    const auto& [first, again] = std::pair(lines[order[i - 1]], lines[order[i]]);
    const bool differ = first.value.stop != again.value.stop;
    findings.Add(
        Severity::kError, again, "map.duplicate_connection",
        fmt::format("it is there already, in line {}{}", first.number, differ ? ", and with another STOP flag" : ""));
  }
}

void CheckSides(const MapFile& map, std::vector<bool>& used, Findings& findings) {
  const NumberIndex curves(map.curves);
  for (const auto& line : map.lanes) {
    for (const bool is_left : {true, false}) {
      const std::int32_t number = is_left ? line.value.left.curve : line.value.right.curve;
      const auto found = curves.Find(number);
      if (found)
        used[*found] = true;
      else
        findings.Add(Severity::kError, line, "map.no_curve",
                     fmt::format("its {} curve {} does not exist", is_left ? "left" : "right", number));
    }
    if (line.value.left.curve == line.value.right.curve) {
      findings.Add(Severity::kError, line, "map.one_curve_on_both_sides",
                   fmt::format("curve {} is on both of its sides", line.value.left.curve));
    }
  }
}

void CheckConnections(const MapFile& map, Findings& findings) {
  const NumberIndex lanes(map.lanes);
  for (const auto& line : map.connections) {
    if (!lanes.Find(line.value.from))
      findings.Add(Severity::kError, line, "map.no_lane", fmt::format("lane {} does not exist", line.value.from));
    if (!lanes.Find(line.value.to))
      findings.Add(Severity::kError, line, "map.no_lane", fmt::format("lane {} does not exist", line.value.to));
    if (line.value.from == line.value.to)
      findings.Add(Severity::kError, line, "map.connection_to_itself",
                   "it leads back into the lane that it comes from");
  }
}

// Lanes that are there, and each in the lights of one junction.
void CheckLights(const MapFile& map, const Heights& heights, Findings& findings) {
  const NumberIndex lanes(map.lanes);
  std::set<std::string> lit;
  for (const lights::LightPlan& plan : heights.lights) {
    for (const std::string& name : plan.Names()) {
      const auto phase = std::find_if(plan.phases.begin(), plan.phases.end(), [&](const lights::Phase& p) {
        return std::find(p.green.begin(), p.green.end(), name) != p.green.end();
      });
      std::int32_t number = 0;
      const auto [end, problem] = std::from_chars(name.data(), name.data() + name.size(), number);
      if (problem != std::errc() || end != name.data() + name.size() || !lanes.Find(number))
        findings.Add(Severity::kError, *phase, "map.no_lane", fmt::format("the map has no lane {}", name));
      if (!lit.insert(name).second)
        findings.Add(Severity::kError, *phase, "map.lights_twice",
                     fmt::format("lane {} has other lights already", name));
    }
  }
}

// Signs and flows of lanes that are there; flows where vehicles begin.
void CheckSigns(const MapFile& map, const Heights& heights, Findings& findings) {
  const NumberIndex lanes(map.lanes);
  for (const LaneSign& sign : heights.signs) {
    if (!lanes.Find(sign.lane)) findings.Add(Severity::kError, sign, "map.no_lane", "the map has no such lane");
  }
  for (const LaneFlow& flow : heights.flows) {
    const auto lane = lanes.Find(flow.lane);
    if (!lane)
      findings.Add(Severity::kError, flow, "map.no_lane", "the map has no such lane");
    else if (map.lanes[*lane].value.mode != LaneMode::kStart)
      findings.Add(Severity::kError, flow, "map.flow_at_no_start", "it is no start lane: no vehicle begins there");
  }
}

// The priority at a lane's end is said once; a STOP flag of a connection is a sign, too.
void CheckPriorities(const MapFile& map, const Heights& heights, Findings& findings) {
  std::map<std::int32_t, const LaneSign*> first;
  for (const LaneSign& sign : heights.signs) {
    if (sign.kind == SignKind::kSpeedLimit) continue;
    const LaneSign& before = *first.emplace(sign.lane, &sign).first->second;
    if (before.kind != sign.kind) {
      findings.Add(
          Severity::kWarning, sign, "map.conflicting_signs",
          fmt::format(
              "'{}', but it has '{}' already, in line {}; one of 'stop', 'give_way' and 'priority' a lane was expected",
              NameOf(sign.kind), NameOf(before.kind), before.line));
    }
  }
  for (const auto& line : map.connections) {
    const auto sign = first.find(line.value.from);
    if (line.value.stop && sign != first.end() && sign->second->kind != SignKind::kStop) {
      findings.Add(Severity::kWarning, *sign->second, "map.conflicting_signs",
                   fmt::format("'{}', but its connection to lane {} has a STOP flag", NameOf(sign->second->kind),
                               line.value.to));
      first.erase(sign);
    }
  }
}

}  // namespace

void CheckNumbers(const MapFile& map, const Heights& heights, Findings& findings) {
  CheckTwice(map.curves, findings);
  CheckTwice(map.lanes, findings);
  CheckConnectionsTwice(map, findings);
  std::vector<bool> used(map.curves.size(), false);
  CheckSides(map, used, findings);
  CheckConnections(map, findings);
  const auto has = [&](LaneMode mode) {
    return std::any_of(map.lanes.begin(), map.lanes.end(),
                       [mode](const auto& line) { return line.value.mode == mode; });
  };
  if (!has(LaneMode::kStart))
    findings.Add(Severity::kError, "map.no_start", "no lane is a start lane (mode 1); at least one is needed");
  if (!has(LaneMode::kEnd))
    findings.Add(Severity::kError, "map.no_end", "no lane is an end lane (mode 2); at least one is needed");
  const NumberIndex curves(map.curves);
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i] && curves.Find(map.curves[i].value.id) == i)
      findings.Add(Severity::kWarning, map.curves[i], "map.unused_curve", "no lane uses it");
  }
  CheckLights(map, heights, findings);
  CheckSigns(map, heights, findings);
  CheckPriorities(map, heights, findings);
  for (const CurveHeights& one : heights.curves) {
    if (!curves.Find(one.curve)) findings.Add(Severity::kError, one, "map.no_curve", "the map has no such curve");
  }
}

}  // namespace rodeira::traffic_map
