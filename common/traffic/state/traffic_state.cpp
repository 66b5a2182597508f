// SPDX-License-Identifier: Apache-2.0
// What is saved of traffic, and how it goes on from there.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <sstream>
#include <string>
#include <utility>

#include "common/traffic/demand/requested_route.hpp"
#include "common/traffic/simulation.hpp"

namespace rodeira::traffic {

void Simulation::Save(base::StateWriter& writer) const {
  for (const Agent& agent : store.agents) writer.Put("agent", agent);
  if (store.full) writer.Put("full", *store.full);
  for (const MotorsDriver& driver : store.motors) writer.Put("motors", driver);
  if (store.people) writer.Put("people", *store.people);
  for (const Yielding& yielding : store.yielding) {
    writer.Put("yields", yielding.crossing);
    writer.Put("yielded_s", yielding.waited_s);
  }
  writer.Put("waiting", store.waiting);
  std::vector<std::uint32_t> appearing;
  std::vector<double> appearing_at;
  for (const SpawningVehicle& next : store.appearing) {
    appearing.insert(appearing.end(), {next.id, next.track});
    appearing_at.insert(appearing_at.end(), {next.d_m, next.speed_mps});
  }
  if (!settings.scripted.empty()) {
    writer.Put("appearing", appearing);
    writer.Put("appearing_at", appearing_at);
  }
  writer.Put("next_grant", store.next_grant);
  writer.Put("time_ns", store.time_ns);
  writer.Put("ended", store.ended);
  writer.Put("missed", store.missed);
  for (const FlowCount& flow : store.flows) {
    writer.Put("arrived", flow.arrived);
    writer.Put("given", flow.given);
    writer.Put("next_ns", flow.next_ns);
  }
  for (const Decided& decided : store.decided) writer.Put("decided", decided);
  if (!store.decided.empty()) writer.Put("looked_ns", store.looked_ns);
  for (const PastLeaders& past : store.past) writer.Put("past", past);
  store.light_holds.Save(writer);
  SaveRoutes(writer);
}

// Of vehicles with a route on request, which are few.
void Simulation::SaveRoutes(base::StateWriter& writer) const {
  for (std::uint32_t id = 0; id < store.agents.size(); ++id) {
    if (!store.agents[id].requested) continue;
    writer.Put("route_of", id);
    writer.Put("route", fmt::format("{}", fmt::join(store.agents[id].requested->ways, "\n")));
  }
}

void Simulation::RestoreRoutes(base::StateReader& reader) {
  for (Agent& agent : store.agents) agent.requested.reset();
  while (reader.Has("route_of")) {
    std::uint32_t id = 0;
    std::string text;
    reader.Get("route_of", id);
    reader.Get("route", text);
    RouteSettings asked;
    std::istringstream lines(text);
    for (std::string way; std::getline(lines, way);) asked.ways.push_back(way);
    auto route = Route::Make(map->graph, map->marks, asked);
    if (!route || id >= store.agents.size()) continue;
    store.agents[id].requested =
        std::make_shared<const RequestedRoute>(RequestedRoute{asked.ways, std::move(route).value()});
  }
}

void Simulation::RestorePast(base::StateReader& reader) {
  store.past.clear();
  while (reader.Has("past")) {
    reader.Get("past", store.past.emplace_back());
    PastLeaders& past = store.past.back();
    past.of.resize(store.agents.size());
    for (PastLeaders::Of& of : past.of) {
      if (of.id >= static_cast<std::int64_t>(store.agents.size())) of = {};
    }
  }
}

// A snapshot comes from outside: whatever it says, nothing is read beside the arrays.
void Simulation::Restore(base::StateReader& reader) {
  for (Agent& agent : store.agents) reader.Get("agent", agent);
  if (store.full) reader.Get("full", *store.full);
  for (MotorsDriver& driver : store.motors) {
    reader.Get("motors", driver);
    if (driver.track >= map->graph.tracks().size())
      driver.lanes = driver.track = 0;
    else
      driver.checkpoint = std::min(driver.checkpoint, motors_driving.MotorsPoints(driver) - 2);
  }
  if (store.people) reader.Get("people", *store.people);
  for (Yielding& yielding : store.yielding) {
    reader.Get("yields", yielding.crossing);
    reader.Get("yielded_s", yielding.waited_s);
  }
  seen.Forget();
  claimed.Forget();
  reader.Get("waiting", store.waiting);
  std::vector<std::uint32_t> appearing;
  std::vector<double> appearing_at;
  if (!settings.scripted.empty()) {
    reader.Get("appearing", appearing);
    reader.Get("appearing_at", appearing_at);
  }
  store.appearing.clear();
  for (std::size_t i = 0; 2 * i + 1 < appearing.size() && 2 * i + 1 < appearing_at.size(); ++i) {
    const SpawningVehicle next{appearing[2 * i], appearing[2 * i + 1], appearing_at[2 * i], appearing_at[2 * i + 1]};
    if (next.id < settings.vehicles || next.id >= store.agents.size() || next.track >= map->graph.tracks().size())
      continue;
    if (next.d_m >= 0.0 && next.d_m <= map->graph[next.track].length_m() && next.speed_mps >= 0.0)
      store.appearing.push_back(next);
  }
  reader.Get("next_grant", store.next_grant);
  reader.Get("time_ns", store.time_ns);
  reader.Get("ended", store.ended);
  reader.Get("missed", store.missed);
  for (FlowCount& flow : store.flows) {
    reader.Get("arrived", flow.arrived);
    reader.Get("given", flow.given);
    reader.Get("next_ns", flow.next_ns);
  }
  for (Decided& decided : store.decided) {
    reader.Get("decided", decided);
    if (decided.kept >= static_cast<std::int64_t>(store.agents.size())) decided.kept = -1;
  }
  if (!store.decided.empty()) reader.Get("looked_ns", store.looked_ns);
  RestorePast(reader);
  store.light_holds.Restore(reader, map->network->controllers());
  RestoreRoutes(reader);
  for (Agent& agent : store.agents) {
    const auto count = map->graph.tracks().size();
    if (agent.entry >= count ||
        std::any_of(agent.path.begin(), agent.path.end(), [&](const Piece& p) { return p.track >= count; }))
      agent = Agent();
    if (agent.overtaking.passed >= static_cast<std::int64_t>(store.agents.size())) agent = Agent();
    if (agent.flow >= static_cast<std::int32_t>(store.flows.size())) agent.flow = -1;
    const Route* route = RouteOf(*map, agent);
    if (route != nullptr) agent.leg = std::min(agent.leg, route->legs());
  }
  for (std::uint32_t id = 0; store.full && id < store.agents.size(); ++id) {
    if (!store.agents[id].on_road)
      store.full->Clear(id);
    else if (!store.full->cars().present(id))
      store.agents[id] = Agent();
  }
  for (std::uint32_t id = 0; !store.flows.empty() && id < store.agents.size(); ++id)
    store.traits[id] = arriving.TraitsFor(id);
  std::erase_if(store.waiting, [&](std::uint32_t id) { return id >= store.agents.size(); });
  signals.FindColours();
  for (std::uint32_t id = 0; id < store.decided.size(); ++id) {
    const Agent& agent = store.agents[id];
    if (!agent.on_road) continue;
    tracks.LookBelow(id);
    ways.FindRouteSegments(id, std::max(settings.sight_m, agent.granted_m - agent.o_m));
  }
  std::fill(step.is_moved.begin(), step.is_moved.end(), 0);
  body_poses.FindPoses();
}

}  // namespace rodeira::traffic
