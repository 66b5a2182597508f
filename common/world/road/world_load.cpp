// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/file_cache.hpp"
#include "common/core/config/config.hpp"
#include "common/world/road/kept_world.hpp"
#include "common/world/road/map_world.hpp"
#include "common/world/road/network_world.hpp"
#include "common/world/road/world.hpp"
#include "common/world/road/world_reader.hpp"

namespace rodeira::road {
namespace {

base::Result<std::shared_ptr<const World>> Build(const base::Result<config::File>& file, base::FileCache* cache) {
  if (!file) return file.error();
  WorldReading reading = ReadWorld(file.value(), cache);
  if (!reading.spec) return reading.problems.front();
  return World::Make(std::move(*reading.spec));
}

}  // namespace

base::Result<std::shared_ptr<const World>> World::Load(const std::filesystem::path& world_yaml) {
  if (auto kept = KeptWorld::Find(world_yaml)) return kept;
  if (auto other = WhatWorldsName(world_yaml)) return *std::move(other);
  const bool is_map = IsTrafficMap(world_yaml);
  if (!is_map && !IsOpenDrive(world_yaml)) return Build(config::File::Load(world_yaml), &base::UserCache());
  auto spec = is_map ? ReadMapWorld(world_yaml) : ReadNetworkWorld(world_yaml);
  if (!spec) return spec.error();
  return Make(std::move(spec).value());
}

base::Result<std::shared_ptr<const World>> World::Parse(std::string_view text, const std::filesystem::path& name) {
  return Build(config::File::Parse(text, name), nullptr);
}

}  // namespace rodeira::road
