// SPDX-License-Identifier: Apache-2.0
#include "common/world/traffic_map/check.hpp"

#include <fmt/format.h>

#include "common/world/traffic_map/check_rules.hpp"

namespace rodeira::traffic_map {
namespace {

std::string ElementName(const Finding& finding) {
  switch (finding.element) {
    case Element::kCurve:
      return fmt::format("curve {}", finding.number);
    case Element::kLane:
      return fmt::format("lane {}", finding.number);
    case Element::kConnection:
      return fmt::format("connection {} to {}", finding.number, finding.to);
    case Element::kHeights:
      return fmt::format("heights of curve {}", finding.number);
    case Element::kLights:
      return "lights";
    case Element::kSign:
      return fmt::format("sign of lane {}", finding.number);
    case Element::kFlow:
      return fmt::format("flow of lane {}", finding.number);
    case Element::kMap:
      break;
  }
  return "map";
}

}  // namespace

std::string Finding::Text() const { return ElementName(*this) + ": " + sentence; }

std::string Finding::Place(const std::string& file) const {
  const bool beside = element == Element::kHeights || element == Element::kLights || element == Element::kSign ||
                      element == Element::kFlow;
  const std::string name = beside ? file + ".yaml" : file;
  return line == 0 ? name : fmt::format("{}:{}", name, line);
}

std::vector<Finding> CheckMap(const MapFile& map, const Heights& heights) {
  Findings findings;
  CheckNumbers(map, heights, findings);
  CheckWays(map, findings);
  CheckShapes(map, heights, findings);
  return findings.all();
}

}  // namespace rodeira::traffic_map
