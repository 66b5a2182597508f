// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/vehicles/person_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/constants.hpp"
#include "common/view/scene/mesh/loft.hpp"

namespace rodeira::scene {
namespace {

using Eigen::Vector3d;

constexpr Colour kSkin = Colour::Of(0xc99b7a);
constexpr Colour kHair = Colour::Of(0x3a2c20);
constexpr Colour kTrousers = Colour::Of(0x2c3444);
constexpr double kMaxSwing_rad = 0.55;

// An upright body of eight-sided rings, each a height with half its depth and half its width; from below.
Mesh Turned(const std::vector<std::array<double, 3>>& rings_m, Colour colour) {
  std::vector<Ring> rings;
  for (const auto& [z, deep, wide] : rings_m) {
    Ring ring;
    for (int k = 0; k < 8; ++k) {
      const double angle = 2.0 * base::kPi * k / 8.0;
      ring.emplace_back(deep * std::cos(angle), wide * std::sin(angle), z);
    }
    rings.push_back(std::move(ring));
  }
  return Loft(rings, Material::kMatt, colour, 1.0);
}

}  // namespace

PersonMeshes BuildPerson(double height_m, Colour clothes) {
  const double h = height_m, leg = LegLength_m(h);
  PersonMeshes person;
  person.trunk = Turned({{0.46 * h, 0.06 * h, 0.085 * h},
                         {0.53 * h, 0.065 * h, 0.095 * h},
                         {0.62 * h, 0.055 * h, 0.085 * h},
                         {0.76 * h, 0.065 * h, 0.115 * h},
                         {0.82 * h, 0.04 * h, 0.09 * h},
                         {0.835 * h, 0.03 * h, 0.04 * h}},
                        clothes);
  person.trunk.Append(Turned(
      {{0.82 * h, 0.028 * h, 0.028 * h}, {0.875 * h, 0.045 * h, 0.038 * h}, {0.93 * h, 0.055 * h, 0.045 * h}}, kSkin));
  person.trunk.Append(Turned(
      {{0.93 * h, 0.056 * h, 0.046 * h}, {0.97 * h, 0.052 * h, 0.043 * h}, {1.0 * h, 0.02 * h, 0.018 * h}}, kHair));
  Mesh leg_mesh = Turned(
      {{-leg, 0.028 * h, 0.024 * h}, {-0.52 * leg, 0.032 * h, 0.03 * h}, {0.06 * leg, 0.055 * h, 0.05 * h}}, kTrousers);
  leg_mesh.Append(Box({-0.03 * h, -0.024 * h, -leg}, {0.105 * h, 0.024 * h, -leg + 0.035 * h}, Material::kMatt,
                      Colour::Of(0x241f1c)));  // shoe
  Mesh arm =
      Turned({{-0.33 * h, 0.018 * h, 0.018 * h}, {-0.16 * h, 0.022 * h, 0.022 * h}, {0.02 * h, 0.032 * h, 0.03 * h}},
             Shade(clothes, 0.9));
  arm.Append(Turned({{-0.385 * h, 0.014 * h, 0.012 * h}, {-0.33 * h, 0.02 * h, 0.016 * h}}, kSkin));
  for (std::size_t i = 0; i < 4; ++i) {
    const bool is_leg = i < 2;
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    person.limbs[i] = {{0.0, side * (is_leg ? 0.05 : 0.135) * h, is_leg ? leg : 0.79 * h},
                       side * (is_leg ? 1.0 : -0.7),
                       is_leg ? leg_mesh : arm};
  }
  return person;
}

double LegSwing_rad(double wheel_spin_rad, double wheel_radius_m, double leg_m) {
  // Feet that do not slide part by a step, half a turn of the wheel, when the swing is greatest.
  const double step_m = base::kPi * wheel_radius_m;
  const double most = std::min(kMaxSwing_rad, std::asin(std::clamp(0.5 * step_m / leg_m, 0.0, 1.0)));
  return most * std::sin(wheel_spin_rad);
}

}  // namespace rodeira::scene
