// SPDX-License-Identifier: Apache-2.0
#include "common/world/weather/wet_ground.hpp"

namespace rodeira::weather {

using ground::Surface;

double FrictionLeft(Surface surface) {
  switch (surface) {
    case Surface::kAsphalt:
      return 0.70;
    case Surface::kConcrete:
      return 0.70;
    case Surface::kGravel:
      return 0.85;
    case Surface::kGrass:
      return 0.55;
    case Surface::kSoil:
      return 0.55;
    case Surface::kRoadMark:
      return 0.50;
    case Surface::kOutside:
      break;
  }
  return 1.0;
}

void WetGround::Query(std::span<const ground::GroundQuery> queries, std::span<ground::GroundPoint> points) {
  dry_.Query(queries, points);
  if (wetness_ <= 0.0) return;
  for (ground::GroundPoint& point : points) point.friction *= 1.0 - wetness_ * (1.0 - FrictionLeft(point.surface));
}

}  // namespace rodeira::weather
