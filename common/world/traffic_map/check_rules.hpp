// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/world/traffic_map/check.hpp"

namespace rodeira::traffic_map {

// Findings are added by element, whatever it is, each with the id of its rule.
class Findings {
 public:
  // The sentence has no place; number and line are the element's.
  void Add(Severity severity, const Line<Curve>& curve, base::ErrorId id, std::string sentence) {
    all_.push_back({severity, Element::kCurve, curve.value.id, 0, curve.number, id, std::move(sentence)});
  }
  void Add(Severity severity, const Line<Lane>& lane, base::ErrorId id, std::string sentence) {
    all_.push_back({severity, Element::kLane, lane.value.id, 0, lane.number, id, std::move(sentence)});
  }
  void Add(Severity severity, const Line<Connection>& connection, base::ErrorId id, std::string sentence) {
    all_.push_back({severity, Element::kConnection, connection.value.from, connection.value.to, connection.number, id,
                    std::move(sentence)});
  }
  void Add(Severity severity, const CurveHeights& heights, base::ErrorId id, std::string sentence) {
    all_.push_back({severity, Element::kHeights, heights.curve, 0, heights.line, id, std::move(sentence)});
  }
  void Add(Severity severity, const lights::Phase& phase, base::ErrorId id, std::string sentence) {
    all_.push_back({severity, Element::kLights, 0, 0, LineOf(phase.place), id, std::move(sentence)});
  }
  void Add(Severity severity, const LaneSign& sign, base::ErrorId id, std::string sentence) {
    all_.push_back({severity, Element::kSign, sign.lane, 0, sign.line, id, std::move(sentence)});
  }
  void Add(Severity severity, const LaneFlow& flow, base::ErrorId id, std::string sentence) {
    all_.push_back({severity, Element::kFlow, flow.lane, 0, flow.line, id, std::move(sentence)});
  }
  // Of the map as a whole.
  void Add(Severity severity, base::ErrorId id, std::string sentence) {
    all_.push_back({severity, Element::kMap, 0, 0, 0, id, std::move(sentence)});
  }

  const std::vector<Finding>& all() const { return all_; }

 private:
  std::vector<Finding> all_;
};

// Numbers that are there twice, or are named and not there; start and end lanes; curves that are not used.
void CheckNumbers(const MapFile& map, const Heights& heights, Findings& findings);
// Where no vehicle gets to, or away from.
void CheckWays(const MapFile& map, Findings& findings);
// Curves, lanes, and how lanes fit together; the picture.
void CheckShapes(const MapFile& map, const Heights& heights, Findings& findings);

}  // namespace rodeira::traffic_map
