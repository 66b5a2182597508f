#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/base/result.hpp"
#include "common/base/state.hpp"
#include "common/driver/footprint.hpp"
#include "common/driver/lane_path.hpp"
#include "common/driver/speed_plan.hpp"
#include "common/road/world.hpp"
#include "common/traffic/traffic_settings.hpp"

namespace rodeira::traffic {

// One agent as others see it. B as for vehicles: midway between the axles, at the road's height; x forward, y left.
struct AgentPose {
  std::uint32_t id = 0;
  std::uint32_t trip = 0;  // how often it has entered the road; another trip is another appearance
  Eigen::Vector3d p_WB_W = Eigen::Vector3d::Zero();
  Eigen::Quaterniond q_WB = Eigen::Quaterniond::Identity();
  double speed_mps = 0.0;
  double acceleration_mps2 = 0.0;
  double steer_rad = 0.0;       // of the front wheels, positive to the left
  double wheel_spin_rad = 0.0;  // in (-pi, pi]
  bool braking = false;         // its brake lights
  std::int32_t road = 0;        // index into World::roads()
  std::int32_t lane = 0;        // id within that road
};

// The rectangle of an agent.
driver::Footprint FootprintOf(const AgentPose& pose, const AgentTraits& traits);

// Cars that follow the lanes of a world's roads, each lane by itself, with the IDM, at the speed that limit, bends and
// crests allow. A car that reaches a lane's end leaves and enters again, by lot, where a lane begins, as soon as there is a
// safe gap: their number never changes. They see other vehicles (the driver's car) by their rectangles and stop for what
// stands in their lane. They do not overtake and do not change lanes. Nothing here depends on order of arrival, threads or
// the clock: the state is Save's, and each step is a function of it and of `others`.
class TrafficModel {
 public:
  // Places the agents on all lanes, clear of `others`; who finds no room waits to enter. Wrong input where there should be
  // vehicles and the world has no lane.
  static base::Result<TrafficModel> Make(const TrafficSettings& settings, std::shared_ptr<const road::World> world,
                                         std::span<const driver::Footprint> others);

  void Step(double dt_s, std::span<const driver::Footprint> others);

  // A scenario's commands, from the next step on until the agent leaves the road or is released. An agent that waits to
  // enter obeys when it has entered.
  void Brake(std::uint32_t id, double deceleration_mps2);  // at exactly this rate down to rest, and stay; harder where it must
  void CapSpeed(std::uint32_t id, double speed_mps);       // never faster
  void Release(std::uint32_t id);
  // The next agent in front of this rectangle, in the lane on which its middle stands and whose way it faces; nothing where
  // none is in sight. One of the agents itself (by its id) is not in front of itself.
  std::optional<std::uint32_t> AheadOf(const driver::Footprint& other) const;

  // Those on the road, by ascending id.
  const std::vector<AgentPose>& poses() const { return poses_; }
  const AgentTraits& traits(std::uint32_t id) const { return traits_[id]; }
  std::size_t on_road() const { return poses_.size(); }
  std::size_t vehicles() const { return agents_.size(); }
  std::size_t waiting() const { return agents_.size() - poses_.size(); }

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);

 private:
  static constexpr double kNoCap_mps = 1e3;
  struct Lane {
    driver::LanePath path;
    driver::SpeedPlan plan;
    std::int32_t road = 0;
    std::vector<std::uint32_t> order;    // agents on it, from its beginning to its end
    std::vector<std::uint32_t> waiting;  // to enter, first come first
  };
  struct Agent {
    std::int32_t lane = 0;  // on it, or waiting for it
    bool on_road = false;
    double d_m = 0.0;  // of its middle
    double speed_mps = 0.0;
    double acceleration_mps2 = 0.0;
    double driven_m = 0.0;
    std::uint32_t trip = 0;
    double brake_mps2 = 0.0;  // commanded; 0: not
    double cap_mps = kNoCap_mps;
  };
  // The next thing ahead of a place in a lane: the car in front, and what else stands there.
  struct Ahead {
    double gap_m = 0.0;
    double speed_mps = 0.0;
    bool any = false;
  };
  using Blocks = std::vector<std::vector<driver::LaneSpan>>;  // the others, a lane

  TrafficModel(const TrafficSettings& settings, std::shared_ptr<const road::World> world);

  Blocks BlocksOf(std::span<const driver::Footprint> others) const;
  void PlaceAll(const Blocks& blocks);
  Ahead BlockAhead(std::size_t lane, const Blocks& blocks, double middle_m, const AgentTraits& traits) const;
  double Wanted(std::size_t lane, std::size_t place, const Blocks& blocks) const;
  double Desired(std::size_t lane, std::uint32_t id) const;
  void Move(std::uint32_t id, double acceleration_mps2, double dt_s);
  void Leave(std::size_t lane);
  void Enter(std::size_t lane, const Blocks& blocks);
  std::int32_t DrawLane(std::uint32_t id, std::uint32_t trip) const;
  void FindPoses();
  AgentPose PoseOf(std::uint32_t id) const;

  TrafficSettings settings_;
  std::shared_ptr<const road::World> world_;
  std::vector<AgentTraits> traits_;
  std::vector<Lane> lanes_;
  std::vector<Agent> agents_;
  std::vector<AgentPose> poses_;
};

}  // namespace rodeira::traffic
