// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/road_furniture/trees.hpp"

#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "common/core/base/constants.hpp"
#include "common/core/base/random.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/view/scene/ground_materials/colours.hpp"

namespace rodeira::scene {
namespace {

constexpr double kPlot_m = 12.0;  // at most one tree a plot
constexpr int kPlotsAField = 16;
constexpr double kMaxRoadDistance_m = 420.0;  // from a road
constexpr double kTrunkClearance_m = 3.5;     // between a trunk and the paved edge

// The distance to the nearest road's axis, less that road's half width.
double RoomBeside(const road::World& world, double x_m, double y_m) {
  double room = 1e9;
  for (const road::Road& road : world.roads()) {
    const geometry::Foot foot = road.plan().Project(x_m, y_m);
    const double half = std::max(road.section().paved_left_m(), -road.section().paved_right_m());
    room = std::min(room, foot.distance_m - half);
  }
  return room;
}

Tree Grow(std::uint64_t seed, std::uint64_t column, std::uint64_t row) {
  const auto draw = [&](std::uint64_t what, double low, double high) {
    return base::RandomUniform({seed, column, row, what}, low, high);
  };
  Tree tree;
  tree.conifer = draw(3, 0.0, 1.0) < 0.3;
  tree.height_m = tree.conifer ? draw(4, 5.0, 10.0) : draw(4, 3.2, 6.5);
  tree.crown_m = tree.conifer ? tree.height_m * draw(5, 0.16, 0.22) : tree.height_m * draw(5, 0.32, 0.46);
  tree.leaves =
      Shade(Mix(Colour::Of(0x4b6330), tree.conifer ? Colour::Of(0x2f4a2e) : Colour::Of(0x74803f), draw(6, 0.0, 1.0)),
            draw(7, 0.85, 1.1));
  return tree;
}

void PlantField(const road::World& world, std::uint64_t seed, std::int64_t field_column, std::int64_t field_row,
                bool near_road, std::vector<Tree>& trees) {
  for (int c = 0; c < kPlotsAField; ++c) {
    for (int r = 0; r < kPlotsAField; ++r) {
      const auto column = static_cast<std::uint64_t>(field_column * kPlotsAField + c),
                 row = static_cast<std::uint64_t>(field_row * kPlotsAField + r);
      const auto draw = [&](std::uint64_t what, double low, double high) {
        return base::RandomUniform({seed, column, row, what}, low, high);
      };
      const double x = (static_cast<double>(static_cast<std::int64_t>(column)) + draw(0, 0.05, 0.95)) * kPlot_m;
      const double y = (static_cast<double>(static_cast<std::int64_t>(row)) + draw(1, 0.05, 0.95)) * kPlot_m;
      const double wood = SmoothNoise(x, y, 190.0, seed) + 0.5 * SmoothNoise(x, y, 60.0, seed + 1);
      if (draw(2, 0.0, 1.0) > (wood > 0.25 ? 0.6 : 0.07)) continue;
      const road::SurfacePoint ground = world.At(x, y);
      if (!ground.inside || ground.surface != ground::Surface::kGrass) continue;
      if (ground.slope_x * ground.slope_x + ground.slope_y * ground.slope_y > 0.6) continue;  // too steep
      Tree tree = Grow(seed, column, row);
      if (near_road && RoomBeside(world, x, y) < kTrunkClearance_m + tree.crown_m) continue;
      tree.foot_W = {x, y, ground.z_m};
      trees.push_back(tree);
    }
  }
}

// Rings of a crown: height and radius as shares.
using Profile = std::vector<std::pair<double, double>>;

// `own`: the colour of what is no leaf; null: leaves, the lighter the higher.
void AddRings(const Profile& profile, int sides, const Colour* own, Repeated& tree) {
  Mesh& mesh = tree.model;
  std::vector<std::vector<std::uint32_t>> rings;
  for (std::size_t k = 0; k < profile.size(); ++k) {
    const auto& [up, wide] = profile[k];
    const double share = static_cast<double>(k) / static_cast<double>(profile.size() - 1);
    std::vector<std::uint32_t> ring;
    for (int side = 0; side < sides; ++side) {
      const double angle = 2.0 * base::kPi * (side + 0.5 * static_cast<double>(k % 2)) / sides;
      const Eigen::Vector3d out(std::cos(angle), std::sin(angle), 0.0);
      const Eigen::Vector3d normal = (out + Eigen::Vector3d(0.0, 0.0, 1.6 * share - 0.5)).normalized();
      ring.push_back(mesh.Add(wide * out + Eigen::Vector3d(0.0, 0.0, up), normal, own != nullptr ? *own : Colour{}));
      tree.light.push_back(own != nullptr ? -1.0F : static_cast<float>(share));
    }
    rings.push_back(std::move(ring));
  }
  const auto count = static_cast<std::size_t>(sides);
  for (std::size_t k = 0; k + 1 < rings.size(); ++k) {
    for (std::size_t side = 0; side < count; ++side) {
      const std::size_t next = (side + 1) % count;
      mesh.AddTriangle(rings[k][side], rings[k][next], rings[k + 1][next]);
      mesh.AddTriangle(rings[k][side], rings[k + 1][next], rings[k + 1][side]);
    }
  }
}

}  // namespace

std::vector<Tree> PlantTrees(const road::World& world, std::uint64_t seed) {
  std::vector<Tree> trees;
  if (world.grid() == nullptr || world.terrain_surface() != ground::Surface::kGrass) return trees;
  const double field_m = kPlot_m * kPlotsAField;
  const double across_m = field_m * std::sqrt(0.5);
  const road::Extents extents = world.extents();
  const auto field = [field_m](double x) { return static_cast<std::int64_t>(std::floor(x / field_m)); };
  for (std::int64_t column = field(extents.west_m); column <= field(extents.east_m); ++column) {
    for (std::int64_t row = field(extents.south_m); row <= field(extents.north_m); ++row) {
      const double room =
          RoomBeside(world, (static_cast<double>(column) + 0.5) * field_m, (static_cast<double>(row) + 0.5) * field_m);
      if (room > kMaxRoadDistance_m) continue;
      PlantField(world, seed, column, row, room < across_m + 12.0, trees);
    }
  }
  return trees;
}

TreeKind KindOf(const Tree& tree) {
  return tree.bush ? TreeKind::kBush : tree.conifer ? TreeKind::kCone : TreeKind::kRound;
}

Repeated TreeModel(TreeKind kind, int level) {
  // The number of rings less one divides four: light is a multiple of a quarter.
  static const std::array<Profile, 3> kFine = {
      Profile{{0.22, 0.15}, {0.36, 0.85}, {0.58, 1.0}, {0.82, 0.72}, {1.0, 0.08}},
      Profile{{0.14, 0.3}, {0.2, 1.0}, {0.5, 0.62}, {0.78, 0.32}, {1.0, 0.02}},
      Profile{{-0.08, 0.6}, {0.3, 1.0}, {0.6, 0.9}, {0.85, 0.55}, {1.0, 0.06}}};
  static const std::array<Profile, 3> kPlain = {Profile{{0.2, 0.3}, {0.55, 1.0}, {1.0, 0.15}},
                                                Profile{{0.14, 0.3}, {0.22, 1.0}, {1.0, 0.02}},
                                                Profile{{-0.08, 0.6}, {0.45, 1.0}, {1.0, 0.1}}};
  static const Profile kTrunk = {{-0.08, 0.13}, {0.3, 0.09}};
  static constexpr Colour kBark = Colour::Of(0x5b4936);
  Repeated tree;
  tree.model.material = Material::kFoliage;
  if (kind != TreeKind::kBush && level < 2) AddRings(kTrunk, level == 0 ? 5 : 3, &kBark, tree);
  AddRings((level == 0 ? kFine : kPlain)[static_cast<std::size_t>(kind)],
           level == 0   ? 7
           : level == 1 ? 6
                        : 4,
           nullptr, tree);
  return tree;
}

StandingPlace PlaceOf(const Tree& tree) {
  return {{tree.foot_W, Eigen::Vector2d::UnitX()}, tree.crown_m, tree.height_m, tree.leaves};
}

std::vector<std::vector<Repeated>> BuildTrees(const std::vector<Tree>& trees) {
  const double field_m = kPlot_m * kPlotsAField;
  struct Field {
    Eigen::Vector3d origin_W;
    std::map<TreeKind, Repeated> kinds;
  };
  std::map<std::pair<std::int64_t, std::int64_t>, Field> fields;
  for (const Tree& tree : trees) {
    const std::pair key(static_cast<std::int64_t>(std::floor(tree.foot_W.x() / field_m)),
                        static_cast<std::int64_t>(std::floor(tree.foot_W.y() / field_m)));
    auto [field, fresh] = fields.try_emplace(key);
    if (fresh) field->second.origin_W = OriginNear(tree.foot_W);
    auto [kind, first] = field->second.kinds.try_emplace(KindOf(tree));
    if (first) {
      kind->second = TreeModel(kind->first, 0);
      kind->second.origin_W = field->second.origin_W;
    }
    kind->second.places.push_back(PlaceOf(tree));
  }
  std::vector<std::vector<Repeated>> all;
  for (auto& [key, field] : fields) {
    std::vector<Repeated>& kinds = all.emplace_back();
    for (auto& [kind, repeated] : field.kinds) kinds.push_back(std::move(repeated));
  }
  return all;
}

}  // namespace rodeira::scene
