// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/vehicles/cabin.hpp"

#include <cmath>

#include "common/core/base/constants.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/view/scene/mesh/loft.hpp"

namespace rodeira::scene {
namespace {

using Eigen::Vector3d;

constexpr double kInstruments_m = 0.52;  // ahead of the eye
constexpr double kInstrumentsLean_rad = 18.0 * base::kRadiansPerDegree;
constexpr double kTube_m = 0.013;  // radius of the rim's section
constexpr double kMark_rad = 5.0 * base::kRadiansPerDegree;
constexpr Colour kDash = Colour::Of(0x24262a), kHousing = Colour::Of(0x191b1e), kWheelRim = Colour::Of(0x15161a),
                 kMark = Colour::Of(0xf0f0f0);

CabinDial DialAt(const Dial& dial, double left_m, double down_m, double radius_m) {
  return {dial, {{kInstruments_m, left_m, -down_m}, kInstrumentsLean_rad}, radius_m};
}

}  // namespace

Vector3d CabinPose::ToE(const Vector3d& p) const {
  const double c = std::cos(leaning_rad), s = std::sin(leaning_rad);
  const Vector3d right(0.0, -1.0, 0.0), up(s, 0.0, c), out(-c, 0.0, s);
  return middle_E + p.x() * right + p.y() * up + p.z() * out;
}

const std::array<CabinDial, 3>& CabinDials() {
  static const std::array<CabinDial, 3> kDials = {DialAt(kSpeedDial, -0.080, 0.198, 0.052),
                                                  DialAt(kEngineDial, 0.080, 0.198, 0.052),
                                                  DialAt(kFuelDial, 0.0, 0.222, 0.026)};
  return kDials;
}

Vector3d NeedleEnd_E(const CabinDial& dial, double value) {
  const double angle = NeedleAngle_rad(dial.dial, value), reach_m = 0.86 * dial.radius_m;
  return dial.place.ToE({reach_m * std::cos(angle), reach_m * std::sin(angle), 0.002});
}

CabinPose GearPlace() { return {{kInstruments_m - 0.002, 0.0, -0.172}, kInstrumentsLean_rad}; }

CabinPose WheelPlace() { return {{0.40, 0.0, -0.285}, 25.0 * base::kRadiansPerDegree}; }

Vector3d WheelMark_E(double steering_wheel_rad) {
  const double angle = 0.5 * base::kPi + steering_wheel_rad;
  return WheelPlace().ToE({kWheelRadius_m * std::cos(angle), kWheelRadius_m * std::sin(angle), kTube_m});
}

Mesh BuildSteeringWheel() {
  Mesh mesh;
  mesh.material = Material::kMatt;
  constexpr int kAround = 144, kSection = 10;  // 2.5 degrees each: the mark ends between two
  const auto add = [&](int i, int k, Colour colour) {
    const double angle = 2.0 * base::kPi * i / kAround, turn = 2.0 * base::kPi * k / kSection;
    const Vector3d out(std::cos(angle), std::sin(angle), 0.0),
        normal = std::cos(turn) * out + std::sin(turn) * Vector3d::UnitZ();
    return mesh.Add(kWheelRadius_m * out + kTube_m * normal, normal, colour);
  };
  for (int i = 0; i < kAround; ++i) {
    const double middle = 2.0 * base::kPi * (i + 0.5) / kAround;
    const Colour colour = std::fabs(geometry::WrapAngle(middle - 0.5 * base::kPi)) < kMark_rad ? kMark : kWheelRim;
    for (int k = 0; k < kSection; ++k) {
      const std::uint32_t a = add(i, k, colour), b = add(i + 1, k, colour), c = add(i + 1, k + 1, colour),
                          d = add(i, k + 1, colour);
      mesh.AddTriangle(a, b, c);
      mesh.AddTriangle(a, c, d);
    }
  }
  mesh.Append(
      Box({-kWheelRadius_m, -0.022, -0.02}, {kWheelRadius_m, 0.018, -0.004}, Material::kMatt, kWheelRim));  // spokes
  mesh.Append(Box({-0.022, -kWheelRadius_m, -0.02}, {0.022, 0.0, -0.004}, Material::kMatt, kWheelRim));
  mesh.Append(Box({-0.06, -0.05, -0.025}, {0.06, 0.045, 0.005}, Material::kMatt, kHousing));  // hub
  return mesh;
}

Mesh BuildDashboard(double car_width_m, double eye_left_m) {
  const double half_m = 0.5 * car_width_m - 0.05, left = half_m - eye_left_m,
               right = -half_m - eye_left_m;  // from door to door
  const auto slice = [&](double ahead_m, double top) {
    return std::vector<Vector3d>{
        {ahead_m, right, -0.80}, {ahead_m, left, -0.80}, {ahead_m, left, top}, {ahead_m, right, top}};
  };
  Mesh mesh = Loft({slice(0.55, -0.345), slice(0.585, -0.312), slice(0.72, -0.292), slice(0.86, -0.302)},
                   Material::kMatt, kDash, 0.2);
  // The housing around the dials; behind its edge it falls away, so that no more is seen of it.
  const auto ring = [](double ahead_m, double grown_m, double top) {
    const auto corner = [&](double y, double z) { return Vector3d(ahead_m, y, z); };
    const double wide_left = 0.145 + grown_m, wide_right = -0.145 - grown_m, low = -0.32;
    return std::vector<Vector3d>{corner(wide_right, low),        corner(wide_left, low),
                                 corner(wide_left, top - 0.03),  corner(wide_left - 0.03, top),
                                 corner(wide_right + 0.03, top), corner(wide_right, top - 0.03)};
  };
  mesh.Append(
      Loft({ring(kInstruments_m + 0.045, 0.0, -0.128), ring(0.78, 0.01, -0.19)}, Material::kMatt, kHousing, 0.4));
  return mesh;
}

}  // namespace rodeira::scene
