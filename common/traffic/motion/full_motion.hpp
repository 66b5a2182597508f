// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/traffic/motion/full_cars.hpp"
#include "common/traffic/perception/current_tracks.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"
#include "common/vehicle/dynamics/car_array.hpp"

namespace rodeira::traffic {

// Vehicles with the physics of the driver's car.
class FullMotion {
 public:
  struct Reads {
    std::span<const AgentTraits> traits;
    const CurrentTracks& tracks;
  };
  struct Writes {
    std::span<Agent> agents;
    std::optional<FullCars>& full;
    std::vector<std::uint32_t>& waiting;
  };
  FullMotion(const Reads& reads, const Writes& writes) : in_(reads), out_(writes) {}

  // A vehicle that cannot stand where it was to begin waits to enter.
  void StartFull(std::shared_ptr<ground::Ground> ground);
  // With its axles' middles over the path, rolling along it.
  base::Status PlaceFull(std::uint32_t id);
  // Finds pedals and steering for the coming dt_s; the cars move in FullCars::Step.
  void DriveFull(std::uint32_t id, double wanted_mps2, double dt_s);
  // Where its path has brought it, after the physics' step.
  void FollowFull(std::uint32_t id, double dt_s);

 private:
  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic
