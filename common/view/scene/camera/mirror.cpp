// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/camera/mirror.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/constants.hpp"

namespace rodeira::scene {
namespace {

using Eigen::Vector3d;

constexpr double kOutward_rad = 8.0 * base::kRadiansPerDegree;
constexpr double kOuterLook_rad = 45.0 * base::kRadiansPerDegree,
                 kInsideLook_rad = -5.0 * base::kRadiansPerDegree;  // of the driver, positive to the left
constexpr double kInsideView_rad = 38.0 * base::kRadiansPerDegree, kOuterView_rad = 26.0 * base::kRadiansPerDegree;

constexpr double kMirrorMargin = 0.012;  // between a picture's edge and a mirror, of the picture's width

double SideOf(Mirror mirror) { return mirror == Mirror::kLeft ? 1.0 : mirror == Mirror::kRight ? -1.0 : 0.0; }

// Its middle on the car.
Vector3d MirrorAt_B(const Body& car, Mirror mirror) {
  const bool inside = mirror == Mirror::kInside;
  return {car.front_m - (inside ? 0.47 : 0.33) * car.length_m, SideOf(mirror) * (0.5 * car.width_m + 0.12),
          (inside ? 0.90 : 0.69) * car.height_m};
}

}  // namespace

std::string_view NameOf(Mirror mirror) {
  return mirror == Mirror::kLeft ? "left" : mirror == Mirror::kRight ? "right" : "inside";
}

std::optional<Mirror> MirrorOf(std::string_view name) {
  for (const Mirror mirror : kAllMirrors) {
    if (NameOf(mirror) == name) return mirror;
  }
  return std::nullopt;
}

std::array<bool, kMirrors> MirrorsOn(std::span<const ScreenPlane> screens, std::size_t which) {
  std::array<bool, kMirrors> on{};
  for (const Mirror mirror : kAllMirrors) {
    const double look_rad = mirror == Mirror::kInside ? kInsideLook_rad : SideOf(mirror) * kOuterLook_rad;
    const auto away_rad = [look_rad](const ScreenPlane& screen) {
      const double middle_rad = screen.angle_rad - std::atan2(screen.aside_m, screen.distance_m);
      return std::fabs(std::remainder(middle_rad - look_rad, 2.0 * base::kPi));
    };
    const auto nearest = std::ranges::min_element(screens, {}, away_rad);
    on[static_cast<std::size_t>(mirror)] = nearest - screens.begin() == static_cast<std::ptrdiff_t>(which);
  }
  return on;
}

double ShapeOf(Mirror mirror) { return mirror == Mirror::kInside ? 3.6 : 1.5; }

Camera MirrorCamera(const Body& car, Mirror mirror) {
  const double side = SideOf(mirror);
  const bool inside = mirror == Mirror::kInside;
  const Vector3d back_B(-std::cos(kOutward_rad * side), std::sin(kOutward_rad * side), inside ? -0.02 : -0.06);
  Camera camera =
      LookFrom(car.p_WB_W + car.q_WB * MirrorAt_B(car, mirror), car.q_WB * back_B, car.q_WB * Vector3d::UnitZ(), 0.0);
  const double half = std::tan(0.5 * (inside ? kInsideView_rad : kOuterView_rad)), half_high = half / ShapeOf(mirror);
  camera.window = Camera::Window{-half, half, -half_high, half_high};
  camera.vertical_view_rad = 2.0 * std::atan(half_high);
  return camera;
}

MirrorPlace PlaceOf(Mirror mirror, double aspect) {
  const double wide = mirror == Mirror::kInside ? 0.26 : 0.17, high = wide * aspect / ShapeOf(mirror);
  switch (mirror) {
    case Mirror::kLeft:
      return {kMirrorMargin, 0.30, kMirrorMargin + wide, 0.30 + high};
    case Mirror::kRight:
      return {1.0 - kMirrorMargin - wide, 0.30, 1.0 - kMirrorMargin, 0.30 + high};
    case Mirror::kInside:
      break;
  }
  return {0.56, 1.0 - kMirrorMargin * aspect - high, 0.56 + wide, 1.0 - kMirrorMargin * aspect};
}

MirrorPlace PlaceOn(const ScreenPlane& screen, const Body& car, Mirror mirror, double aspect) {
  const MirrorPlace usual = PlaceOf(mirror, aspect);
  const Camera camera = ScreenCamera(car, screen);
  const auto seen = camera.Project(car.p_WB_W + car.q_WB * MirrorAt_B(car, mirror), 1, 1);
  if (mirror == Mirror::kInside || !seen) return usual;
  const double wide = usual.right - usual.left, high = usual.high - usual.low;
  const double left = std::clamp(seen->x() - 0.5 * wide, kMirrorMargin, 1.0 - kMirrorMargin - wide);
  const double low =
      std::clamp(1.0 - seen->y() - 0.5 * high, kMirrorMargin * aspect, 1.0 - kMirrorMargin * aspect - high);
  return {left, low, left + wide, low + high};
}

}  // namespace rodeira::scene
