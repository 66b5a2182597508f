// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "common/world/network/network.hpp"

// How what stands on a road passes into nothing at its ends and at the road's edges.
namespace rodeira::road {

constexpr double kFadesAlong_m = 1.0, kFadesAcross_m = 0.5;

// The fade at a distance from where there is nothing: 3 u^2 - 2 u^3, and its slope by that distance.
std::pair<double, double> FadeAt(double distance_m, double over_m);

// A factor between 0 and 1 with its derivatives by s and t.
struct Share {
  double value = 1.0, by_s = 0.0, by_t = 0.0;

  Share operator*(const Share& other) const;
  // This one where `weight` is 1, the other where it is 0.
  Share Mixed(const Share& other, double weight, double weight_by_s) const;
};

// A height over a road with its derivatives by s and t.
struct Raised {
  double z_m = 0.0, by_s = 0.0, by_t = 0.0;

  // Multiplies the height, derivatives by the product rule.
  void Fade(const Share& share);
  void operator+=(const Raised& other) { z_m += other.z_m, by_s += other.by_s, by_t += other.by_t; }
  // Of what is laid instead of the road: over its surface.
  void Replace(const network::SurfaceSample& sample);
};

// A road's outermost edges at s, and how they move with it.
struct RoadEdges {
  double right_m = 0.0, right_slope = 0.0, left_m = 0.0, left_slope = 0.0;

  RoadEdges() = default;
  RoadEdges(const network::Road& road, const network::LaneSection& section, double s_m);
  // To nothing at either edge.
  Share FromLeft(double t_m) const;
  // The same from the right edge, each over kFadesAcross_m.
  Share FromRight(double t_m) const;
};

}  // namespace rodeira::road
