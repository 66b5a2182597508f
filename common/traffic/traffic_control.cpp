// SPDX-License-Identifier: Apache-2.0
// What requests ask of vehicles and lights while a run goes: routes, vehicles that come and go, held lights.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "common/core/base/assert.hpp"
#include "common/core/base/suggest.hpp"
#include "common/traffic/demand/requested_route.hpp"
#include "common/traffic/results/names.hpp"
#include "common/traffic/simulation.hpp"
#include "common/traffic/state/vehicle_way.hpp"
#include "common/traffic/traffic_model.hpp"
#include "common/world/lanes/lights.hpp"

namespace rodeira::traffic {
namespace {

using network::LightColour;

constexpr std::size_t kMaxRoadsAhead = 16, kMaxTracksWalked = 256;
constexpr double kReacts_s = 1.0;    // before it slows down for another way
constexpr double kSameWay_m = 1e-6;  // two ways that part no more than this apart part at the same place

base::Result<std::shared_ptr<const RequestedRoute>> RouteOver(const TrafficMap& map,
                                                              const std::vector<std::string>& roads) {
  auto route = Route::Make(map.graph, map.marks, {"request", roads, ""});
  if (!route) return route.error();
  return std::make_shared<const RequestedRoute>(RequestedRoute{roads, std::move(route).value()});
}

base::Error NoWay(const lanes::Graph& graph, std::uint32_t track, const std::string& to) {
  const network::LaneKey& lane = graph[track].lane;
  return base::WrongInput("traffic.no_way", fmt::format("no way leads from the lane '{}:{}' to '{}'",
                                                        graph.network().roads()[lane.road].id(), lane.lane, to));
}

// The odometer at which the second way leaves the first; far away where it does not.
double PartsAt_m(const RouteSegments& first, const RouteSegments& second) {
  for (std::size_t i = 0; i < first.size() && i < second.size(); ++i) {
    if (first[i].track != second[i].track || std::fabs(first[i].begin_m - second[i].begin_m) > kSameWay_m)
      return std::min(first[i].begin_m, second[i].begin_m);
  }
  return kNoBarrier_m;
}

// Controllers that must not be green or amber together: their ways cross or merge; or a crossing for people on foot
// lies behind the light of vehicles, and the plans never let both go.
std::vector<std::array<std::uint32_t, 2>> FindConflicts(const TrafficMap& map, const Pedestrians* people) {
  auto pairs = lanes::ConflictingControllers(map.graph, map.zones);
  if (people == nullptr) return pairs;
  const auto controllers = map.network->controllers();
  for (const lanes::FootCrossing& crossing : people->crossings()) {
    if (crossing.light < 0) continue;
    for (const lanes::FootPass& pass : crossing.passes) {
      if (pass.light < 0) continue;
      const auto one = static_cast<std::uint32_t>(crossing.light), other = static_cast<std::uint32_t>(pass.light);
      if (!network::MeetGreen(*controllers[one].times, *controllers[other].times)) pairs.push_back({one, other});
    }
  }
  return pairs;
}

}  // namespace

base::Result<std::uint32_t> TrafficModel::Add(VehicleKind kind, const std::string& lane, double s_m, double speed_mps,
                                              const std::vector<std::string>& roads) {
  Simulation& simulation = *simulation_;
  const auto& scripted = simulation.settings.scripted;
  std::optional<std::uint32_t> id;
  for (std::uint32_t i = 0; i < scripted.size() && !id; ++i) {
    const std::uint32_t next = simulation.settings.vehicles + i;
    const Agent& agent = simulation.store.agents[next];
    if (scripted[i] == kind && !agent.on_road && !agent.is_crashed && !IsSpawning(next)) id = next;
  }
  if (!id)
    return base::WrongInput("traffic.not_scripted",
                            fmt::format("no '{}' is left to add; one more was expected under 'scripted' of the "
                                        "traffic's settings, which has {} of them",
                                        NameOf(kind), std::ranges::count(scripted, kind)));
  std::shared_ptr<const RequestedRoute> requested;
  if (!roads.empty()) {
    auto route = RouteOver(*simulation.map, roads);
    if (!route) return route.error();
    requested = std::move(route).value();
  }
  if (const auto told = Spawn(*id, lane, s_m, speed_mps); !told) return told.error();
  const std::uint32_t track = simulation.store.appearing.back().track;
  if (requested && !requested->route.Reaches(requested->route.LegOn(0, track), track)) {
    simulation.store.appearing.pop_back();
    return NoWay(simulation.map->graph, track, roads.front());
  }
  simulation.store.agents[*id].requested = std::move(requested);
  return *id;
}

base::Status TrafficModel::Remove(std::uint32_t id) {
  Simulation& simulation = *simulation_;
  RODEIRA_ASSERT(id < simulation.store.agents.size());
  const Agent& agent = simulation.store.agents[id];
  const auto& waiting = simulation.store.waiting;
  if (!agent.on_road && !agent.is_crashed && !IsSpawning(id) && std::ranges::find(waiting, id) == waiting.end())
    return base::WrongInput("traffic.not_on_road", fmt::format("agent {} is not on the road", id));
  auto& removals = simulation.step.removals;
  const auto at = std::ranges::lower_bound(removals, id);
  if (at == removals.end() || *at != id) removals.insert(at, id);
  return {};
}

base::Status TrafficModel::SetRoute(std::uint32_t id, const std::vector<std::string>& roads) {
  Simulation& simulation = *simulation_;
  RODEIRA_ASSERT(id < simulation.store.agents.size() && simulation.store.agents[id].on_road);
  Agent& agent = simulation.store.agents[id];
  if (agent.overtaking.active())
    return base::WrongInput("traffic.not_now", fmt::format("agent {} overtakes; ask again when it is back", id));
  auto made = RouteOver(*simulation.map, roads);
  if (!made) return made.error();
  const Route& route = made.value()->route;
  const std::uint32_t track = agent.path.back().track, leg = route.LegOn(0, track);
  if (!route.Reaches(leg, track)) return NoWay(simulation.map->graph, track, roads.front());
  const AgentTraits& traits = simulation.store.traits[id];
  const auto way = [&] {
    simulation.seen.way_keys[id] = {};
    simulation.ways.FindRouteSegments(id, simulation.settings.sight_m);
    return simulation.seen.stretches[id];
  };
  const RouteSegments before = way();
  const auto requested = std::exchange(agent.requested, std::move(made).value());
  const std::uint32_t leg_before = std::exchange(agent.leg, leg);
  const double v = agent.speed_mps,
               slows_m = FrontOf(agent, traits) + v * kReacts_s + v * v / (2.0 * traits.idm.braking_mps2);
  const double parts_m = PartsAt_m(before, way());
  simulation.seen.way_keys[id] = {};
  const bool reserved = parts_m < agent.granted_m, late = parts_m < slows_m && v > 0.0;
  if (!reserved && !late) return {};
  agent.requested = requested, agent.leg = leg_before;
  return base::WrongInput("traffic.not_now",
                          reserved ? fmt::format("agent {} has reserved its way through a junction; ask again when it "
                                                 "has passed, or earlier",
                                                 id)
                                   : fmt::format("agent {} is {:.1f} m before the place where the ways part, too near "
                                                 "at {:.1f} m/s; ask earlier",
                                                 id, std::max(0.0, parts_m - FrontOf(agent, traits)), v));
}

std::vector<std::string> TrafficModel::RoadsAhead(std::uint32_t id) const {
  const Simulation& simulation = *simulation_;
  RODEIRA_ASSERT(id < simulation.store.agents.size() && simulation.store.agents[id].on_road);
  const Agent& agent = simulation.store.agents[id];
  const TrafficMap& map = *simulation.map;
  const auto road = [&](std::uint32_t track) { return map.graph.network().roads()[map.graph[track].lane.road].id(); };
  std::vector<std::string> roads{road(PieceAt(agent.path, agent.o_m).track)};
  if (RouteOf(map, agent) != nullptr) {
    const std::int64_t number = agent.requested ? -1 : map.demand.flows()[static_cast<std::size_t>(agent.flow)].route;
    const auto& ways = agent.requested ? agent.requested->ways
                                       : simulation.settings.demand.routes[static_cast<std::size_t>(number)].ways;
    for (std::size_t leg = agent.leg; leg < ways.size(); ++leg) roads.push_back(ways[leg]);
    return roads;
  }
  Choice choice{agent.links, 0};
  std::uint32_t track = agent.path.back().track;
  for (std::size_t i = 0; i < kMaxTracksWalked && roads.size() < kMaxRoadsAhead; ++i) {
    if (map.graph[track].junction < 0 && road(track) != roads.back()) roads.push_back(road(track));
    if (map.graph[track].next.empty()) break;
    track = NextLink(map, simulation.settings.seed, id, agent, track, choice).to;
  }
  return roads;
}

base::Status TrafficModel::HoldLight(const std::string& controller, LightColour colour, double duration_s) {
  Simulation& simulation = *simulation_;
  RODEIRA_ASSERT((colour == LightColour::kRed || colour == LightColour::kGreen) && duration_s >= 0.0);
  const auto controllers = simulation.map->network->controllers();
  const auto found = std::ranges::find(controllers, controller, &network::Controller::id);
  if (found == controllers.end() || !found->times) {
    std::vector<std::string> known;
    for (const network::Controller& other : controllers) {
      if (other.times) known.push_back(other.id);
    }
    return base::WrongInput(
        "traffic.unknown_light",
        found == controllers.end()
            ? fmt::format("there is no controller '{}' of lights{}", controller, base::DidYouMean(controller, known))
            : fmt::format("the controller '{}' has no times: its lights are dark", controller));
  }
  const auto index = static_cast<std::uint32_t>(found - controllers.begin());
  const std::int64_t now_ns = simulation.store.time_ns;
  if (colour == LightColour::kGreen && simulation.signals.ColourAt(index, now_ns) == LightColour::kAmber)
    return base::WrongInput("traffic.not_now",
                            fmt::format("the light '{}' shows amber; ask again when it shows red", controller));
  LightHolds holds = simulation.store.light_holds;
  holds.Set(HoldFor(holds, index, *found->times, colour, now_ns, std::llround(duration_s * 1e9)));
  auto& conflicts = simulation.step.conflicting_lights;
  if (!conflicts) conflicts = FindConflicts(*simulation.map, people());
  for (const auto& [a, b] : *conflicts) {
    if (a != index && b != index) continue;
    const auto together_ns = FirstTogether_ns(holds, controllers, a, b, now_ns);
    if (!together_ns) continue;
    return base::WrongInput(
        "traffic.conflicting_green",
        fmt::format("the light '{}' would let traffic go together with the light '{}', across or into its "
                    "way, {:.1f} s from now; ask for red of that one first",
                    controller, controllers[a == index ? b : a].id, 1e-9 * static_cast<double>(*together_ns - now_ns)));
  }
  simulation.store.light_holds = std::move(holds);
  return {};
}

}  // namespace rodeira::traffic
