#pragma once

#include <cmath>
#include <memory>
#include <numbers>

#include "common/traffic/traffic_model.hpp"
#include "tests/common/opendrive/sample.hpp"

namespace rodeira::traffic {

inline constexpr double kRingLimit_mps = 15.0;

// One lane around a circle, going on into itself.
inline std::shared_ptr<const network::Network> Ring(double length_m, double limit_mps = kRingLimit_mps) {
  opendrive::RoadText road;
  road.length = length_m;
  road.link = "<predecessor elementType=\"road\" elementId=\"1\" contactPoint=\"end\"/>"
              "<successor elementType=\"road\" elementId=\"1\" contactPoint=\"start\"/>";
  road.geometry = fmt::format("<geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"{0}\"><arc curvature=\"{1:.17g}\"/></geometry>", length_m,
                              2.0 * std::numbers::pi / length_m);
  road.left = "";
  road.right = fmt::format("<lane id=\"-1\" type=\"driving\"><link><predecessor id=\"-1\"/><successor id=\"-1\"/></link>"
                           "<width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/><speed sOffset=\"0\" max=\"{}\" unit=\"m/s\"/></lane>", limit_mps);
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
    const double gap = (idm.standing_gap_m + at.speed_mps * idm.time_gap_s) / std::sqrt(1.0 - std::pow(at.speed_mps / kRingLimit_mps, 4));
    (gap < at.gap_m ? low : high) = at.speed_mps;
  }
  return at;
}

}  // namespace rodeira::traffic
