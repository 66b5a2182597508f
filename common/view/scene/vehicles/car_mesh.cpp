// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/vehicles/car_mesh.hpp"

#include <algorithm>

#include "common/view/scene/mesh/loft.hpp"
#include "common/view/scene/vehicles/coachwork.hpp"

namespace rodeira::scene {
namespace {

using Eigen::Vector3d;

constexpr double kCrease_rad = 0.6;
constexpr Colour kGlassColour = Colour::Of(0x20272c);
constexpr Colour kTrimColour = Colour::Of(0x191a1c);

// Shares of the car's measures: along from the rear to the front, heights of the whole, widths of half the width.
class CarBody {
 public:
  explicit CarBody(const CarShape& shape) : shape_(shape), half_m_(0.5 * shape.width_m) {}

  double X(double along) const { return shape_.front_m - shape_.length_m * (1.0 - along); }
  double Y(double aside) const { return half_m_ * aside; }
  double Z(double up) const { return shape_.height_m * up; }

  // One cross-section of the lower body, counter-clockwise seen from the front.
  Ring Section(double along, double low, double top, double wide) const {
    static constexpr double kSide[][2] = {{0.86, 0.0},   {0.965, 0.10}, {1.0, 0.42},
                                          {0.985, 0.72}, {0.94, 0.90},  {0.82, 0.99}};  // out, up
    Ring ring;
    const auto point = [&](double out, double up) {
      ring.emplace_back(X(along), Y(wide * out), Z(low + (top - low) * up));
    };
    for (const auto& [out, up] : kSide) point(out, up);
    point(0.0, 1.03);
    for (std::size_t k = std::size(kSide); k-- > 0;) point(-kSide[k][0], kSide[k][1]);
    return ring;
  }

  // An oblong at one height with cut corners, counter-clockwise seen from above.
  Ring Oblong(double rear, double front, double wide, double cut_m, double up) const {
    const double x0 = X(rear), x1 = X(front), y = Y(wide), c = cut_m, z = Z(up);
    return {{x0 + c, -y, z},      {x1 - 1.6 * c, -y, z}, {x1, -y + 1.6 * c, z}, {x1, y - 1.6 * c, z},
            {x1 - 1.6 * c, y, z}, {x0 + c, y, z},        {x0, y - c, z},        {x0, -y + c, z}};
  }

  Mesh BoxAt(double from, double to, double y_from, double y_to, double low, double top, Material material,
             Colour colour) const {
    return Box({X(from), std::min(Y(y_from), Y(y_to)), Z(low)}, {X(to), std::max(Y(y_from), Y(y_to)), Z(top)}, material,
               colour);
  }

  // A post from the waist to the roof.
  Mesh Pillar(double along_low, double wide_low, double along_top, double wide_top, double size_m,
              Colour colour) const {
    std::vector<Ring> rings;
    const double h = 0.5 * size_m;
    for (const auto& [along, wide, up] :
         {std::tuple(along_low, wide_low, 0.64), std::tuple(along_top, wide_top, 0.965)}) {
      const double x = X(along), y = Y(wide), z = Z(up);
      rings.push_back({{x - h, y - h, z}, {x + h, y - h, z}, {x + h, y + h, z}, {x - h, y + h, z}});
    }
    return Loft(rings, Material::kCarPaint, colour, 0.2);
  }

