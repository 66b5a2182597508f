#include "common/scene/trees.hpp"

#include <cmath>
#include <map>
#include <utility>

#include "common/base/random.hpp"
#include "common/geometry/angle.hpp"
#include "common/scene/colours.hpp"

namespace rodeira::scene {
namespace {

constexpr double kPlot_m = 12.0;     // at most one tree a plot
constexpr int kPlotsAField = 16;
constexpr double kFarthest_m = 420.0;  // from a road
constexpr double kClear_m = 3.5;     // between a trunk and the paved edge

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
  const auto draw = [&](std::uint64_t what, double low, double high) { return base::RandomUniform({seed, column, row, what}, low, high); };
  Tree tree;
  tree.conifer = draw(3, 0.0, 1.0) < 0.3;
  tree.height_m = tree.conifer ? draw(4, 5.0, 10.0) : draw(4, 3.2, 6.5);
  tree.crown_m = tree.conifer ? tree.height_m * draw(5, 0.16, 0.22) : tree.height_m * draw(5, 0.32, 0.46);
  tree.leaves = Shade(Mix(Colour::Of(0x4b6330), tree.conifer ? Colour::Of(0x2f4a2e) : Colour::Of(0x74803f), draw(6, 0.0, 1.0)), draw(7, 0.85, 1.1));
  return tree;
}

void PlantField(const road::World& world, std::uint64_t seed, std::int64_t field_column, std::int64_t field_row, bool near_road, std::vector<Tree>& trees) {
  for (int c = 0; c < kPlotsAField; ++c) {
    for (int r = 0; r < kPlotsAField; ++r) {
      const auto column = static_cast<std::uint64_t>(field_column * kPlotsAField + c), row = static_cast<std::uint64_t>(field_row * kPlotsAField + r);
      const auto draw = [&](std::uint64_t what, double low, double high) { return base::RandomUniform({seed, column, row, what}, low, high); };
      const double x = (static_cast<double>(static_cast<std::int64_t>(column)) + draw(0, 0.05, 0.95)) * kPlot_m;
      const double y = (static_cast<double>(static_cast<std::int64_t>(row)) + draw(1, 0.05, 0.95)) * kPlot_m;
      const double wood = SmoothNoise(x, y, 190.0, seed) + 0.5 * SmoothNoise(x, y, 60.0, seed + 1);
      if (draw(2, 0.0, 1.0) > (wood > 0.25 ? 0.6 : 0.07)) continue;
      const road::SurfacePoint ground = world.At(x, y);
      if (!ground.inside || ground.surface != terrain::Surface::kGrass) continue;
      if (ground.slope_x * ground.slope_x + ground.slope_y * ground.slope_y > 0.6) continue;  // too steep
      Tree tree = Grow(seed, column, row);
      if (near_road && RoomBeside(world, x, y) < kClear_m + tree.crown_m) continue;
      tree.foot_W = {x, y, ground.z_m};
      trees.push_back(tree);
    }
  }
}

// Rings of a crown: height and radius as shares.
using Profile = std::vector<std::pair<double, double>>;

void AddRings(Mesh& mesh, const Tree& tree, const Profile& profile, int sides, Colour dark, Colour light) {
  std::vector<std::vector<std::uint32_t>> rings;
  for (std::size_t k = 0; k < profile.size(); ++k) {
    const auto& [up, wide] = profile[k];
    const double share = static_cast<double>(k) / static_cast<double>(profile.size() - 1);
    std::vector<std::uint32_t> ring;
    for (int side = 0; side < sides; ++side) {
      const double angle = 2.0 * geometry::kPi * (side + 0.5 * static_cast<double>(k % 2)) / sides;
      const Eigen::Vector3d out(std::cos(angle), std::sin(angle), 0.0);
      const Eigen::Vector3d normal = (out + Eigen::Vector3d(0.0, 0.0, 1.6 * share - 0.5)).normalized();
      ring.push_back(mesh.Add(tree.foot_W + wide * tree.crown_m * out + Eigen::Vector3d(0.0, 0.0, up * tree.height_m), normal, Mix(dark, light, share)));
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
  if (world.grid() == nullptr || world.terrain_surface() != terrain::Surface::kGrass) return trees;
  const double field_m = kPlot_m * kPlotsAField;
  const double across_m = field_m * std::sqrt(0.5);
  const road::Extents extents = world.extents();
  const auto field = [field_m](double x) { return static_cast<std::int64_t>(std::floor(x / field_m)); };
  for (std::int64_t column = field(extents.west_m); column <= field(extents.east_m); ++column) {
    for (std::int64_t row = field(extents.south_m); row <= field(extents.north_m); ++row) {
      const double room = RoomBeside(world, (static_cast<double>(column) + 0.5) * field_m, (static_cast<double>(row) + 0.5) * field_m);
      if (room > kFarthest_m) continue;
      PlantField(world, seed, column, row, room < across_m + 12.0, trees);
    }
  }
  return trees;
}

void AddTree(Mesh& mesh, const Tree& tree, int level) {
  static const Profile kRound = {{0.22, 0.15}, {0.36, 0.85}, {0.58, 1.0}, {0.82, 0.72}, {1.0, 0.08}};
  static const Profile kCone = {{0.14, 0.3}, {0.2, 1.0}, {0.5, 0.62}, {0.78, 0.32}, {1.0, 0.02}};
  static const Profile kBush = {{-0.08, 0.6}, {0.3, 1.0}, {0.6, 0.9}, {0.85, 0.55}, {1.0, 0.06}};
  static const Profile kPlainRound = {{0.2, 0.3}, {0.55, 1.0}, {1.0, 0.15}}, kPlainCone = {{0.14, 0.3}, {0.22, 1.0}, {1.0, 0.02}}, kPlainBush = {{-0.08, 0.6}, {0.45, 1.0}, {1.0, 0.1}};
  static const Profile kTrunk = {{-0.08, 0.13}, {0.3, 0.09}};
  const Colour bark = Colour::Of(0x5b4936), dark = Shade(tree.leaves, 0.72), light = Shade(tree.leaves, 1.12);
  if (!tree.bush && level < 2) AddRings(mesh, tree, kTrunk, level == 0 ? 5 : 3, bark, bark);
  if (level == 0) AddRings(mesh, tree, tree.bush ? kBush : tree.conifer ? kCone : kRound, 7, dark, light);
  else AddRings(mesh, tree, tree.bush ? kPlainBush : tree.conifer ? kPlainCone : kPlainRound, level == 1 ? 6 : 4, dark, light);
}

std::vector<Mesh> BuildTrees(const std::vector<Tree>& trees) {
  const double field_m = kPlot_m * kPlotsAField;
  std::map<std::pair<std::int64_t, std::int64_t>, Mesh> fields;
  for (const Tree& tree : trees) {
    const std::pair key(static_cast<std::int64_t>(std::floor(tree.foot_W.x() / field_m)), static_cast<std::int64_t>(std::floor(tree.foot_W.y() / field_m)));
    auto [found, fresh] = fields.try_emplace(key);
    if (fresh) {
      found->second.material = Material::kFoliage;
      found->second.origin_W = OriginNear(tree.foot_W);
    }
    AddTree(found->second, tree);
  }
  std::vector<Mesh> meshes;
  for (auto& [key, mesh] : fields) meshes.push_back(std::move(mesh));
  return meshes;
}

}  // namespace rodeira::scene
