// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/vehicles/cabin_body.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "common/view/scene/mesh/loft.hpp"

namespace rodeira::scene {
namespace {

using Eigen::Vector3d;

constexpr Colour kLining = Colour::Of(0xa8a49a), kPillar = Colour::Of(0x3a3c40), kDoor = Colour::Of(0x2b2d32),
                 kLedge = Colour::Of(0x1b1c1f), kSeat = Colour::Of(0x34373d), kFloor = Colour::Of(0x141517),
                 kWiper = Colour::Of(0x101113);
constexpr double kWall_m = 0.055;  // of a door, from the car's greatest width to where it faces people
constexpr double kFloor_m = 0.88;  // below the eye
constexpr double kBehind_m = -1.25;

// Makes parts of both halves of a car alike.
class Halves {
 public:
  Halves(const CabinShape& shape, Mesh& mesh) : shape_(shape), mesh_(mesh) {}

  // From the first corner to the second one, `from` and `to` left of the car's middle.
  void Block(double x0, double x1, double from_m, double to_m, double z0, double z1, Colour colour) const {
    for (const double side : {1.0, -1.0}) {
      const double a = shape_.Y(side * from_m), b = shape_.Y(side * to_m);
      mesh_.Append(Box({x0, std::min(a, b), z0}, {x1, std::max(a, b), z1}, Material::kMatt, colour));
    }
  }
  // A bar between two points, `aside` of both from the car's middle: so wide across, and so thick.
  void Bar(const Vector3d& from, const Vector3d& to, double wide_m, double thick_m, Colour colour) const {
    for (const double side : {1.0, -1.0}) {
      const Vector3d a(from.x(), shape_.Y(side * from.y()), from.z()), b(to.x(), shape_.Y(side * to.y()), to.z()),
          along = (b - a).normalized();
      const Vector3d across = 0.5 * wide_m * Vector3d::UnitX().cross(along).normalized(),
                     up = 0.5 * thick_m * along.cross(across.normalized());
      const auto ring = [&](const Vector3d& p) {
        return std::vector<Vector3d>{p - across - up, p + across - up, p + across + up, p - across + up};
      };
      mesh_.Append(Loft({ring(a), ring(b)}, Material::kMatt, colour, 0.2));
    }
  }

 private:
  const CabinShape& shape_;
  Mesh& mesh_;
};

}  // namespace

double CabinShape::roof_m() const { return std::max(0.13, height_m - eye_height_m - 0.065); }

Mesh BuildCabinBody(const CabinShape& shape) {
  Mesh mesh;
  mesh.material = Material::kMatt;
  const Halves both(shape, mesh);
  const double half = shape.half_m(), wall = half - kWall_m, roof = shape.roof_m(), rail = 0.70 * half,
               waist = 0.90 * half - kWall_m;
  // Doors, from the dashboard to behind the seats: a ledge below the pane, the panel, a rest for the arm.
  both.Block(kBehind_m, 0.86, wall, half - 0.01, -kFloor_m, -kSill_m - 0.01, kDoor);
  both.Block(kBehind_m, 0.86, wall - 0.02, half - 0.02, -kSill_m - 0.03, -kSill_m, kLedge);
  both.Block(-0.25, 0.36, wall - 0.07, wall, -0.53, -0.48, kLedge);
  // Posts beside the windscreen, behind the front seats, beside the rear pane; the roof's rails between them.
  both.Bar({0.84, wall - 0.03, -0.30}, {kHeader_m - 0.02, rail, roof + 0.02}, 0.052, 0.06, kPillar);
  both.Bar({-0.30, waist, -kSill_m - 0.02}, {-0.34, rail, roof + 0.02}, 0.05, 0.10, kPillar);
  both.Bar({kBehind_m + 0.05, waist, -kSill_m - 0.02}, {kBehind_m + 0.15, rail, roof + 0.02}, 0.06, 0.18, kPillar);
  both.Block(kBehind_m + 0.1, kHeader_m, rail - 0.02, rail + 0.04, roof - 0.015, roof + 0.04, kLining);
  // The lining, with its edge above the windscreen and the visors folded up against it.
  mesh.Append(
      Box({kBehind_m + 0.1, shape.Y(-rail), roof}, {kHeader_m, shape.Y(rail), roof + 0.03}, Material::kMatt, kLining));
  mesh.Append(Box({kHeader_m - 0.03, shape.Y(-rail), roof - 0.008}, {kHeader_m + 0.004, shape.Y(rail), roof + 0.035},
                  Material::kMatt, kPillar));
  both.Block(kHeader_m - 0.19, kHeader_m - 0.035, 0.10, rail - 0.10, roof - 0.014, roof + 0.01, kLining);
  // Seats; the front ones begin behind the eye.
  const double seat = std::fabs(shape.eye_left_m);
  both.Block(-0.32, -0.19, seat - 0.23, seat + 0.23, -0.72, -0.06, kSeat);
  both.Block(-0.28, -0.19, seat - 0.12, seat + 0.12, -0.04, 0.13, kSeat);
  both.Block(-0.22, 0.30, seat - 0.24, seat + 0.24, -0.74, -0.61, kSeat);
  mesh.Append(Box({-1.02, shape.Y(-wall + 0.08), -0.72}, {-0.90, shape.Y(wall - 0.08), -0.20}, Material::kMatt, kSeat));
  mesh.Append(Box({-0.92, shape.Y(-wall + 0.08), -0.74}, {-0.50, shape.Y(wall - 0.08), -0.60}, Material::kMatt, kSeat));
  mesh.Append(Box({kBehind_m, shape.Y(-wall), -0.32}, {-1.00, shape.Y(wall), -0.27}, Material::kMatt,
                  kLedge));  // the shelf below the rear pane
  mesh.Append(
      Box({kBehind_m, shape.Y(-wall), -kFloor_m - 0.03}, {1.0, shape.Y(wall), -kFloor_m}, Material::kMatt, kFloor));
  mesh.Append(Box({-0.15, shape.Y(-0.11), -kFloor_m}, {0.66, shape.Y(0.11), -0.58}, Material::kMatt,
                  kDoor));  // with the gear lever
  mesh.Append(Box({0.22, shape.Y(-0.012), -0.60}, {0.245, shape.Y(0.012), -0.44}, Material::kMatt, kWiper));
  mesh.Append(Box({0.205, shape.Y(-0.024), -0.45}, {0.26, shape.Y(0.024), -0.40}, Material::kMatt, kLedge));
  return mesh;
}

}  // namespace rodeira::scene
