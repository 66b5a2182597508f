// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "common/driving/driver/autopilot.hpp"
#include "common/runtime/launch/launch.hpp"
#include "common/view/scene/vehicles/scene_snapshot.hpp"
#include "common/world/road/world.hpp"
#include "nodes/view/frame/picture.hpp"

namespace rodeira::nodes {

// An autopilot that drives a car of the run: its driver's file, and the lane that it was told.
struct CarAutopilot {
  std::filesystem::path driver;
  std::optional<int> lane;
};
// By the cars' ids.
using CarAutopilots = std::map<std::uint64_t, CarAutopilot>;

// Of a vehicle's node; nothing where no autopilot's controls lead to it. What is wrong there the input itself says.
std::optional<CarAutopilot> AutopilotOf(const launch::Launch& launch, lockstep::NodeIndex vehicle);

// What the autopilots of driven cars go by. It is not published: it follows from the car's state, its driver's file and
// the world, by the driver's own code.
class DriverAims {
 public:
  // The world must outlive it.
  DriverAims(CarAutopilots autopilots, const road::World& world) : autopilots_(std::move(autopilots)), world_(world) {}
  // Nothing where no autopilot drives the car, or where it is beside its way's ends. The first time a way is made (some
  // 0.1 s for 20 km).
  std::optional<DriverAim> Of(const scene::CarPose& car);

 private:
  CarAutopilots autopilots_;
  const road::World& world_;
  std::map<std::uint64_t, std::unique_ptr<driver::Autopilot>> made_;  // null: none can be
};

}  // namespace rodeira::nodes
