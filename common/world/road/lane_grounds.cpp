// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/lane_grounds.hpp"

#include <limits>

namespace rodeira::road {
namespace {

ground::Surface SurfaceOf(network::LaneType type) {
  switch (type) {
    case network::LaneType::kNone:
    case network::LaneType::kMedian:
      return ground::Surface::kGrass;
    case network::LaneType::kSidewalk:
    case network::LaneType::kWalking:
    case network::LaneType::kCurb:
      return ground::Surface::kConcrete;
    default:
      return ground::Surface::kAsphalt;
  }
}

ground::Surface SurfaceOf(const network::LaneMaterial& material, network::LaneType type) {
  for (const ground::Surface known : {ground::Surface::kAsphalt, ground::Surface::kConcrete, ground::Surface::kGravel,
                                      ground::Surface::kGrass, ground::Surface::kSoil}) {
    if (material.surface == SurfaceName(known)) return known;
  }
  return SurfaceOf(type);
}

}  // namespace

LaneGrounds::LaneGrounds(const network::Network& network, const FrictionTable& friction) {
  const auto usual = [&](ground::Surface surface) { return friction[static_cast<std::size_t>(surface)]; };
  const auto add = [&](const network::Lane& lane) {
    first_.push_back(grounds_.size());
    const ground::Surface surface = SurfaceOf(lane.type);
    grounds_.push_back({-std::numeric_limits<double>::infinity(), surface, usual(surface)});
    for (const network::LaneMaterial& material : lane.materials) {
      const ground::Surface named = SurfaceOf(material, lane.type);
      grounds_.push_back({material.s_m, named, material.friction.value_or(usual(named))});
    }
  };
  // In the order of the lanes' numbers: by road, section, and from the right to the left.
  for (const network::Road& road : network.roads()) {
    for (const network::LaneSection& section : road.spec().sections) {
      for (auto lane = section.right.rbegin(); lane != section.right.rend(); ++lane) add(*lane);
      add(section.centre);
      for (const network::Lane& lane : section.left) add(lane);
    }
  }
  first_.push_back(grounds_.size());
}

}  // namespace rodeira::road
