// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/world_weather.hpp"

#include "common/core/config/config.hpp"
#include "common/world/road/map_world.hpp"
#include "common/world/road/network_world.hpp"

namespace rodeira::road {

base::Result<std::optional<weather::Change>> WeatherOf(const std::filesystem::path& world_file) {
  if (IsOpenDrive(world_file) || IsTrafficMap(world_file)) return std::optional<weather::Change>();
  const auto file = config::File::Load(world_file);
  if (!file) return file.error();
  const config::Map root = file.value().root();
  if (!root.Has("weather")) return std::optional<weather::Change>();
  return std::optional(
      weather::ReadConstant(root.Child("weather")));  // the loader of the world tells what is wrong in it
}

}  // namespace rodeira::road
