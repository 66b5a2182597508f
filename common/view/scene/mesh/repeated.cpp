// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/mesh/repeated.hpp"

#include <map>

#include "common/core/base/assert.hpp"

namespace rodeira::scene {
namespace {

void AddAt(const Repeated& repeated, const PlacedCopy& place, Mesh& mesh) {
  const Mesh& model = repeated.model;
  const Eigen::Vector3d scale(place.across, place.across, place.up);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    const bool leaf = !repeated.light.empty() && repeated.light[i] >= 0.0F;
    mesh.Add(place.stand.ToWorld(scale.cwiseProduct(model.positions[i].cast<double>())),
             place.stand.Turned(model.normals[i].cast<double>()),
             leaf ? LeafColour(place.leaves, static_cast<double>(repeated.light[i])) : model.colours[i]);
  }
  for (const std::uint32_t index : model.triangles) mesh.triangles.push_back(first + index);
}

}  // namespace

Colour LeafColour(Colour leaves, double light) { return Mix(Shade(leaves, 0.72), Shade(leaves, 1.12), light); }

std::vector<Mesh> Merged(std::span<const Repeated> all) {
  std::map<Material, Mesh> merged;
  for (const Repeated& repeated : all) {
    RODEIRA_ASSERT(repeated.origin_W == all.front().origin_W);
    Mesh& mesh = merged[repeated.model.material];
    mesh.material = repeated.model.material;
    mesh.origin_W = repeated.origin_W;
    for (const PlacedCopy& place : repeated.places) AddAt(repeated, place, mesh);
  }
  std::vector<Mesh> meshes;
  for (auto& [material, mesh] : merged) meshes.push_back(std::move(mesh));
  return meshes;
}

}  // namespace rodeira::scene
