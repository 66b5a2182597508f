// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {

inline constexpr double kStep_s = 0.02;
inline constexpr VehicleKind kCar = VehicleKind::kCar;

// None is there but those that the test spawns; they neither change lanes nor overtake of themselves.
inline TrafficSettings OnlyScripted(std::vector<VehicleKind> kinds) {
  TrafficSettings settings;
  settings.vehicles = 0;
  settings.scripted = std::move(kinds);
  settings.changes_lanes = settings.overtaking.allowed = false;
  settings.speed_factor_low = settings.speed_factor_high = 1.0;
  return settings;
}

inline void Step(TrafficModel& model, int steps = 1) {
  for (int i = 0; i < steps; ++i) model.Step(kStep_s, {});
}

inline void Put(TrafficModel& model, std::uint32_t id, const std::string& lane, double s_m, double speed_mps) {
  const auto told = model.Spawn(id, lane, s_m, speed_mps);
  ASSERT_TRUE(told.ok()) << told.error().Text();
  ASSERT_TRUE(told.value());
}

inline const AgentPose* PoseOf(const TrafficModel& model, std::uint32_t id) {
  const auto found =
      std::find_if(model.poses().begin(), model.poses().end(), [id](const AgentPose& pose) { return pose.id == id; });
  return found == model.poses().end() ? nullptr : &*found;
}

}  // namespace rodeira::traffic
