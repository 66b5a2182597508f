// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/vehicles/coachwork.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/base/constants.hpp"
#include "common/view/scene/mesh/loft.hpp"

namespace rodeira::scene {
namespace {

using Eigen::Vector3d;

constexpr Colour kPane = Colour::Of(0x20272c);
constexpr Colour kTrim = Colour::Of(0x191a1c);
constexpr Colour kChassisSteel = Colour::Of(0x6d7173);
constexpr double kProud_m = 0.012;  // how far panes stand out of the sheet

// Places by shares: along from the rear bumper (0) to the front one (1), aside of half the width, up of the height.
class Frame {
 public:
  explicit Frame(const CarShape& shape) : shape_(shape) {}

  Vector3d At(double along, double aside, double up) const {
    return {shape_.front_m - shape_.length_m * (1.0 - along), 0.5 * shape_.width_m * aside, shape_.height_m * up};
  }
  // So much of the length that a number of metres is.
  double Share(double length_m) const { return length_m / shape_.length_m; }

  // A cross-section with cut edges, counter-clockwise seen from the front.
  Ring Section(double along, double low, double top, double wide) const {
    const double cut_m = 0.06, y = 0.5 * shape_.width_m * wide, z0 = shape_.height_m * low, z1 = shape_.height_m * top,
                 x = At(along, 0.0, 0.0).x();
    return {{x, y - cut_m, z0},  {x, y, z0 + cut_m},  {x, y, z1 - cut_m},  {x, y - cut_m, z1},
            {x, -y + cut_m, z1}, {x, -y, z1 - cut_m}, {x, -y, z0 + cut_m}, {x, -y + cut_m, z0}};
  }
  Mesh Hull(const std::vector<std::array<double, 4>>& sections, Colour colour,
            Material material = Material::kCarPaint) const {
    std::vector<Ring> rings;
    for (const auto& [along, low, top, wide] : sections) rings.push_back(Section(along, low, top, wide));
    return Loft(rings, material, colour, 0.3);
  }
  Mesh BoxAt(double from, double to, double y_from, double y_to, double low, double top, Material material,
             Colour colour) const {
    return Box(At(from, std::min(y_from, y_to), low), At(to, std::max(y_from, y_to), top), material, colour);
  }
  // A pane on one side: between two places along, and two heights.
  void AddSidePanes(double from, double to, double low, double top, double wide, CarMeshes& car) const {
    const double out = kProud_m / (0.5 * shape_.width_m);
    for (const double side : {-1.0, 1.0})
      car.body.push_back(BoxAt(from, to, side * (wide - 0.05), side * (wide + out), low, top, Material::kGlass, kPane));
  }
  // A pane across the front: from its lower edge to its upper one, which may lie farther back.
  Mesh Windscreen(double along_low, double low, double along_top, double top, double wide) const {
    const Vector3d a = At(along_low, -wide, low), b = At(along_low, wide, low), c = At(along_top, wide, top),
                   d = At(along_top, -wide, top);
    const Vector3d out = kProud_m * (b - a).cross(d - a).normalized();
    return Loft({{a - 2.0 * out, b - 2.0 * out, c - 2.0 * out, d - 2.0 * out}, {a + out, b + out, c + out, d + out}},
                Material::kGlass, kPane, 0.2);
  }

