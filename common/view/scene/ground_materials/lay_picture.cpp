// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/ground_materials/lay_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "common/core/base/files.hpp"
#include "common/world/network/network.hpp"

namespace rodeira::scene {

void Show(const terrain::LaidPicture& picture, Mesh& mesh) {
  mesh.material = Material::kPicture;
  mesh.face = picture.file;
  mesh.repeats = picture.repeats;
}

void LayPicture(const terrain::LaidPicture& picture, Mesh& mesh) {
  Show(picture, mesh);
  const Eigen::Vector2d size(picture.width_m, picture.height_m);
  Eigen::Vector2d first =
      (mesh.origin_W.head<2>() - Eigen::Vector2d(picture.west_m, picture.south_m)).cwiseQuotient(size);
  if (picture.repeats) first -= Eigen::Vector2d(std::floor(first.x()), std::floor(first.y()));
  mesh.on_face.clear();
  mesh.on_face.reserve(mesh.positions.size());
  for (const Eigen::Vector3f& p : mesh.positions) {
    mesh.on_face.push_back((first + p.head<2>().cast<double>().cwiseQuotient(size)).cast<float>());
  }
}

std::optional<terrain::LaidPicture> PictureOf(const network::LaneMaterial& material) {
  if (material.texture.empty()) return std::nullopt;
  return terrain::LaidPicture{material.texture, 0.0, 0.0, material.texture_width_m, material.texture_height_m, true};
}

std::vector<terrain::LaidPicture> PicturesOf(const road::World& world) {
  std::vector<terrain::LaidPicture> pictures;
  const auto add = [&](const std::optional<terrain::LaidPicture>& picture) {
    if (picture && std::find(pictures.begin(), pictures.end(), *picture) == pictures.end())
      pictures.push_back(*picture);
  };
  if (world.ground_picture() != nullptr) add(*world.ground_picture());
  if (world.network() == nullptr) return pictures;
  for (const network::Road& road : world.network()->roads()) {
    for (const network::LaneSection& section : road.spec().sections) {
      for (const auto* side : {&section.left, &section.right}) {
        for (const network::Lane& lane : *side) {
          for (const network::LaneMaterial& material : lane.materials) add(PictureOf(material));
        }
      }
    }
  }
  return pictures;
}

base::Digest PictureDigests::Of(const terrain::LaidPicture& picture) {
  const base::Digest lies =
      base::Hash(fmt::format("{} {} {} {} {} {}", picture.west_m, picture.south_m, picture.width_m, picture.height_m,
                             picture.repeats, std::filesystem::path(picture.file).extension().string()));
  const auto [file, fresh] = files_.try_emplace(picture.file, 0);
  if (fresh) {
    if (const auto bytes = base::ReadBytes(picture.file)) file->second = base::Hash(std::span(bytes.value()));
  }
  return base::Combine(lies, file->second);
}

base::Digest PicturesDigest(const road::World& world) {
  base::Digest digest = 0;
  PictureDigests pictures;
  for (const terrain::LaidPicture& picture : PicturesOf(world)) digest = base::Combine(digest, pictures.Of(picture));
  return digest;
}

}  // namespace rodeira::scene
