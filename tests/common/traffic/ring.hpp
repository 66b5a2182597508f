// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "common/traffic/traffic_model.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::traffic {

inline constexpr double kRingLimit_mps = 15.0;

// A road around a circle to the left, going on into itself, which still has a sample's lanes.
inline opendrive::RoadText CircleRoad(double length_m, bool left_hand = false) {
  opendrive::RoadText road;
  road.length = length_m;
  if (left_hand) road.attributes += " rule=\"LHT\"";
  road.link =
      "<predecessor elementType=\"road\" elementId=\"1\" contactPoint=\"end\"/>"
      "<successor elementType=\"road\" elementId=\"1\" contactPoint=\"start\"/>";
  road.geometry =
      fmt::format("<geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"{0}\"><arc curvature=\"{1:.17g}\"/></geometry>",
                  length_m, 2.0 * std::numbers::pi / length_m);
  return road;
}

// A lane of such a road, 3.5 m wide, with this limit and, where it has them, these marks at its outer edge.
inline std::string CircleLane(int id, double limit_mps, const std::string& marks = "") {
  return fmt::format(
      "<lane id=\"{0}\" type=\"driving\"><link><predecessor id=\"{0}\"/><successor id=\"{0}\"/></link>"
      "<width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/>{1}<speed sOffset=\"0\" max=\"{2}\" "
      "unit=\"m/s\"/></lane>",
      id, marks, limit_mps);
}

// A mark of this type along a lane's edge, from s on.
inline std::string Mark(const std::string& type, double from_m = 0.0) {
  return fmt::format("<roadMark sOffset=\"{}\" type=\"{}\" color=\"white\" width=\"0.12\"/>", from_m, type);
}

// One lane of it.
inline std::shared_ptr<const network::Network> Ring(double length_m, double limit_mps = kRingLimit_mps) {
  opendrive::RoadText road = CircleRoad(length_m);
  road.left = "";
  road.right = CircleLane(-1, limit_mps);
  return opendrive::MustRead(opendrive::Document(road.Text()));
}

// The gap that is left to each car, and the speed at which (s0 + v T) / sqrt(1 - (v/v0)^4) is that gap.
struct Equilibrium {
  double gap_m = 0.0, speed_mps = 0.0;
};
inline Equilibrium EquilibriumOf(const TrafficModel& model, const driver::IdmSettings& idm) {
  double length = model.graph()[0].length_m();
  for (const AgentPose& pose : model.poses()) length -= model.traits(pose.id).length_m;
  Equilibrium at{length / static_cast<double>(model.on_road()), 0.0};
  double low = 0.0, high = kRingLimit_mps;
  for (int i = 0; i < 60; ++i) {
    at.speed_mps = 0.5 * (low + high);
    const double gap =
        (idm.min_gap_m + at.speed_mps * idm.time_gap_s) / std::sqrt(1.0 - std::pow(at.speed_mps / kRingLimit_mps, 4));
    (gap < at.gap_m ? low : high) = at.speed_mps;
  }
  return at;
}

}  // namespace rodeira::traffic
