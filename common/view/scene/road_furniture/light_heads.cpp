// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/road_furniture/light_heads.hpp"

#include <map>
#include <string>

#include "common/view/scene/road_furniture/models.hpp"
#include "common/view/scene/road_furniture/static_objects.hpp"

namespace rodeira::scene {
namespace {

constexpr const char* kOnFoot = "1000002";

std::map<std::string, std::uint32_t> ControllersOfSignals(const network::Network& network) {
  std::map<std::string, std::uint32_t> of;
  for (std::uint32_t i = 0; i < network.controllers().size(); ++i) {
    if (!network.controllers()[i].times) continue;
    for (const network::ControllerEntry& entry : network.controllers()[i].controls) of.emplace(entry.signal_id, i);
  }
  if (of.empty()) return of;
  for (const network::Road& road : network.roads()) {
    for (const network::Signal& signal : road.spec().signals) {
      if (signal.type == kOnFoot) of.erase(signal.id);
    }
  }
  return of;
}

}  // namespace

Stand StandOfLight(const Stand& post, double above_m, double height_m, double side) {
  const Stand turned{post.foot_W, side * post.x_W};
  return {turned.ToWorld({kPost_m + kLightHousing * height_m, 0.0, above_m}), turned.x_W};
}

std::vector<LightHead> LightHeads(const road::World& world) {
  std::vector<LightHead> heads;
  if (world.network() == nullptr) return heads;
  const auto controllers = ControllersOfSignals(*world.network());
  if (controllers.empty()) return heads;
  const StaticObjects things(world);
  for (const auto& [key, tile] : things.tiles()) {
    for (const Thing& thing : tile.things) {
      const auto found = controllers.find(thing.signal);
      if (thing.kind != ThingKind::kTrafficLight || found == controllers.end()) continue;
      heads.push_back({found->second, StandOfLight(thing.stand, thing.above_m, thing.height_m, 1.0), thing.height_m});
      if (thing.both_sides)
        heads.push_back(
            {found->second, StandOfLight(thing.stand, thing.above_m, thing.height_m, -1.0), thing.height_m});
    }
  }
  return heads;
}

}  // namespace rodeira::scene
