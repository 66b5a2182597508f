// SPDX-License-Identifier: Apache-2.0
#include "common/driving/driver/way_from_start.hpp"

#include <fmt/format.h>

#include <utility>

#include "common/driving/driver/lane_path.hpp"
#include "common/driving/driver/route_path.hpp"

namespace rodeira::driver {
namespace {

constexpr double kRoute_m = 20'000.0;

}  // namespace

base::Result<WayAndLights> WayFromStart(const road::World& world, std::optional<int> lane_wish,
                                        const std::string& place) {
  const road::StartPose& start = world.start();
  if (world.network() != nullptr && world.roads().empty()) {
    const network::Network& network = *world.network();
    const auto at = network.Locate(start.x_m, start.y_m);
    if (!at || at->distance_m > 0.0 || at->lane.lane == 0)
      return base::WrongInput("this world has no lane to start on; the autopilot needs one", place);
    if (lane_wish && *lane_wish != at->lane.lane) {
      return base::WrongInput(fmt::format("the car starts in lane {} of road '{}'; no other one can be wished for",
                                          at->lane.lane, network.roads()[at->lane.road].id()),
                              place);
    }
    auto route = std::make_unique<RoutePath>(network, StraightOn(network, at->lane, kRoute_m));
    std::vector<LightLine> lines = LightLines(network, *route);
    return WayAndLights{std::move(route), std::move(lines)};
  }
  if (start.road < 0) return base::WrongInput("this world has no road to start on; the autopilot needs one", place);
  const road::Road& road = world.roads()[static_cast<std::size_t>(start.road)];
  const int lane = lane_wish.value_or(start.lane);
  if (road.section().FindLane(lane) == nullptr)
    return base::WrongInput(fmt::format("road '{}' has no lane {}", road.id(), lane), place);
  return WayAndLights{std::make_unique<LanePath>(road, lane), {}};
}

}  // namespace rodeira::driver
