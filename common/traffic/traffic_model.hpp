// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/core/base/state.hpp"
#include "common/driving/driver/footprint.hpp"
#include "common/traffic/results/agent_detail.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/flow_count.hpp"
#include "common/traffic/state/leaving.hpp"
#include "common/traffic/state/traffic_settings.hpp"
#include "common/world/lanes/graph.hpp"
#include "common/world/lanes/zones.hpp"
#include "common/world/network/lights.hpp"

namespace rodeira::road {
class World;
}

namespace rodeira::traffic {

class FullCars;
class MotorsDriver;
class Pedestrians;
struct Simulation;

// Vehicles on the lanes of a network. Each chooses its way at random at every branch and follows its leader by the IDM,
// at the speed that limits, bends and crests allow. It enters conflict zones only with a reservation of all zones up to
// the next place where it can stop clear of them (docs/explanation/traffic.md). A vehicle that reaches the end of its
// last lane leaves and enters again at a random entry, as soon as there is a safe gap: the number of vehicles is
// constant. With flows (DemandSettings) vehicles enter as the flows say, with or without a route, and are removed at
// the end of their way. They see other vehicles (the driver's car) as rectangles, wherever these are. On roads of
// several lanes they change lanes by MOBIL. A step is a function of the state (Save) and of `others` alone; order of
// arrival, threads and the clock do not matter. One thread calls; a step itself uses the threads of its settings.
// Points and rectangles are in W.
class TrafficModel {
 public:
  TrafficModel(const TrafficModel& other);
  TrafficModel& operator=(const TrafficModel& other);
  TrafficModel(TrafficModel&& other) noexcept;
  TrafficModel& operator=(TrafficModel&& other) noexcept;
  ~TrafficModel();

  // Places the agents on all lanes, clear of `others`; one without room waits to enter. Wrong input where there should
  // be vehicles and the world has no lane.
  static base::Result<TrafficModel> Make(const TrafficSettings& settings, std::shared_ptr<const road::World> world,
                                         std::span<const driver::Footprint> others);
  // The same on a network without terrain.
  static base::Result<TrafficModel> Make(const TrafficSettings& settings,
                                         std::shared_ptr<const network::Network> network,
                                         std::span<const driver::Footprint> others);

  // One step of dt_s seconds. `others`: rectangles in W of the vehicles that are not agents.
  void Step(double dt_s, std::span<const driver::Footprint> others);

  // An id of an agent, here and below, is below vehicles(): a larger one is a caller's fault.
  // A scenario's commands, from the next step on until the agent leaves the road or is released. An agent that waits to
  // enter obeys when it has entered.
  void Brake(std::uint32_t id,
             double deceleration_mps2);  // above 0; at exactly this rate down to rest, and stay; harder where it must
  void CapSpeed(std::uint32_t id, double speed_mps);   // above 0; never faster
  void HoldSpeed(std::uint32_t id, double speed_mps);  // CapSpeed in place of Brake
  // Once, as soon as the plan of overtaking allows it, without being held up first, or, on a road of several lanes, as
  // soon as the lane beside is free.
  void CommandOvertake(std::uint32_t id);
  // Once, to the lane on its left (+1) or right (-1), as soon as marks, road and safety allow it, whatever it brings.
  void CommandLaneChange(std::uint32_t id, int side);
  void Release(std::uint32_t id);  // forgets all that
  // One of the settings' `scripted` comes onto a lane (ROAD:LANE), with its middle at a station of the road, no faster
  // than asked and than lets it stop before what is ahead: in this step's end, or the first one in which there is room
  // for it. Wrong input with a sentence where there can never be room; false where it is on the road already, or waits
  // to be.
  base::Result<bool> Spawn(std::uint32_t id, const std::string& lane, double s_m, double speed_mps);
  // Whether it ever could; Wrong input as Spawn's.
  base::Status CheckSpawn(std::uint32_t id, const std::string& lane, double s_m) const;
  // Whether it waits for room after Spawn.
  bool IsSpawning(std::uint32_t id) const;
  // Of one of the settings' `scripted` of that kind that is not on the road and does not wait to be: Spawn, with a
  // route (ROAD or ROAD:LANE, one after the other; empty: none). Its id.
  base::Result<std::uint32_t> Add(VehicleKind kind, const std::string& lane, double s_m, double speed_mps,
                                  const std::vector<std::string>& roads);
  // It leaves in the next step's end, wherever it is, and never enters again; one that waits does so no more. Wrong
  // input where it is neither on the road nor waits.
  base::Status Remove(std::uint32_t id);
  // From here on it drives to these roads or lanes, one after the other. Wrong input where no way leads there, or it is
  // too late: the ways part where its place is reserved, or before it could slow down.
  base::Status SetRoute(std::uint32_t id, const std::vector<std::string>& roads);
  // The road that it is on, then those of its route that it has not reached; without a route the next roads on its way,
  // 16 at most, without those of junctions.
  std::vector<std::string> RoadsAhead(std::uint32_t id) const;
  // A controller's lights show red or green for that long, from now on; 0 s of red: until its plan shows red. Amber and
  // red with amber are kept. Wrong input where it would be green or amber together with one that it must not meet.
  base::Status HoldLight(const std::string& controller, network::LightColour colour, double duration_s);
  // An impulse on an agent's body, N s, at a point, both in W: from then on it drives no more, but slides on locked
  // wheels and stays where it comes to rest, an obstacle to all others. A push that would change its speed by less than
  // 1 mm/s is nothing to it as long as it drives; nothing happens to one that is not there.
  void Strike(std::uint32_t id, const Eigen::Vector2d& impulse_Ns, const Eigen::Vector2d& point_W);
  // The next agent in front of this rectangle, in the lane on which its middle stands and along which it faces, or
  // further on the way, and within sight; nothing where none is. One of the agents itself (by its id) is not in front
  // of itself.
  std::optional<std::uint32_t> LeaderOf(const driver::Footprint& other) const;

