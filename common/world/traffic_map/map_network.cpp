// SPDX-License-Identifier: Apache-2.0
#include "common/world/traffic_map/map_network.hpp"

#include "common/world/opendrive/import.hpp"
#include "common/world/traffic_map/open_drive.hpp"

namespace rodeira::traffic_map {

base::Result<std::shared_ptr<const network::Network>> ToNetwork(const LaneMap& map, const std::string& name) {
  const auto drive = ToOpenDrive(map, name, Junctions::kDirect);
  if (!drive) return drive.error().WithContext(name);
  const auto import = opendrive::Read(drive.value().xml, name, opendrive::Tolerance::Unrepaired());
  if (!import) return import.error();
  // A line of the OpenDRIVE in between would say nothing to the author of the map; its roads have the numbers of the
  // lanes.
  if (!import.value().errors.empty())
    return base::WrongInput("map.wrong_element", import.value().errors.front().Text(), name);
  return import.value().network;
}

base::Result<std::shared_ptr<const network::Network>> LoadNetwork(const std::filesystem::path& path) {
  const auto made = LoadLaneMap(path);
  if (!made) return made.error();
  return ToNetwork(made.value(), path.string());
}

}  // namespace rodeira::traffic_map
