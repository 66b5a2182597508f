#include "common/traffic/road_network.hpp"

#include "common/opendrive/import.hpp"
#include "common/road/world_export.hpp"

namespace rodeira::traffic {

base::Result<std::shared_ptr<const network::Network>> NetworkOf(const std::shared_ptr<const road::World>& world) {
  if (world->network() != nullptr) return std::shared_ptr<const network::Network>(world, world->network());
  if (world->roads().empty()) return std::make_shared<const network::Network>(network::NetworkSpec{});
  const auto text = road::ExportOpenDrive(*world);
  if (!text) return text.error();
  auto import = opendrive::Read(text.value(), world->name() + ".xodr");
  if (!import) return import.error();
  if (!import.value().errors.empty()) return opendrive::ToError(import.value().errors.front(), world->name());
  return import.value().network;
}

}  // namespace rodeira::traffic
