// SPDX-License-Identifier: Apache-2.0
#include "common/driving/driver/way_from_start.hpp"

#include <fmt/format.h>

#include <utility>

#include "common/driving/driver/route_path.hpp"

namespace rodeira::driver {
namespace {

constexpr double kRoute_m = 20'000.0;

}  // namespace

base::Result<WayAndLights> WayFromStart(const road::World& world, std::optional<int> wanted_lane,
                                        const std::string& place) {
  const road::StartPose& start = world.start();
  if (world.network() == nullptr || world.network()->roads().empty())
    return base::WrongInput("world.no_lane", "this world has no road to start on; the autopilot needs one", place);
  const network::Network& network = *world.network();
  const auto at = network.Locate(start.x_m, start.y_m);
  if (!at || at->distance_m > 0.0 || at->lane.lane == 0) {
    const std::string nearest = at ? fmt::format("; road '{}' is nearest: s_m {:.1f}, t_m {:.1f}",
                                                 network.roads()[at->lane.road].id(), at->s_m, at->t_m)
                                   : "";
    return base::WrongInput("world.no_lane",
                            fmt::format("the start of the world, x_m {:.2f} and y_m {:.2f}, is on no lane; the "
                                        "autopilot needs one{}",
                                        start.x_m, start.y_m, nearest),
                            place);
  }
  network::LaneKey lane = at->lane;
  lane.lane = wanted_lane.value_or(lane.lane);
  const network::Lane* found = network.Find(lane);
  if (found == nullptr || (lane.lane != at->lane.lane && !network::IsDrivable(found->type)))
    return base::WrongInput(
        "world.unknown_lane",
        fmt::format("road '{}' has no lane {} to drive on", network.roads()[lane.road].id(), lane.lane), place);
  auto route = std::make_unique<RoutePath>(network, StraightOn(network, lane, kRoute_m));
  std::vector<LightLine> lines = LightLines(network, *route);
  return WayAndLights{std::move(route), std::move(lines)};
}

}  // namespace rodeira::driver
