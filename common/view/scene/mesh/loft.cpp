// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/mesh/loft.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "common/core/base/assert.hpp"
#include "common/core/base/constants.hpp"

namespace rodeira::scene {
namespace {

void AddFace(Mesh& mesh, const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, Colour colour) {
  const Eigen::Vector3d across = (b - a).cross(c - a);
  if (across.norm() < 1e-9) return;  // corners that coincide
  const Eigen::Vector3d normal = across.normalized();
  const std::uint32_t first = mesh.Add(a, normal, colour);
  mesh.Add(b, normal, colour);
  mesh.Add(c, normal, colour);
  mesh.AddTriangle(first, first + 1, first + 2);
}

}  // namespace

Mesh Loft(const std::vector<std::vector<Eigen::Vector3d>>& rings, Material material, Colour colour, double crease_rad) {
  RODEIRA_ASSERT(rings.size() >= 2);
  Mesh mesh;
  mesh.material = material;
  const std::size_t count = rings.front().size();
  for (std::size_t r = 0; r + 1 < rings.size(); ++r) {
    RODEIRA_ASSERT(rings[r].size() == count && rings[r + 1].size() == count);
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t next = (k + 1) % count;
      AddFace(mesh, rings[r][k], rings[r][next], rings[r + 1][next], colour);
      AddFace(mesh, rings[r][k], rings[r + 1][next], rings[r + 1][k], colour);
    }
  }
  for (std::size_t k = 1; k + 1 < count; ++k) {
    AddFace(mesh, rings.front()[0], rings.front()[k + 1], rings.front()[k], colour);
    AddFace(mesh, rings.back()[0], rings.back()[k], rings.back()[k + 1], colour);
  }
  SmoothNormals(mesh, crease_rad);
  return mesh;
}

Mesh Disc(double radius_m, double half_width_m, double bevel_m, int sides, Material material, Colour colour) {
  const std::vector<std::pair<double, double>> profile = {{-half_width_m, radius_m - bevel_m},
                                                          {-half_width_m + bevel_m, radius_m},
                                                          {half_width_m - bevel_m, radius_m},
                                                          {half_width_m, radius_m - bevel_m}};
  std::vector<std::vector<Eigen::Vector3d>> rings;
  for (const auto& [y, radius] : profile) {
    std::vector<Eigen::Vector3d> ring;
    for (int k = 0; k < sides; ++k) {
      const double angle = 2.0 * base::kPi * k / sides;
      ring.emplace_back(radius * std::sin(angle), y, radius * std::cos(angle));
    }
    rings.push_back(std::move(ring));
  }
  return Loft(rings, material, colour, 0.7);
}

Mesh Box(const Eigen::Vector3d& low, const Eigen::Vector3d& high, Material material, Colour colour) {
  std::vector<std::vector<Eigen::Vector3d>> rings;
  for (const double x : {low.x(), high.x()}) {
    rings.push_back({{x, low.y(), low.z()}, {x, high.y(), low.z()}, {x, high.y(), high.z()}, {x, low.y(), high.z()}});
  }
  return Loft(rings, material, colour, 0.1);
}

}  // namespace rodeira::scene
