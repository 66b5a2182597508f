// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/road_furniture/models.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/base/random.hpp"
#include "common/view/scene/mesh/solids.hpp"

namespace rodeira::scene {
namespace {

using Eigen::Vector3d;

constexpr double kFoundation_m = 1.5;     // of walls on ground that slopes
constexpr double kWindowOffset_m = 0.03;  // windows and doors stand before their walls

Mesh Empty() {
  Mesh mesh;
  mesh.material = Material::kMatt;
  return mesh;
}

void Put(Mesh& mesh, const Mesh& part, const Vector3d& at = Vector3d::Zero()) {
  AddPlaced(part, {at, Eigen::Vector2d::UnitX()}, mesh);
}

// An upright pane on a wall that looks along y (side +1) or against it.
void AddPane(Mesh& mesh, double side, double y, double x0, double x1, double z0, double z1, Colour colour) {
  const double at = y + side * kWindowOffset_m;
  if (side > 0.0)
    AddFlat(mesh, std::array<Vector3d, 4>{Vector3d{x1, at, z0}, {x0, at, z0}, {x0, at, z1}, {x1, at, z1}}, colour);
  else
    AddFlat(mesh, std::array<Vector3d, 4>{Vector3d{x0, at, z0}, {x1, at, z0}, {x1, at, z1}, {x0, at, z1}}, colour);
}

// Rows of windows on both long walls, and a door on the road's side in place of one below.
void AddOpenings(Mesh& mesh, const ModelSize& size, double eaves_m) {
  const Colour glass = Colour::Of(0x3b4650), door = Colour::Of(0x5a3d28);
  const int across = std::max(1, static_cast<int>(size.length_m / 2.6)),
            floors = std::max(1, static_cast<int>(eaves_m / 2.6));
  const double step = size.length_m / across, rise = eaves_m / floors;
  for (const double side : {1.0, -1.0}) {
    for (int floor = 0; floor < floors; ++floor) {
      for (int k = 0; k < across; ++k) {
        const double x = (k + 0.5) * step - 0.5 * size.length_m, z = floor * rise;
        const bool entrance = side > 0.0 && floor == 0 && k == across / 2;
        if (entrance)
          AddPane(mesh, side, 0.5 * side * size.width_m, x - 0.5, x + 0.5, 0.0, std::min(2.1, 0.9 * rise), door);
        else
          AddPane(mesh, side, 0.5 * side * size.width_m, x - 0.5, x + 0.5, z + 0.34 * rise, z + 0.8 * rise, glass);
      }
    }
  }
}

// One of a traffic light's three, counted from below, so far before its housing.
std::array<Vector3d, 8> LightDisc(double height_m, std::size_t which, double before_m) {
  std::array<Vector3d, 8> round;
  for (std::size_t i = 0; i < round.size(); ++i) {
    const double angle = 0.785398163397448 * static_cast<double>(i);
    round[i] = {kLightHousing * height_m + before_m, 0.13 * height_m * std::cos(angle),
                height_m * (static_cast<double>(which) + 0.5) / 3.0 + 0.13 * height_m * std::sin(angle)};
  }
  return round;
}

}  // namespace

Mesh HouseModel(const ModelSize& size, std::uint64_t seed, int level) {
  constexpr std::array<std::uint32_t, 5> kWalls = {0xe9e4d8, 0xd9cdb4, 0xe3d3b5, 0xc9b8a4, 0xdfe0dc};
  constexpr std::array<std::uint32_t, 3> kRoofs = {0x9a4f35, 0x83442f, 0x6d5348};
  const Colour walls = Colour::Of(kWalls[base::RandomBits({seed, 1}) % kWalls.size()]),
               roof = Colour::Of(kRoofs[base::RandomBits({seed, 2}) % kRoofs.size()]);
  Mesh mesh = Empty();
  const double eaves = 0.68 * size.height_m, half_x = 0.5 * size.length_m, half_y = 0.5 * size.width_m;
  Put(mesh, Block({-half_x, -half_y, -kFoundation_m}, {half_x, half_y, eaves}, walls));
  const double over = level == 0 ? 0.4 : 0.0;
  Put(mesh, Gable({-half_x - over, -half_y - over, eaves - 0.5 * over}, {half_x + over, half_y + over, size.height_m},
                  roof, walls));
  if (level > 0) return mesh;
  AddOpenings(mesh, size, eaves);
  Put(mesh, Block({0.2 * half_x, 0.35 * half_y, eaves}, {0.2 * half_x + 0.7, 0.35 * half_y + 0.7, size.height_m + 0.4},
                  Colour::Of(0x8a5a46)));  // a chimney
  return mesh;
}

Mesh FillingStationModel(const ModelSize& size, int level) {
  const Colour white = Colour::Of(0xe4e5e3), band = Colour::Of(0x1d6a4c), steel = Colour::Of(0x9aa0a4),
               glass = Colour::Of(0x43505a);
  Mesh mesh = Empty();
  const double half_x = 0.5 * size.length_m, half_y = 0.5 * size.width_m, top = size.height_m, under = 0.8 * top;
  const double shop = -0.35 * half_y;  // the shop lies behind this, the pumps before it
  Put(mesh, Block({-half_x, -half_y, -kFoundation_m}, {half_x, shop, 0.62 * top}, white));
  const Vector3d low(-0.8 * half_x, shop + 0.5, under), high(0.8 * half_x, half_y, top);
  Put(mesh, Block(low, high, band));
  AddFlat(mesh,
          std::array<Vector3d, 4>{low, Vector3d(low.x(), high.y(), under), Vector3d(high.x(), high.y(), under),
                                  Vector3d(high.x(), low.y(), under)},
          white);
  if (level > 1) return mesh;
  for (const double x : {-0.6 * half_x, 0.6 * half_x}) {
    for (const double y : {0.3 * half_y, 0.75 * half_y})
      Put(mesh, Block({x - 0.15, y - 0.15, -kFoundation_m}, {x + 0.15, y + 0.15, under}, steel));
  }
  if (level > 0) return mesh;
  AddPane(mesh, 1.0, shop, -0.7 * half_x, 0.7 * half_x, 0.4, 0.45 * top, glass);
  for (const double x : {-0.35 * half_x, 0.0, 0.35 * half_x}) {
    for (const double y : {0.3 * half_y, 0.75 * half_y}) {
      Put(mesh, Block({x - 0.4, y - 0.5, -0.2}, {x + 0.4, y + 0.5, 0.15}, Colour::Of(0xb8b4ac)));
      Put(mesh, Block({x - 0.25, y - 0.3, 0.15}, {x + 0.25, y + 0.3, 1.7}, band));
    }
  }
  return mesh;
}

Mesh PostModel(const ModelSize& size, int level) {
  Mesh mesh = Empty();
  if (level > 1) return mesh;
  const Colour white = Colour::Of(0xeceeec), black = Colour::Of(0x1c1c1e);
  const double h = size.height_m, half = 0.5 * size.width_m, thin = 0.7 * half;
  if (level == 1) {
    Put(mesh, Block({-thin, -half, -0.05}, {thin, half, h}, white));
    return mesh;
  }
  Put(mesh, Block({-thin, -half, -0.05}, {thin, half, 0.62 * h}, white));
  Put(mesh, Block({-thin, -half, 0.62 * h}, {thin, half, 0.86 * h}, black));
  Put(mesh, Block({-thin, -half, 0.86 * h}, {thin, half, h}, white));
  const double w = 0.45 * half, z0 = 0.66 * h, z1 = 0.82 * h;  // to both directions
  const double x = thin + 0.004;
  AddFlat(mesh, std::array<Vector3d, 4>{Vector3d{x, -w, z0}, {x, w, z0}, {x, w, z1}, {x, -w, z1}},
          Colour::Of(0xf0d27a));
  AddFlat(mesh, std::array<Vector3d, 4>{Vector3d{-x, w, z0}, {-x, -w, z0}, {-x, -w, z1}, {-x, w, z1}},
          Colour::Of(0xf0d27a));
  return mesh;
}

Mesh LampModel(const ModelSize& size, int level) {
  Mesh mesh = Empty();
  if (level > 1) return mesh;
  const Colour steel = Colour::Of(0x8d9496);
  const double h = size.height_m, foot = 0.5 * size.width_m, arm = 0.22 * h;
  Put(mesh, Pole(-0.1, h, foot, 0.5 * foot, level == 0 ? 6 : 3, steel));
  Put(mesh, Block({-0.05, 0.0, h - 0.08}, {0.05, arm, h}, steel));
  if (level > 0) return mesh;
  Put(mesh, Block({-0.16, arm - 0.35, h - 0.12}, {0.16, arm + 0.45, h + 0.06}, Colour::Of(0xb9bdbd)));
  return mesh;
}

Mesh PlainModel(const ModelSize& size, double radius_m, Colour colour, int level) {
  const bool large = std::max({size.length_m, size.width_m, 2.0 * radius_m}) * size.height_m > 20.0;
  if (level > 1 && !large) return Empty();
  if (radius_m > 0.0) return Pole(0.0, size.height_m, radius_m, radius_m, level == 0 ? 10 : 5, colour);
  return Block({-0.5 * size.length_m, -0.5 * size.width_m, 0.0},
               {0.5 * size.length_m, 0.5 * size.width_m, size.height_m}, colour);
}

Mesh TrafficLightModel(double height_m, int level) {
  Mesh mesh = Empty();
  if (level > 1) return mesh;
  const double half = kLightHousing * height_m;
  Put(mesh, Block({-half, -half, 0.0}, {half, half, height_m}, Colour::Of(0x23272a)));
  AddFlat(
      mesh,
      std::array<Vector3d, 4>{Vector3d{-half, half, 0.0}, {half, half, 0.0}, {half, -half, 0.0}, {-half, -half, 0.0}},
      Colour::Of(0x23272a));  // seen from below
  if (level > 0) return mesh;
  constexpr std::array<std::uint32_t, 3> kLights = {0x3d6b45, 0x8b6a22, 0x7c2520};  // from below
  for (std::size_t k = 0; k < kLights.size(); ++k) AddFlat(mesh, LightDisc(height_m, k, 0.004), Colour::Of(kLights[k]));
  return mesh;
}

Mesh LitLightModel(double height_m, std::size_t which) {
  constexpr std::array<std::uint32_t, 3> kLit = {0x2cf07a, 0xffb21e, 0xff3220};  // from below
  Mesh mesh = Empty();
  mesh.material = Material::kLamp;
  AddFlat(mesh, LightDisc(height_m, which, 0.03), Colour::Of(kLit[which]));
  return mesh;
}

}  // namespace rodeira::scene
