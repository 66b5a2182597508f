// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/dynamic_objects/driver_aims.hpp"

#include <charconv>
#include <cmath>
#include <utility>

#include "common/core/base/constants.hpp"
#include "common/driving/driver/way_from_start.hpp"
#include "idl/topics.hpp"

namespace rodeira::nodes {
namespace {

std::unique_ptr<driver::Autopilot> Make(const CarAutopilot& autopilot, const road::World& world) {
  const auto settings = driver::LoadDriver(autopilot.driver);
  auto way = driver::WayFromStart(world, autopilot.lane, "");
  if (!settings || !way) return nullptr;
  return std::make_unique<driver::Autopilot>(settings.value(), std::move(way.value().way));
}

}  // namespace

std::optional<CarAutopilot> AutopilotOf(const launch::Launch& launch, lockstep::NodeIndex vehicle) {
  const lockstep::Roster& roster = launch.roster();
  for (const lockstep::Port& port : roster.node(vehicle).inputs) {
    if (port.topic != idl::topics::kControls) continue;
    for (const lockstep::SourceIndex source : port.sources) {
      const launch::LaunchNode& input = launch.node(roster.source(source).node);
      const auto file = input.config->Peek({"config", "driver"}), lane = input.config->Peek({"config", "lane"});
      if (input.config->Peek({"config", "source"}) != "autopilot" || !file) continue;
      CarAutopilot autopilot{(launch.path().parent_path() / *file).lexically_normal(), std::nullopt};
      int number = 0;
      if (lane && std::from_chars(lane->data(), lane->data() + lane->size(), number).ec == std::errc{})
        autopilot.lane = number;
      return autopilot;
    }
  }
  return std::nullopt;
}

std::optional<DriverAim> DriverAims::Of(const scene::CarPose& car) {
  const auto autopilot = autopilots_.find(car.id);
  if (autopilot == autopilots_.end()) return std::nullopt;
  auto made = made_.find(car.id);
  if (made == made_.end()) made = made_.emplace(car.id, Make(autopilot->second, world_)).first;
  if (made->second == nullptr) return std::nullopt;
  const Eigen::Vector3d ahead_W = car.q_WB * Eigen::Vector3d::UnitX();
  const double heading_rad = std::atan2(ahead_W.y(), ahead_W.x());
  const auto aim = made->second->AimOf({car.p_WB_W, heading_rad, car.speed_mps, car.wheelbase_m, car.front_m});
  if (!aim) return std::nullopt;
  return DriverAim{aim->speed_mps, Eigen::Rotation2Dd(-heading_rad) * (aim->target_W - car.p_WB_W.head<2>()),
                   std::remainder(aim->way_heading_rad - heading_rad, 2.0 * base::kPi), aim->look_ahead_W};
}

}  // namespace rodeira::nodes