 private:
  const CarShape& shape_;
  double half_m_;
};

void AddPaintedBody(const CarBody& body, Colour paint, CarMeshes& car) {
  static constexpr double kSections[][4] = {
      // along, low, top, wide
      {0.000, 0.36, 0.60, 0.82}, {0.010, 0.30, 0.66, 0.90}, {0.04, 0.23, 0.71, 0.96},  {0.13, 0.17, 0.715, 1.0},
      {0.35, 0.16, 0.69, 1.0},   {0.60, 0.16, 0.66, 1.0},   {0.73, 0.16, 0.635, 0.99}, {0.84, 0.17, 0.59, 0.97},
      {0.93, 0.20, 0.535, 0.92}, {0.975, 0.25, 0.49, 0.84}, {0.993, 0.30, 0.45, 0.76}, {1.0, 0.34, 0.42, 0.70}};
  std::vector<Ring> rings;
  for (const auto& [along, low, top, wide] : kSections) rings.push_back(body.Section(along, low, top, wide));
  car.body.push_back(Loft(rings, Material::kCarPaint, paint, kCrease_rad));
  const std::vector<Ring> roof = {body.Oblong(0.125, 0.545, 0.745, 0.07, 0.945),
                                  body.Oblong(0.13, 0.54, 0.735, 0.08, 0.968),
                                  body.Oblong(0.16, 0.51, 0.66, 0.10, 0.992), body.Oblong(0.22, 0.45, 0.45, 0.12, 1.0)};
  car.body.push_back(Loft(roof, Material::kCarPaint, paint, kCrease_rad));
  for (const double side : {-1.0, 1.0}) {
    car.frame.push_back(body.Pillar(0.705, side * 0.865, 0.512, side * 0.70, 0.055, paint));
    car.frame.push_back(body.Pillar(0.385, side * 0.905, 0.36, side * 0.725, 0.06, kTrimColour));
    car.frame.push_back(body.Pillar(0.055, side * 0.85, 0.155, side * 0.68, 0.10, paint));
    car.frame.push_back(
        body.BoxAt(0.655, 0.695, side * 0.97, side * 1.11, 0.655, 0.725, Material::kCarPaint, paint));  // mirror
  }
}

void AddGlass(const CarBody& body, CarMeshes& car) {
  const std::vector<Ring> cabin = {body.Oblong(0.035, 0.75, 0.90, 0.07, 0.62),
                                   body.Oblong(0.075, 0.665, 0.845, 0.08, 0.76),
                                   body.Oblong(0.135, 0.54, 0.725, 0.09, 0.955)};
  car.body.push_back(Loft(cabin, Material::kGlass, kGlassColour, 0.45));
}

void AddTrim(const CarBody& body, const CarShape& shape, CarMeshes& car) {
  car.body.push_back(body.BoxAt(0.985, 1.002, -0.5, 0.5, 0.33, 0.385, Material::kMatt, kTrimColour));    // grille
  car.body.push_back(body.BoxAt(-0.004, 0.02, -0.72, 0.72, 0.30, 0.375, Material::kMatt, kTrimColour));  // rear bumper
  car.body.push_back(
      body.BoxAt(-0.006, 0.01, -0.31, 0.31, 0.455, 0.525, Material::kMatt, Colour::Of(0xe6e6e0)));  // plate
  for (const double side : {-1.0, 1.0}) {
    const auto lamp = [&](Lamp which, double from, double to, double y_from, double y_to, double low, double top) {
      car.AddLamp(which, body.BoxAt(from, to, side * y_from, side * y_to, low, top, Material::kCarLamp, {}));
    };
    const Lamp indicator = side > 0.0 ? Lamp::kLeft : Lamp::kRight;
    lamp(Lamp::kHead, 0.955, 0.992, 0.46, 0.76, 0.425, 0.485);
    lamp(indicator, 0.930, 0.985, 0.77, 0.88, 0.425, 0.485);
    lamp(Lamp::kBrake, -0.003, 0.028, 0.60, 0.90, 0.545, 0.625);
    lamp(indicator, -0.003, 0.028, 0.72, 0.90, 0.475, 0.540);
    lamp(Lamp::kReversing, -0.003, 0.028, 0.56, 0.71, 0.475, 0.540);
  }
  for (const Vector3d& hub : shape.hubs_B) {  // the dark of the wheel arches
    Mesh arch = Disc(1.16 * shape.wheel_radius_m, 0.10, 0.01, 24, Material::kMatt, Colour::Of(0x0d0d0e));
    const double y = (hub.y() > 0.0 ? 1.0 : -1.0) * (0.5 * shape.width_m * 1.004 - 0.10);
    for (Eigen::Vector3f& p : arch.positions) p += Vector3d(hub.x(), y, hub.z()).cast<float>();
    car.body.push_back(std::move(arch));
  }
}

}  // namespace

CarShape CarShape::Of(const CarPose& car) {
  CarShape shape;
  shape.front_m = car.front_m;
  shape.length_m = car.length_m;
  shape.width_m = car.width_m;
  shape.height_m = car.height_m;
  // B's origin stands on the ground at rest, so a hub is as high as the tyre is thick. Where the wheels are now says
  // nothing of how the car is built: pictures would depend on which one came first.
  shape.wheel_radius_m = std::clamp(car.wheel_radius_m, 0.2, 0.6);
  for (std::size_t i = 0; i < 4; ++i) {
    shape.hubs_B[i] = {(i < 2 ? 0.5 : -0.5) * car.wheelbase_m, (i % 2 == 0 ? 0.5 : -0.5) * car.track_m[i / 2],
                       shape.wheel_radius_m};
  }
  shape.wheel_width_m = 0.6 * shape.wheel_radius_m;
  shape.tread_out_m =
      std::max(0.0, 0.5 * shape.width_m + 0.012 - 0.5 * shape.wheel_width_m - std::abs(shape.hubs_B[0].y()));
  return shape;
}

CarShape CarShape::Of(const AgentPose& agent) {
  CarShape shape;
  shape.length_m = agent.length_m;
  shape.front_m = 0.5 * agent.length_m;
  shape.width_m = agent.width_m;
  shape.height_m = agent.height_m;
  shape.wheel_radius_m = agent.wheel_radius_m;
  shape.wheel_width_m = 0.6 * agent.wheel_radius_m;
  const double y = 0.5 * agent.width_m + 0.012 - 0.5 * shape.wheel_width_m;
  for (std::size_t i = 0; i < 4; ++i) {
    shape.hubs_B[i] = {(i < 2 ? 0.5 : -0.5) * agent.wheelbase_m, i % 2 == 0 ? y : -y, shape.wheel_radius_m};
  }
  return shape;
}

CarMeshes BuildCar(const CarShape& shape, Colour paint) {
  CarMeshes car;
  const CarBody body(shape);
  AddPaintedBody(body, paint, car);
  AddGlass(body, car);
  AddTrim(body, shape, car);
  AddWheel(shape, car);
  return car;
}

CarMeshes BuildVehicle(AgentKind kind, const CarShape& shape, Colour paint) {
  switch (kind) {
    case AgentKind::kVan:
      return BuildVan(shape, paint);
    case AgentKind::kLorry:
      return BuildLorry(shape, paint);
    case AgentKind::kBus:
      return BuildBus(shape, paint);
    case AgentKind::kCar:
    case AgentKind::kPedestrian:
      break;
  }
  return BuildCar(shape, paint);
}

void CarMeshes::AddLamp(Lamp lamp, Mesh part) {
  part.material = lamps.material = Material::kCarLamp;
  part.colours.assign(part.positions.size(), ColourOf(lamp));
  part.on_face.assign(part.positions.size(), {static_cast<float>(lamp), 0.0F});
  lamps.Append(part);
}

}  // namespace rodeira::scene
