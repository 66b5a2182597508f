// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/terrain/far_plane.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <set>

#include "common/view/scene/ground_materials/colours.hpp"
#include "common/view/scene/ground_materials/skin.hpp"

namespace rodeira::scene {

Mesh BuildFarPlane(const road::World& world, std::span<const TileKey> tiles) {
  Mesh mesh;
  if (!world.plane() || tiles.empty() || world.ground_picture() != nullptr) return mesh;
  TileKey low = tiles.front(), high = low;
  for (const TileKey& key : tiles) {
    low = {std::min(low.column, key.column), std::min(low.row, key.row)};
    high = {std::max(high.column, key.column), std::max(high.row, key.row)};
  }
  const Eigen::Vector2d west_south = low.south_west_W(),
                        east_north = TileKey{high.column + 1, high.row + 1}.south_west_W();
  const auto at = [&](double x_m, double y_m) {
    return Eigen::Vector3d(x_m, y_m, world.plane()->z_m + world.plane()->slope_x * x_m + world.plane()->slope_y * y_m);
  };
  const Eigen::Vector3d normal = Eigen::Vector3d(-world.plane()->slope_x, -world.plane()->slope_y, 1.0).normalized();
  const Eigen::Vector2d far = Eigen::Vector2d::Constant(kFarPlane_m);
  const Skin skin = SkinAt(world, west_south - far, world.TerrainAt(west_south.x(), west_south.y()));
  mesh.material = skin.material;
  mesh.origin_W = OriginNear(at(0.5 * (west_south.x() + east_north.x()), 0.5 * (west_south.y() + east_north.y())));
  const auto add = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    std::uint32_t corners[4];
    std::size_t i = 0;
    for (const Eigen::Vector2d& p : {a, Eigen::Vector2d(b.x(), a.y()), b, Eigen::Vector2d(a.x(), b.y())}) {
      corners[i++] = mesh.Add(at(p.x(), p.y()), normal,
                              skin.grown ? GroundColour(skin.surface, p.x(), p.y(), normal) : skin.colour);
    }
    mesh.AddTriangle(corners[0], corners[1], corners[2]);
    mesh.AddTriangle(corners[0], corners[2], corners[3]);
  };
  const Eigen::Vector2d outer_low = west_south - far, outer_high = east_north + far;
  add(outer_low, {outer_high.x(), west_south.y()});
  add({outer_low.x(), east_north.y()}, outer_high);
  add({outer_low.x(), west_south.y()}, {west_south.x(), east_north.y()});
  add({east_north.x(), west_south.y()}, {outer_high.x(), east_north.y()});
  // Squares between others that have none of their own, row by row.
  const std::set<TileKey> known(tiles.begin(), tiles.end());
  for (std::int64_t row = low.row; row <= high.row; ++row) {
    for (std::int64_t column = low.column; column <= high.column; ++column) {
      std::int64_t end = column;
      while (end <= high.column && !known.contains({end, row})) ++end;
      if (end > column) add(TileKey{column, row}.south_west_W(), TileKey{end, row + 1}.south_west_W());
      column = end;
    }
  }
  return mesh;
}

}  // namespace rodeira::scene
