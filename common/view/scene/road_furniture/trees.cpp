// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/road_furniture/trees.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "common/core/base/constants.hpp"
#include "common/view/scene/ground_materials/colours.hpp"

namespace rodeira::scene {
namespace {

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

PlacedCopy PlaceOf(const Tree& tree) {
  return {{tree.foot_W, Eigen::Vector2d::UnitX()}, tree.crown_m, tree.height_m, tree.leaves};
}

}  // namespace rodeira::scene
