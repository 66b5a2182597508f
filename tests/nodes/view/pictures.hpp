// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "common/view/scene/camera/camera.hpp"
#include "common/world/road/road.hpp"
#include "common/world/road/world.hpp"
#include "nodes/view/frame/picture.hpp"
#include "nodes/view/renderer/renderer.hpp"
#include "tests/nodes/view/read_png.hpp"

namespace rodeira::nodes {

// Empty where pictures can be drawn here; otherwise why not.
inline std::string WhyNoPictures() {
  static const std::string why = [] {
    const auto surface = Surface::Open(SurfaceKind::kOffscreen, 64, 64, "test");
    return surface.ok() ? std::string() : surface.error().Text();
  }();
  return why;
}
#define RODEIRA_NEEDS_PICTURES() \
  if (!WhyNoPictures().empty()) GTEST_SKIP() << "no OpenGL here: " << WhyNoPictures()

// The mean colour of the pixels around a place: robust against one edge pixel.
struct Probe {
  double red = 0.0, green = 0.0, blue = 0.0;

  bool operator==(const Probe&) const = default;

  bool IsSky() const { return blue > red + 8.0 && blue > 150.0; }
  bool IsAsphalt() const {
    return std::max({red, green, blue}) - std::min({red, green, blue}) < 22.0 && green > 45.0 && green < 160.0;
  }
  bool IsWhite() const { return std::min({red, green, blue}) > 165.0; }
  bool IsYellow() const { return red > 150.0 && green > 110.0 && blue < 0.6 * red; }
  bool IsGrown() const { return green > 1.25 * blue && red < 1.2 * green && green > 50.0; }  // meadows, dry ones too
  bool IsRed() const { return red > 60.0 && red > 1.8 * green && red > 1.8 * blue; }
  bool IsBlue() const { return blue > 1.25 * red && blue > 1.1 * green; }
};
inline std::ostream& operator<<(std::ostream& out, const Probe& p) {
  return out << "(" << p.red << ", " << p.green << ", " << p.blue << ")";
}

inline Probe ProbeAt(const Image& image, double x_px, double y_px, int around = 1) {
  Probe probe;
  int count = 0;
  for (int dy = -around; dy <= around; ++dy) {
    for (int dx = -around; dx <= around; ++dx) {
      const int x = static_cast<int>(x_px) + dx, y = static_cast<int>(y_px) + dy;
      if (x < 0 || y < 0 || x >= image.width_px || y >= image.height_px) continue;
      const std::uint8_t* pixel = image.At(x, y);
      probe.red += pixel[0];
      probe.green += pixel[1];
      probe.blue += pixel[2];
      ++count;
    }
  }
  if (count == 0) return probe;
  return {probe.red / count, probe.green / count, probe.blue / count};
}
// Where a point of the world is seen.
inline Probe ProbeAt(const Image& image, const scene::Camera& camera, const Eigen::Vector3d& p_W, int around = 1) {
  const auto at = camera.Project(p_W, image.width_px, image.height_px);
  EXPECT_TRUE(at.has_value());
  return at ? ProbeAt(image, at->x(), at->y(), around) : Probe{};
}

inline scene::CarPose CarAt(const Eigen::Vector3d& p_W, double heading_rad, double pitch_rad = 0.0) {
  scene::CarPose car;
  car.p_WB_W = p_W;
  car.q_WB = scene::Attitude(heading_rad, pitch_rad, 0.0);
  for (std::size_t i = 0; i < 4; ++i) car.wheels[i].hub_B = {i < 2 ? 1.23 : -1.23, i % 2 == 0 ? 0.71 : -0.71, 0.2915};
  return car;
}

inline scene::CarPose CarOn(const road::Road& road, double s_m, double t_m) {
  const road::RoadFrame frame = road.Evaluate(s_m);
  return CarAt(road.Position(s_m, t_m), frame.heading_rad, -std::atan(frame.grade));
}

}  // namespace rodeira::nodes
