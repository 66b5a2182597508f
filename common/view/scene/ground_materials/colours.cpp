// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/ground_materials/colours.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/random.hpp"

namespace rodeira::scene {
namespace {

double Corner(double column, double row, std::uint64_t seed) {
  return base::RandomUniform({seed, static_cast<std::uint64_t>(static_cast<std::int64_t>(column)),
                              static_cast<std::uint64_t>(static_cast<std::int64_t>(row))},
                             -1.0, 1.0);
}

double Ease(double u) { return u * u * (3.0 - 2.0 * u); }

}  // namespace

Colour SurfaceColour(ground::Surface surface) {
  switch (surface) {
    case ground::Surface::kOutside:
      return Colour::Of(0x6e6a62);
    case ground::Surface::kAsphalt:
      return Colour::Of(0x5d5e61);
    case ground::Surface::kConcrete:
      return Colour::Of(0xa19d93);
    case ground::Surface::kGravel:
      return Colour::Of(0x958a76);
    case ground::Surface::kGrass:
      return Colour::Of(0x6e7c40);
    case ground::Surface::kSoil:
      return Colour::Of(0x8d6f4d);
    case ground::Surface::kRoadMark:
      return Colour::Of(0xe8e8e4);
  }
  return {};
}

double SmoothNoise(double x_m, double y_m, double wavelength_m, std::uint64_t seed) {
  const double x = x_m / wavelength_m, y = y_m / wavelength_m;
  const double column = std::floor(x), row = std::floor(y);
  const double u = Ease(x - column), v = Ease(y - row);
  const double south = Corner(column, row, seed) * (1.0 - u) + Corner(column + 1.0, row, seed) * u;
  const double north = Corner(column, row + 1.0, seed) * (1.0 - u) + Corner(column + 1.0, row + 1.0, seed) * u;
  return south * (1.0 - v) + north * v;
}

Colour GroundColour(ground::Surface surface, double x_m, double y_m, const Eigen::Vector3d& normal_W) {
  const Colour own = SurfaceColour(surface);
  const double fine = SmoothNoise(x_m, y_m, 35.0, 2);
  if (surface != ground::Surface::kGrass) return Shade(own, 1.0 + 0.04 * fine);
  const double broad = 0.7 * SmoothNoise(x_m, y_m, 420.0, 1) + 0.45 * SmoothNoise(x_m, y_m, 120.0, 3);
  const Colour meadow = broad > 0.0 ? Mix(own, Colour::Of(0x968c50), std::min(broad, 1.0))
                                    : Mix(own, Colour::Of(0x4f6434), std::min(-broad, 1.0));
  const double steep = std::clamp((0.90 - normal_W.z()) / 0.16, 0.0, 1.0);  // from 26 to 42 degrees
  return Shade(Mix(meadow, Colour::Of(0x86745a), 0.85 * Ease(steep)), 1.0 + 0.10 * fine);
}

}  // namespace rodeira::scene
