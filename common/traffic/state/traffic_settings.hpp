// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/core/config/config.hpp"
#include "common/driving/driver/idm.hpp"
#include "common/driving/driver/mobil.hpp"
#include "common/driving/driver/smooth.hpp"
#include "common/driving/driver/speed_plan.hpp"
#include "common/traffic/demand/demand_settings.hpp"
#include "common/traffic/overtaking/overtaking.hpp"
#include "common/traffic/pedestrians/pedestrian_settings.hpp"
#include "common/world/lanes/swath.hpp"

namespace rodeira::traffic {

// How agents' cars move.
enum class Physics {
  kPlanar,  // along their paths exactly, by the powertrain's steady state
  kFull,    // as the driver's car: four wheels with suspension and slipping tyres on the ground, the whole powertrain
};

// When a waiting vehicle enters the network.
enum class EnterRule {
  kSafe,  // as soon as it need not brake hard behind its leader
  kFree,  // as MOTORS has it: unless a vehicle stands within some metres of the lane's beginning
};

// The kind of driver.
enum class DriverKind {
  kStandard,
  kMotors,  // as MOTORS' own: gives way to the right and sees no other
};

// What a traffic source is told. Each agent draws its own values from the ranges, by seed and number.
struct TrafficSettings {
  static constexpr std::uint32_t kMaxOfFlows =
      1000;  // vehicles at a time where there are flows and nothing says how many

  std::uint64_t seed = 1;
  Physics physics = Physics::kPlanar;
  DriverKind driver = DriverKind::kStandard;  // MOTORS' drives with full physics alone
  std::uint32_t vehicles = 20;                // on the road and waiting to enter, together; never more, never fewer
  std::uint32_t threads = 1;                  // that work on a step; changes no result
  driver::IdmSettings idm;  // the middle of what agents draw: time gap and accelerations vary by `variety`
  double variety = 0.15;    // ± share
  driver::SpeedPlanSettings speed;
  driver::SmoothSettings smooth;
  double speed_factor_low = 0.85;  // share of the planned speed (limit, bends) that an agent drives
  double speed_factor_high = 1.0;
  double tracking_s = 1.0;     // time in which a deviation from the planned speed is made good
  double decide_s = 0.0;       // so often a driver decides on its acceleration; 0: in every step
  double reaction_s = 0.0;     // a driver sees its leader so much later
  double side_margin_m = 0.3;  // what comes nearer to an agent's sides is in its way
  double sight_m = 200.0;
  EnterRule enters = EnterRule::kSafe;
  double free_m = 5.0;  // of kFree
  bool changes_lanes = true;
  driver::MobilSettings lane_changes;
  OvertakingSettings overtaking;
  std::vector<VehicleKind>
      scripted;    // those that a scenario may spawn, beside `vehicles`: their numbers follow those of the others
  VehicleMix mix;  // of vehicles that belong to no flow with a mix of its own
  DemandSettings demand;  // with flows `vehicles` is how many there are at a time at most; the roads are empty at first
  std::optional<PedestrianSettings> pedestrians;  // none: crossings have no effect
};

// Reads `vehicles`, `following`, `comfort` … of a mapping; the seed is the run's. Problems stay in the file's
// collection.
TrafficSettings ReadTraffic(const config::Map& map, std::uint64_t seed);

// The same from a file of its own (`rodeira: traffic/1`).
base::Result<TrafficSettings> LoadTraffic(const std::filesystem::path& path, std::uint64_t seed);

// What does not change about one agent: a pure function of settings and its number, or of a flow's number in it.
struct AgentTraits {
  std::uint32_t body = 1;  // below kBodies
  VehicleKind kind = VehicleKind::kCar;
  double length_m = 4.0;
  double width_m = 1.7;
  double height_m = 1.45;
  double wheelbase_m = 2.5;
  double wheel_radius_m = 0.3;
  double mass_kg = 1300.0;
  std::uint32_t colour_rgb = 0x808080;
  double speed_factor = 1.0;
  double top_mps = 1e3;     // what the law, or its engine, lets it drive at most
  double start_mps2 = 1.3;  // acceleration by which others, and itself, tell when it comes
  driver::IdmSettings idm;
};
inline constexpr std::uint32_t kBodies = 8;
// Kind and measures of a body, all else as it is without draws.
AgentTraits TraitsOfBody(std::uint32_t body);
// Drawn from the mix by the settings' seed and the key alone: the same key gives the same traits.
AgentTraits TraitsOf(const TrafficSettings& settings, const VehicleMix& mix, std::uint64_t key);
// By its number: of the mix, or of the kind that is said where a scenario lets it appear.
AgentTraits TraitsOf(const TrafficSettings& settings, std::uint32_t id);

// The bodies that there may be any of, ascending.
std::vector<std::uint32_t> BodiesOf(const TrafficSettings& settings);
// The longest, widest and longest between axles of all kinds that there may be any of.
lanes::LargestCar LargestOf(const TrafficSettings& settings);

}  // namespace rodeira::traffic
