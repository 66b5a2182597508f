// SPDX-License-Identifier: Apache-2.0
// What a scenario tells agents to do.
#include <cmath>
#include <utility>

#include "common/core/base/assert.hpp"
#include "common/traffic/simulation.hpp"
#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {
namespace {

// What a driver is told holds in the next step, whenever it would decide.
void DecideAnew(VehicleStore& store, std::uint32_t id) {
  if (!store.decided.empty()) store.decided[id].trip = -1;
}

}  // namespace

void TrafficModel::Brake(std::uint32_t id, double deceleration_mps2) {
  RODEIRA_ASSERT(id < simulation_->store.agents.size() && deceleration_mps2 > 0.0);
  simulation_->store.agents[id].brake_mps2 = deceleration_mps2;
}

void TrafficModel::CapSpeed(std::uint32_t id, double speed_mps) {
  RODEIRA_ASSERT(id < simulation_->store.agents.size() && speed_mps > 0.0);
  simulation_->store.agents[id].cap_mps = speed_mps;
  DecideAnew(simulation_->store, id);
}

void TrafficModel::HoldSpeed(std::uint32_t id, double speed_mps) {
  CapSpeed(id, speed_mps);
  simulation_->store.agents[id].brake_mps2 = 0.0;
}

void TrafficModel::Release(std::uint32_t id) {
  RODEIRA_ASSERT(id < simulation_->store.agents.size());
  simulation_->store.agents[id].brake_mps2 = 0.0;
  simulation_->store.agents[id].cap_mps = Agent::kNoCap_mps;
  simulation_->store.agents[id].told_side = 0;
  simulation_->store.agents[id].told_past = false;
  DecideAnew(simulation_->store, id);
}

void TrafficModel::CommandOvertake(std::uint32_t id) {
  RODEIRA_ASSERT(id < simulation_->store.agents.size());
  simulation_->store.agents[id].told_past = true;
}

void TrafficModel::CommandLaneChange(std::uint32_t id, int side) {
  RODEIRA_ASSERT(id < simulation_->store.agents.size() && (side == 1 || side == -1));
  simulation_->store.agents[id].told_side = side;
}

std::optional<std::uint32_t> TrafficModel::LeaderOf(const driver::Footprint& other) const {
  constexpr double kWidest_m = 4.0;
  constexpr std::size_t kMaxWays = 256;
  std::vector<std::vector<std::pair<double, std::uint32_t>>> on(
      simulation_->map->graph.tracks().size());  // middles of the agents, by track
  for (std::uint32_t id = 0; id < simulation_->store.agents.size(); ++id) {
    if (!simulation_->store.agents[id].on_road || id == other.id) continue;
    for (const Piece& piece : simulation_->store.agents[id].path)
      on[piece.track].emplace_back(simulation_->store.agents[id].o_m - piece.zero_m, id);
  }
  struct Way {
    std::uint32_t track;
    double from_m;  // d of the track's beginning as seen from the rectangle's middle
  };
  std::vector<Way> ways;
  for (const lanes::Graph::Beside& beside : simulation_->map->graph.TracksAt({other.x_m, other.y_m}, kWidest_m)) {
    const lanes::Curve& curve = simulation_->map->graph[beside.track].curve;
    const lanes::CurvePoint at = curve.At(beside.foot.d_m);
    if (std::fabs(beside.foot.offset_m) > 0.5 * curve.WidthAt(beside.foot.d_m)) continue;
    if (at.ahead_W.dot(Eigen::Vector2d(std::cos(other.heading_rad), std::sin(other.heading_rad))) <= 0.0) continue;
    if (std::fabs((Eigen::Vector2d(other.x_m, other.y_m) - at.p_W.head<2>()).dot(at.ahead_W)) > 1e-3)
      continue;  // beyond an end
    ways.push_back({beside.track, -beside.foot.d_m});
  }
  std::optional<std::uint32_t> nearest;
  double gap_m = simulation_->settings.sight_m;
  for (std::size_t i = 0; i < ways.size() && i < kMaxWays; ++i) {
    const Way way = ways[i];
    const double end = way.from_m + simulation_->map->graph[way.track].length_m();
    for (const auto& [middle, id] : on[way.track]) {
      const double gap = way.from_m + middle;
      if (gap <= 0.0 || gap > gap_m || gap > end) continue;
      gap_m = gap;
      nearest = id;
    }
    if (end > gap_m) continue;
    for (const lanes::Link& link : simulation_->map->graph[way.track].next)
      ways.push_back({link.to, end - link.from_d_m});
  }
  return nearest;
}

void TrafficModel::Strike(std::uint32_t id, const Eigen::Vector2d& impulse_Ns, const Eigen::Vector2d& point_W) {
  simulation_->crashes.Strike(id, impulse_Ns, point_W);
}

bool TrafficModel::IsSpawning(std::uint32_t id) const { return simulation_->appearing_vehicles.IsSpawning(id); }

base::Status TrafficModel::CheckSpawn(std::uint32_t id, const std::string& lane, double s_m) const {
  return simulation_->appearing_vehicles.CheckSpawn(id, lane, s_m);
}

base::Result<bool> TrafficModel::Spawn(std::uint32_t id, const std::string& lane, double s_m, double speed_mps) {
  return simulation_->appearing_vehicles.Spawn(id, lane, s_m, speed_mps);
}

base::Status TrafficModel::CheckSpawnPedestrian(std::string_view road, double s_m) const {
  return simulation_->crosswalks.CheckSpawnPedestrian(road, s_m);
}

base::Status TrafficModel::SpawnPedestrian(std::string_view road, double s_m, bool from_left) {
  return simulation_->crosswalks.SpawnPedestrian(road, s_m, from_left);
}

void TrafficModel::HitPedestrian(std::uint32_t id) {
  if (simulation_->store.people) simulation_->store.people->Hit(id);
}

}  // namespace rodeira::traffic