 private:
  const CarShape& shape_;
};

struct LampPlaces {
  double rear_low, rear_top, front_low, front_top;  // heights, as shares
};

// Lamps in their order from the middle outward: reversing, brake, indicator behind; dipped beam, indicator before.
void AddLamps(const Frame& frame, const LampPlaces& at, CarMeshes& car) {
  const double in = frame.Share(0.05), out = frame.Share(0.015);
  for (const double side : {-1.0, 1.0}) {
    const auto rear = [&](Lamp lamp, double from, double to) {
      car.AddLamp(lamp,
                  frame.BoxAt(-out, in, side * from, side * to, at.rear_low, at.rear_top, Material::kCarLamp, {}));
    };
    const auto front = [&](Lamp lamp, double from, double to) {
      car.AddLamp(lamp, frame.BoxAt(1.0 - in, 1.0 + out, side * from, side * to, at.front_low, at.front_top,
                                    Material::kCarLamp, {}));
    };
    const Lamp indicator = side > 0.0 ? Lamp::kLeft : Lamp::kRight;
    rear(Lamp::kReversing, 0.50, 0.60);
    rear(Lamp::kBrake, 0.62, 0.78);
    rear(indicator, 0.80, 0.92);
    front(Lamp::kHead, 0.55, 0.76);
    front(indicator, 0.78, 0.90);
  }
}

// The dark under the sheet, where wheels are.
void AddArches(const CarShape& shape, CarMeshes& car) {
  for (const Vector3d& hub : shape.hubs_B) {
    Mesh arch = Disc(1.14 * shape.wheel_radius_m, 0.10, 0.01, 20, Material::kMatt, Colour::Of(0x0d0d0e));
    const double y = (hub.y() > 0.0 ? 1.0 : -1.0) * (0.5 * shape.width_m * 1.003 - 0.10);
    for (Eigen::Vector3f& p : arch.positions) p += Vector3d(hub.x(), y, hub.z()).cast<float>();
    car.body.push_back(std::move(arch));
  }
}

}  // namespace

void AddWheel(const CarShape& shape, CarMeshes& car) {
  const double half = 0.5 * shape.wheel_width_m, radius = shape.wheel_radius_m;
  car.wheel.push_back(Disc(radius, half, 0.03, 24, Material::kMatt, Colour::Of(0x1d1d1f)));
  car.wheel.push_back(Disc(0.64 * radius, half + 0.006, 0.02, 20, Material::kMatt, Colour::Of(0xa9abae)));
  for (int spoke = 0; spoke < 5; ++spoke) {  // gaps between spokes show that it turns
    const double angle = 2.0 * base::kPi * spoke / 5.0;
    Mesh gap = Disc(0.13 * radius, half + 0.009, 0.004, 8, Material::kMatt, Colour::Of(0x2a2b2d));
    for (Eigen::Vector3f& p : gap.positions)
      p += (0.42 * radius * Vector3d(std::sin(angle), 0.0, std::cos(angle))).cast<float>();
    car.wheel.push_back(std::move(gap));
  }
}

CarMeshes BuildVan(const CarShape& shape, Colour paint) {
  CarMeshes car;
  const Frame frame(shape);
  car.body.push_back(frame.Hull({{0.0, 0.14, 0.97, 0.94},
                                 {0.02, 0.11, 0.99, 0.97},
                                 {0.10, 0.10, 1.0, 1.0},
                                 {0.66, 0.10, 1.0, 1.0},
                                 {0.745, 0.10, 0.965, 0.99},
                                 {0.865, 0.10, 0.60, 0.97},
                                 {0.97, 0.12, 0.50, 0.93},
                                 {1.0, 0.17, 0.42, 0.84}},
                                paint));
  car.body.push_back(frame.Windscreen(0.862, 0.62, 0.762, 0.93, 0.84));
  frame.AddSidePanes(0.66, 0.775, 0.60, 0.86, 0.985, car);
  for (const double side : {-1.0, 1.0}) {
    car.body.push_back(frame.BoxAt(-0.003, 0.01, side * 0.08, side * 0.74, 0.62, 0.86, Material::kGlass, kPane));
    car.frame.push_back(frame.BoxAt(0.80, 0.83, side * 0.97, side * 1.14, 0.58, 0.70, Material::kMatt, kTrim));
  }
  car.body.push_back(frame.BoxAt(-0.006, 0.02, -0.90, 0.90, 0.15, 0.21, Material::kMatt, kTrim));
  car.body.push_back(frame.BoxAt(0.98, 1.004, -0.55, 0.55, 0.20, 0.30, Material::kMatt, kTrim));
  AddLamps(frame, {0.34, 0.50, 0.33, 0.40}, car);
  AddArches(shape, car);
  AddWheel(shape, car);
  return car;
}

CarMeshes BuildLorry(const CarShape& shape, Colour paint) {
  CarMeshes car;
  const Frame frame(shape);
  const double cab = 1.0 - frame.Share(1.75), gap = frame.Share(0.12);
  car.body.push_back(frame.Hull({{cab, 0.22, 0.86, 0.96},
                                 {cab + gap, 0.20, 0.88, 0.98},
                                 {1.0 - frame.Share(0.25), 0.12, 0.87, 0.98},
                                 {1.0 - frame.Share(0.03), 0.10, 0.56, 0.97},
                                 {1.0, 0.11, 0.52, 0.94}},
                                paint));
  car.body.push_back(frame.Windscreen(1.0 - frame.Share(0.035), 0.54, 1.0 - frame.Share(0.20), 0.80, 0.88));
  frame.AddSidePanes(cab + frame.Share(0.75), 1.0 - frame.Share(0.34), 0.55, 0.76, 0.975, car);
  car.body.push_back(frame.BoxAt(0.0, cab - gap, -1.0, 1.0, 0.31, 1.0, Material::kMatt,
                                 Mix(paint, Colour::Of(0xe8e8e4), 0.75)));  // the box with the load
  car.body.push_back(frame.BoxAt(0.01, cab, -0.42, 0.42, 0.17, 0.31, Material::kMatt, kChassisSteel));
  car.body.push_back(frame.BoxAt(0.003, 0.02, -0.92, 0.92, 0.13, 0.17, Material::kMatt,
                                 kChassisSteel));  // what keeps cars from going below
  car.body.push_back(frame.BoxAt(0.99, 1.003, -0.70, 0.70, 0.24, 0.40, Material::kMatt, kTrim));
  for (const double side : {-1.0, 1.0})
    car.frame.push_back(frame.BoxAt(0.985, 0.998, side * 0.99, side * 1.14, 0.52, 0.72, Material::kMatt, kTrim));
  AddLamps(frame, {0.18, 0.235, 0.15, 0.21}, car);
  AddWheel(shape, car);
  return car;
}

CarMeshes BuildBus(const CarShape& shape, Colour paint) {
  CarMeshes car;
  const Frame frame(shape);
  car.body.push_back(frame.Hull({{0.0, 0.13, 0.96, 0.97},
                                 {0.008, 0.10, 0.985, 0.99},
                                 {0.03, 0.09, 1.0, 1.0},
                                 {0.965, 0.09, 1.0, 1.0},
                                 {0.99, 0.10, 0.97, 0.98},
                                 {1.0, 0.13, 0.92, 0.96}},
                                paint));
  car.body.push_back(frame.Windscreen(1.0, 0.42, 1.0, 0.86, 0.88));
  car.body.push_back(frame.BoxAt(-0.002, 0.004, -0.8, 0.8, 0.52, 0.80, Material::kGlass, kPane));
  const int panes = std::max(3, static_cast<int>(std::lround(shape.length_m / 1.6)));
  for (int pane = 0; pane < panes; ++pane) {
    const double from = 0.035 + 0.93 * pane / panes, to = 0.035 + 0.93 * (pane + 0.94) / panes;
    frame.AddSidePanes(from, to, 0.46, 0.80, 1.0, car);
  }
  for (const double along : {0.30, 0.86})
    car.body.push_back(
        frame.BoxAt(along, along + frame.Share(1.2), -1.004, -0.95, 0.12, 0.80, Material::kGlass, kPane));  // doors
  for (const double side : {-1.0, 1.0})
    car.frame.push_back(
        frame.BoxAt(0.99, 1.0 + frame.Share(0.1), side * 0.97, side * 1.12, 0.62, 0.80, Material::kMatt, kTrim));
  AddLamps(frame, {0.20, 0.30, 0.20, 0.26}, car);
  AddArches(shape, car);
  AddWheel(shape, car);
  return car;
}

}  // namespace rodeira::scene
