// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "common/core/base/state.hpp"
#include "common/runtime/lockstep/inbox.hpp"
#include "common/runtime/lockstep/step.hpp"
#include "common/vehicle/dynamics/collision_space.hpp"
#include "idl/messages.hpp"
#include "nodes/vehicle/obstacle_map.hpp"

namespace rodeira::nodes {

// What a car hits: the agents of traffic and the other cars that its node sees, and what stands in the world. Of what
// it returns everything follows from the car's state, the inbox and which partners the step before touched; only these
// are its state.
class Collisions {
 public:
  Collisions(const dynamics::VehicleDimensions& dimensions, ObstacleMap world);

  // What a step's contacts do to the car.
  struct Touched {
    dynamics::Wrench push;  // on the car, for the step that begins now
    msg::Collisions event;  // the same as impulses over that step
  };
  // For the step that begins. Agents are where their last published speed has carried them since.
  base::Result<Touched> Find(const dynamics::VehicleState& car, const lockstep::Inbox& inbox,
                             const lockstep::StepInfo& step);

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);

 private:
  struct Partner {
    std::uint32_t kind = 0;  // as in collisions.idl
    std::uint32_t source = 0;
    std::uint32_t id = 0;

    std::uint64_t key() const {
      return (static_cast<std::uint64_t>(kind) << 63) | (static_cast<std::uint64_t>(source) << 32) | id;
    }
  };

  // What a stream of traffic has said last, read once.
  struct Said {
    std::shared_ptr<const base::Bytes> payload;
    msg::TrafficState state;
  };

  base::Status SeeTraffic(const dynamics::VehicleState& car, const lockstep::Inbox& inbox,
                          const lockstep::StepInfo& step);
  base::Status SeeCars(const dynamics::VehicleState& car, const lockstep::Inbox& inbox, const lockstep::StepInfo& step);
  void SeeWorld(const dynamics::VehicleState& car);
  msg::Contact EventOf(const dynamics::Impact& impact, double dt_s) const;

  ObstacleMap world_;
  dynamics::CollisionSpace space_;
  double reach_m_;
  std::vector<std::uint64_t> touched_;  // partners of the last step
  std::map<std::uint32_t, Said> said_;  // by stream
  // Of one step.
  std::vector<dynamics::Obstacle> obstacles_;
  std::vector<Partner> partners_;
};

}  // namespace rodeira::nodes