  // All agents on the road, including crashed ones, by ascending id: poses in W after the last step. The next step
  // replaces them.
  const std::vector<AgentPose>& poses() const;
  // What an agent is (size, driver), and its state after the last step; the references hold until the next step.
  const AgentTraits& traits(std::uint32_t id) const;
  // Precondition: id is below the settings' number of vehicles.
  const Agent& agent(std::uint32_t id) const;
  // MOTORS' driver of an agent; null where others drive.
  const MotorsDriver* motors(std::uint32_t id) const;
  // The cars with full physics, one a place by id; null in planar mode.
  const FullCars* full() const;
  std::size_t on_road() const { return poses().size(); }
  std::size_t vehicles() const;  // all agents: on the road, waiting or gone
  std::size_t waiting() const;   // agents that wait to enter
  // By flow of the settings.
  using FlowCount = traffic::FlowCount;
  const std::vector<FlowCount>& flows() const;
  // How many vehicles have reached the end of their way so far.
  std::uint64_t ended() const;
  // Vehicles that left the road in the last step, by ascending number.
  const std::vector<Leaver>& leavers() const;
  // How often a vehicle did not get over to the lane that its route goes on from.
  std::uint64_t missed() const;
  // Those on foot; null where the settings have no `pedestrians`. All other numbers here count vehicles alone.
  const Pedestrians* people() const;
  // One more comes to the crossing of a road nearest to a station, from the road's left or right, at once. Wrong input
  // where there is none, or the settings have no `pedestrians`.
  base::Status SpawnPedestrian(std::string_view road, double s_m, bool from_left);
  base::Status CheckSpawnPedestrian(std::string_view road,
                                    double s_m) const;  // whether a pedestrian can be called there
  // The pedestrian with this number has been hit and stays there.
  void HitPedestrian(std::uint32_t id);
  // In metres from its front bumper to its leader, as it was seen in the last step; 1e9 where none is in sight.
  double GapAhead(std::uint32_t id) const;
  // Whether a standing agent has where to go, as it was seen in the last step: none within 5 m before it or, where it
  // stands at a line before conflict zones, none up to where it would stand behind them.
  bool RoomAhead(std::uint32_t id) const;
  // Whether its driver braked in an emergency in the last step (docs/explanation/traffic.md).
  bool Hurries(std::uint32_t id) const;
  // Which lights it shows, bits as in vehicle.idl: brake 1, left 2, right 4. One that changes lanes, or is to turn
  // within 30 m or three seconds, indicates; in a roundabout only one that leaves it.
  std::uint32_t LightsOf(const AgentPose& pose) const;
  // Of those on the road, in the order of poses().
  std::vector<AgentDetail> Details();
  // By the network's controllers: what their lights show. Those without times are dark, and show red here.
  const std::vector<network::LightColour>& colours() const;
  // The speed that limit, bends, crests and descents of this track allow at d_m metres along it, without other
  // vehicles.
  double FreeSpeed_mps(std::uint32_t track, double d_m) const;
  const lanes::Graph& graph() const;
  const lanes::Zones& zones() const;

  // Restore takes the state of a model that was made with the same settings and network.
  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);

 private:
  explicit TrafficModel(std::unique_ptr<Simulation> simulation);
  static base::Result<TrafficModel> Make(const TrafficSettings& settings,
                                         std::shared_ptr<const network::Network> network,
                                         std::span<const driver::Footprint> others,
                                         std::shared_ptr<const road::World> world);

  std::unique_ptr<Simulation> simulation_;
};

}  // namespace rodeira::traffic
