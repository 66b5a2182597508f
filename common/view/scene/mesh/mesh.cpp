// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/mesh/mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "common/core/base/assert.hpp"

namespace rodeira::scene {

bool IsGround(Material material) {
  switch (material) {
    case Material::kGround:
    case Material::kCheckers:
    case Material::kRoad:
    case Material::kMark:
    case Material::kConcrete:
    case Material::kGravel:
    case Material::kPicture:
      return true;
    default:
      return false;
  }
}

Colour Mix(Colour a, Colour b, double weight) {
  const auto mix = [weight](std::uint8_t x, std::uint8_t y) {
    return static_cast<std::uint8_t>(std::lround(x + weight * (y - x)));
  };
  return {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue)};
}

Colour Shade(Colour colour, double factor) {
  const auto shade = [factor](std::uint8_t x) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(x * factor, 0.0, 255.0)));
  };
  return {shade(colour.red), shade(colour.green), shade(colour.blue)};
}

std::uint32_t Mesh::Add(const Eigen::Vector3d& p_W, const Eigen::Vector3d& normal, Colour colour) {
  positions.push_back((p_W - origin_W).cast<float>());
  normals.push_back(normal.cast<float>());
  colours.push_back(colour);
  return static_cast<std::uint32_t>(positions.size() - 1);
}

void Mesh::Append(const Mesh& other) {
  RODEIRA_ASSERT(origin_W == other.origin_W);
  const auto first = static_cast<std::uint32_t>(positions.size());
  positions.insert(positions.end(), other.positions.begin(), other.positions.end());
  normals.insert(normals.end(), other.normals.begin(), other.normals.end());
  colours.insert(colours.end(), other.colours.begin(), other.colours.end());
  on_face.insert(on_face.end(), other.on_face.begin(), other.on_face.end());
  for (const std::uint32_t index : other.triangles) triangles.push_back(first + index);
}

Eigen::Vector3d OriginNear(const Eigen::Vector3d& p_W) {
  return {std::round(p_W.x() / kOriginGrid_m) * kOriginGrid_m, std::round(p_W.y() / kOriginGrid_m) * kOriginGrid_m,
          std::round(p_W.z() / kOriginGrid_m) * kOriginGrid_m};
}

void SmoothNormals(Mesh& mesh, double crease_rad) {
  RODEIRA_ASSERT(mesh.positions.size() == mesh.triangles.size());
  const auto place_of = [&mesh](std::uint32_t vertex) {  // to a hundredth of a millimetre
    const Eigen::Vector3f& p = mesh.positions[vertex];
    return std::tuple(std::lround(p.x() * 1e5F), std::lround(p.y() * 1e5F), std::lround(p.z() * 1e5F));
  };
  std::vector<Eigen::Vector3f> face(mesh.triangle_count());  // length: twice the area
  std::map<std::tuple<long, long, long>, std::vector<std::size_t>> around;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::Vector3f& a = mesh.positions[mesh.triangles[3 * t]];
    face[t] = (mesh.positions[mesh.triangles[3 * t + 1]] - a).cross(mesh.positions[mesh.triangles[3 * t + 2]] - a);
    for (std::size_t k = 0; k < 3; ++k) around[place_of(mesh.triangles[3 * t + k])].push_back(t);
  }
  const auto least = static_cast<float>(std::cos(crease_rad));
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::Vector3f own = face[t].normalized();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t vertex = mesh.triangles[3 * t + k];
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      for (const std::size_t other : around[place_of(vertex)]) {
        if (face[other].normalized().dot(own) > least) sum += face[other];
      }
      mesh.normals[vertex] = sum.squaredNorm() > 0.0F ? Eigen::Vector3f(sum.normalized()) : own;
    }
  }
}

}  // namespace rodeira::scene
