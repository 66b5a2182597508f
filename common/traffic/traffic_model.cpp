// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/traffic_model.hpp"

#include <fmt/format.h>

#include <utility>

#include "common/core/base/assert.hpp"
#include "common/traffic/network/long_enough.hpp"
#include "common/traffic/network/road_network.hpp"
#include "common/traffic/simulation.hpp"

namespace rodeira::traffic {

TrafficModel::TrafficModel(std::unique_ptr<Simulation> simulation) : simulation_(std::move(simulation)) {}
TrafficModel::TrafficModel(const TrafficModel& other) : simulation_(std::make_unique<Simulation>(*other.simulation_)) {}
TrafficModel& TrafficModel::operator=(const TrafficModel& other) {
  simulation_ = std::make_unique<Simulation>(*other.simulation_);
  return *this;
}
TrafficModel::TrafficModel(TrafficModel&& other) noexcept = default;
TrafficModel& TrafficModel::operator=(TrafficModel&& other) noexcept = default;
TrafficModel::~TrafficModel() = default;

base::Result<TrafficModel> TrafficModel::Make(const TrafficSettings& settings, std::shared_ptr<const road::World> world,
                                              std::span<const driver::Footprint> others) {
  RODEIRA_ASSERT(world != nullptr);
  const auto network = NetworkOf(world);
  auto model = Make(settings, network, others, world);
  if (!model && network->roads().empty()) {
    return base::WrongInput("world.no_lane",
                            "the world '" + world->name() +
                                "' has no lane to put traffic on; a world with a road, or 0 vehicles, was expected");
  }
  return model;
}

base::Result<TrafficModel> TrafficModel::Make(const TrafficSettings& settings,
                                              std::shared_ptr<const network::Network> network,
                                              std::span<const driver::Footprint> others) {
  RODEIRA_ASSERT(network != nullptr);
  return Make(settings, network, others, nullptr);
}

base::Result<TrafficModel> TrafficModel::Make(const TrafficSettings& settings,
                                              std::shared_ptr<const network::Network> network,
                                              std::span<const driver::Footprint> others,
                                              std::shared_ptr<const road::World> world) {
  const auto map = std::make_shared<TrafficMap>(std::move(network), settings);
  auto demand = Demand::Make(map->graph, map->marks, settings.demand);
  if (!demand) return demand.error();
  map->demand = std::move(demand).value();
  const double longest_m = LargestOf(settings).length_m;
  for (std::size_t i = 0; i < map->demand.flows().size(); ++i) {
    if (map->demand.flows()[i].track < 0) continue;
    const auto track = static_cast<std::uint32_t>(map->demand.flows()[i].track);
    if (!IsLongEnough(map->graph, track, longest_m)) {
      const FlowSettings& flow = settings.demand.flows[i];
      return base::WrongInput("traffic.no_room",
                              fmt::format("the lane '{}' and the ways on from it are shorter than a vehicle; at least "
                                          "{:.1f} m were expected",
                                          flow.lane, longest_m),
                              flow.place);
    }
    map->LetEnter(track);
  }
  if (settings.vehicles > 0 && map->entries.empty()) {
    return base::WrongInput("world.no_lane",
                            "the network '" + map->network->name() +
                                "' has no lane to put traffic on; drivable lanes that are longer than a vehicle, or 0 "
                                "vehicles, were expected");
  }
  TrafficModel model(std::make_unique<Simulation>(TrafficData(settings, map)));
  Simulation& simulation = *model.simulation_;
  if (settings.pedestrians) {
    auto people = Pedestrians::Make(map->graph, LargestOf(settings), *settings.pedestrians, settings.seed);
    if (!people) return people.error();
    simulation.store.people = std::move(people).value();
  }
  if (const auto status = lanes::CheckLights(map->graph, map->zones); !status) return status.error();
  simulation.signals.FindColours();
  if (!settings.demand.flows.empty())
    simulation.arriving.BeginFlows();
  else if (settings.vehicles > 0)
    simulation.placing.PlaceAll(others);
  if (settings.physics == Physics::kFull) {
    if (world == nullptr) world = WorldOf(map->network);
    simulation.full_motion.StartFull(world->MakeGround());
    if (settings.driver == DriverKind::kMotors) simulation.motors_driving.StartMotors();
  }
  simulation.body_poses.FindPoses();
  return model;
}

void TrafficModel::Step(double dt_s, std::span<const driver::Footprint> others) { simulation_->Step(dt_s, others); }
void TrafficModel::Save(base::StateWriter& writer) const { simulation_->Save(writer); }
void TrafficModel::Restore(base::StateReader& reader) { simulation_->Restore(reader); }

const std::vector<AgentPose>& TrafficModel::poses() const { return simulation_->store.poses; }
const AgentTraits& TrafficModel::traits(std::uint32_t id) const { return simulation_->store.traits[id]; }
const Agent& TrafficModel::agent(std::uint32_t id) const { return simulation_->store.agents[id]; }
const MotorsDriver* TrafficModel::motors(std::uint32_t id) const {
  return simulation_->store.motors.empty() ? nullptr : &simulation_->store.motors[id];
}
const FullCars* TrafficModel::full() const { return simulation_->store.full ? &*simulation_->store.full : nullptr; }
std::size_t TrafficModel::vehicles() const { return simulation_->store.agents.size(); }
std::size_t TrafficModel::waiting() const { return simulation_->store.waiting.size(); }
const std::vector<FlowCount>& TrafficModel::flows() const { return simulation_->store.flows; }
std::uint64_t TrafficModel::ended() const { return simulation_->store.ended; }
const std::vector<Leaver>& TrafficModel::leavers() const { return simulation_->step.leavers; }
std::uint64_t TrafficModel::missed() const { return simulation_->store.missed; }
const Pedestrians* TrafficModel::people() const {
  return simulation_->store.people ? &*simulation_->store.people : nullptr;
}
double TrafficModel::GapAhead(std::uint32_t id) const { return simulation_->seen.ahead[id].gap_m; }
bool TrafficModel::RoomAhead(std::uint32_t id) const { return simulation_->room.RoomAhead(id); }
bool TrafficModel::Hurries(std::uint32_t id) const { return simulation_->step.hurries[id] != 0; }
std::uint32_t TrafficModel::LightsOf(const AgentPose& pose) const { return simulation_->details.LightsOf(pose); }
std::vector<AgentDetail> TrafficModel::Details() { return simulation_->details.Details(); }
const std::vector<network::LightColour>& TrafficModel::colours() const { return simulation_->step.colours; }
double TrafficModel::FreeSpeed_mps(std::uint32_t track, double d_m) const {
  return simulation_->map->plans[track].plan.At(d_m).speed_mps;
}
const lanes::Graph& TrafficModel::graph() const { return simulation_->map->graph; }
const lanes::Zones& TrafficModel::zones() const { return simulation_->map->zones; }

}  // namespace rodeira::traffic
