// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>

#include "common/core/base/result.hpp"
#include "common/core/base/state.hpp"
#include "common/core/config/config.hpp"
#include "common/driving/driver/footprint.hpp"
#include "common/driving/driver/idm.hpp"
#include "common/driving/driver/leader.hpp"
#include "common/driving/driver/lights_ahead.hpp"
#include "common/driving/driver/pedals.hpp"
#include "common/driving/driver/speed_plan.hpp"
#include "common/driving/driver/steering.hpp"
#include "common/driving/driver/way.hpp"
#include "common/vehicle/dynamics/controls.hpp"
#include "common/vehicle/dynamics/vehicle_model.hpp"

namespace rodeira::driver {

// The settings of a driver file.
struct AutopilotSettings {
  IdmSettings idm;
  SpeedPlanSettings speed{.stop_at_end = true};
  SteeringSettings steering;
  PedalSettings pedals;
  LightSettings lights;
  double speed_factor = 0.98;   // of the legal limit: a margin for slopes and gear changes
  double anticipation_s = 0.5;  // preview of the speed plan, for the lag of pedals and engine
  double tracking_s = 1.0;      // time constant of speed control
  double side_margin_m = 0.3;   // objects nearer to the car's sides block its way
  double range_m = 150.0;       // sight
  double far_off_m = 2.5;       // beyond this lateral offset from the lane it drives slowly
  double slowly_mps = 4.0;
};

// `rodeira: driver/1`. Problems stay in the file's collection.
AutopilotSettings ReadAutopilot(const config::Map& root);
// Wrong input, with place and reason, where the file is missing or faulty.
base::Result<AutopilotSettings> LoadDriver(const std::filesystem::path& path);

// What the driver perceives.
struct DriverView {
  const dynamics::VehicleState& own;
  const dynamics::VehicleDimensions& dimensions;
  std::span<const Footprint> others;        // without the own car
  std::span<const LightAhead> lights = {};  // on its route, ascending; also passed ones
};

// State of the car.
struct CarMotion {
  Eigen::Vector3d p_WB_W = Eigen::Vector3d::Zero();
  double heading_rad = 0.0, speed_mps = 0.0;
  double wheelbase_m = 0.0, front_m = 0.0;  // of the front bumper from B's origin
};

// What the driver aims at, for displays.
struct Aim {
  double speed_mps = 0.0;  // allowed by limit, bends, crests and the route's end; without leaders and obstacles
  Eigen::Vector2d target_W = Eigen::Vector2d::Zero();  // the point of the way that is steered for
  double way_heading_rad = 0.0;                        // of the way beside the car
  Eigen::Vector2d look_ahead_W =
      Eigen::Vector2d::Zero();  // up to where on the way the driver looks for what slows the car
};

// Drives a lane by steering wheel, pedals and selector alone: at the speed that limit, bends, crests and slopes allow,
// behind a leader by the IDM, to a stop before what blocks the lane, at lights, and before the road's end.
class Autopilot {
 public:
  // Follows this way.
  Autopilot(const AutopilotSettings& settings, std::unique_ptr<const Way> way);

  // The controls for the coming dt_s (over 0), from what is seen now.
  dynamics::Controls Step(const DriverView& view, double dt_s);
  // Takes over steering wheel and pedals from another source, where they are.
  void InitialiseFrom(const dynamics::Controls& last);

  // What Step would aim at there; changes no state. Nothing beyond the route's ends.
  std::optional<Aim> AimOf(const CarMotion& car) const;

  const Way& path() const { return *path_; }
  // For displays: the speed that is allowed here, and what is followed.
  double allowed_mps() const { return allowed_mps_; }
  const std::optional<Leader>& leader() const { return leader_; }

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);

 private:
  double WantedAcceleration(const DriverView& view, const Way::Place& place);
  SpeedPlan::Allowed AllowedTo(const Way::Place& place, double limit_mps, double speed_mps, double heading_rad) const;
  Eigen::Vector2d TargetFrom(const Way::Place& place, double half_base_m, double speed_mps) const;
  double SteeringWheel(const DriverView& view, const Way::Place& place, double dt_s);

  AutopilotSettings settings_;
  std::unique_ptr<const Way> path_;
  SpeedPlan plan_;
  Pedals pedals_;
  LightStops light_stops_;
  double steering_wheel_rad_ = 0.0;
  double allowed_mps_ = 0.0;
  std::optional<Leader> leader_;
  // Where the car and the others were found last. They only save work, and are no part of the state.
  std::size_t place_hint_ = 0;
  LeaderHints leader_hints_;
};

}  // namespace rodeira::driver
