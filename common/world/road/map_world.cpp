// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/map_world.hpp"

#include <utility>

#include "common/core/base/bytes.hpp"
#include "common/core/base/files.hpp"
#include "common/world/road/network_world.hpp"
#include "common/world/traffic_map/map_network.hpp"

namespace rodeira::road {
namespace {

// Of a file's bytes and of those beside it, where there are any.
base::Result<base::Digest> HashOfFiles(const std::filesystem::path& file) {
  base::ByteWriter all;
  const auto map = base::ReadText(file);
  if (!map) return map.error();
  all.PutString(map.value());
  std::filesystem::path beside = file;
  beside += ".yaml";
  std::error_code none;
  if (std::filesystem::exists(beside, none)) {
    const auto companion = base::ReadText(beside);
    if (!companion) return companion.error();
    all.PutString(companion.value());
  }
  return base::Hash(all.bytes());
}

}  // namespace

bool IsTrafficMap(const std::filesystem::path& file) { return file.extension() == ".motors"; }

base::Result<WorldSpec> ReadMapWorld(const std::filesystem::path& file) {
  auto network = traffic_map::LoadNetwork(file);
  if (!network) return network.error();
  const auto hash = HashOfFiles(file);
  if (!hash) return hash.error();
  WorldSpec spec;
  spec.name = file.stem().string();
  spec.network = std::move(network).value();
  spec.network_hash = hash.value();
  spec.start = StartOn(*spec.network);
  return spec;
}

}  // namespace rodeira::road
