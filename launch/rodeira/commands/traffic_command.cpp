// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/traffic_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "common/core/base/print_error.hpp"
#include "common/traffic/demand/map_demand.hpp"
#include "common/traffic/motion/drivetrain.hpp"
#include "common/traffic/network/road_network.hpp"
#include "common/traffic/network/tight_bends.hpp"
#include "common/traffic/results/names.hpp"
#include "common/traffic/results/study.hpp"
#include "common/traffic/signals/map_lights.hpp"
#include "common/world/lanes/lights.hpp"
#include "common/world/lanes/signs.hpp"
#include "common/world/road/map_world.hpp"
#include "common/world/road/world.hpp"
#include "common/world/traffic_map/heights.hpp"
#include "launch/rodeira/commands/traffic_files.hpp"
#include "launch/rodeira/input_files.hpp"
#include "launch/rodeira/wall_clock.hpp"
#include "launch/rodeira/world_warnings.hpp"

namespace rodeira::cli {
namespace {

constexpr double kCell_m = 1.0;         // of the statistics of lanes
constexpr double kRowsEvery_s = 0.5;    // where it is not said
constexpr double kLongestFull_s = 0.1;  // step with full physics

// As the file of settings says; without flows there those of a traffic map's companion.
base::Result<traffic::TrafficSettings> HowTrafficIs(const TrafficOptions& options) {
  traffic::TrafficSettings settings;
  settings.vehicles = 50;
  if (!options.settings.empty()) {
    auto loaded = traffic::LoadTraffic(options.settings, options.seed);
    if (!loaded) return loaded.error();
    settings = std::move(loaded).value();
  }
  settings.seed = options.seed;
  if (!options.physics.empty())
    settings.physics = options.physics == "full" ? traffic::Physics::kFull : traffic::Physics::kPlanar;
  if (!options.driver.empty())
    settings.driver = options.driver == "motors" ? traffic::DriverKind::kMotors : traffic::DriverKind::kStandard;
  if (settings.driver == traffic::DriverKind::kMotors) {
    if (options.physics == "planar")
      return base::WrongInput(
          "traffic.wrong_combination",
          "'--physics planar' was given; the driver 'motors' holds pedals and steering wheel: full was expected");
    if (settings.pedestrians)
      return base::WrongInput("traffic.wrong_combination",
                              "the driver 'motors' sees no pedestrians; no 'pedestrians' were expected",
                              options.settings);
    settings.physics = traffic::Physics::kFull;
  }
  if (settings.demand.flows.empty() && road::IsTrafficMap(options.map)) {
    const auto companion = traffic_map::LoadHeightsOf(options.map);
    if (!companion) return companion.error();
    settings.demand.flows = traffic::DemandOf(companion.value(), options.map + ".yaml").flows;
    if (!settings.demand.flows.empty()) settings.vehicles = traffic::TrafficSettings::kMaxOfFlows;
  }
  if (options.vehicles) settings.vehicles = *options.vehicles;
  return settings;
}

// A steering wheel that is held for longer leads off the road.
base::Status CheckStep(const TrafficOptions& options, const traffic::TrafficSettings& settings) {
  if (settings.physics == traffic::Physics::kPlanar || options.step_s <= kLongestFull_s) return {};
  return base::WrongInput(
      "command.wrong_value",
      fmt::format("{} s were given with full physics; at most {} s were expected", options.step_s, kLongestFull_s),
      "--step");
}

// How long a study took: in all, and from the first step to the last.
struct StudyTimes {
  double all_s = 0.0, steps_s = 0.0, steps_cpu_s = 0.0;
};

// Of all threads of this process.
double ProcessorTime_s() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void PrintStudy(const TrafficOptions& options, const traffic::StudyResult& r, const StudyTimes& times) {
  fmt::print("vehicles         {} on the road, {} waiting to enter, {} trips ended\n", r.on_road, r.waiting,
             r.arrivals);
  fmt::print("entered, left    {} came onto the road, {} left it; {} were there at the beginning\n", r.entered, r.left,
             r.began);
  for (std::size_t reason = 0; reason < traffic::kLeaveReasons; ++reason) {
    if (r.left_because[reason] > 0)
      fmt::print("left because     {}: {}\n", NameOf(static_cast<traffic::LeaveReason>(reason)),
                 r.left_because[reason]);
  }
  fmt::print("driven           {:.3f} km at {:.2f} m/s in the mean\n", r.driven_km, r.mean_speed_mps());
  const double litres = r.fuel_mg / traffic::kFuelDensity_mgpl;
  fmt::print("fuel             {:.3f} l, {:.2f} l/100 km\n", litres,
             r.driven_km > 0.0 ? 100.0 * litres / r.driven_km : 0.0);
  const auto stand = [](double time_s, std::uint32_t id) {
    return time_s > 0.0 ? fmt::format("{:.1f} s (car {})", time_s, id) : std::string("0.0 s");
  };
  fmt::print("standing         {:.1f} % of the time, at most {}, with room ahead {}\n",
             r.vehicle_s > 0.0 ? 100.0 * r.standing_s / r.vehicle_s : 0.0, stand(r.longest_stand_s, r.longest_stand_id),
             stand(r.longest_with_room_s, r.longest_with_room_id));
  fmt::print(
      "hardest braking  {:.2f} m/s2 with a foot on the brake, which asks it for {:.2f} m/s2 at most; {:.2f} m/s2 in "
      "all\n",
      r.max_deceleration_mps2, r.foot_mps2, r.max_deceleration_any_mps2);
  fmt::print("emergencies      {} steps of a vehicle\n", r.hurried_steps);
  if (r.checked) {
    fmt::print("collisions       {}\n", r.collisions);
    fmt::print("red lights       passed {} times\n", r.reds);
    fmt::print("beside its lane  {} times, a wheel off the road {} times, checked every {} s\n", r.off_lane,
               r.wheels_off, std::max(std::min(0.1, RowsEvery_s(options)), options.step_s));
  } else {
    fmt::print("checks           off: overlaps, red lights and lanes were not checked\n");
  }
  fmt::print("wall time        {:.2f} s, {:.1f} times real time, {:.0f} vehicle steps a second\n", times.all_s,
             options.duration_s / times.all_s, r.vehicle_s / options.step_s / times.steps_s);
  fmt::print("processor time   {:.2f} s in steps, {:.0f} vehicle steps a second\n", times.steps_cpu_s,
             r.vehicle_s / options.step_s / times.steps_cpu_s);
  for (const std::string& incident : r.incidents) fmt::print("incident         {}\n", incident);
}

struct FlowsSeen {
  std::vector<traffic::TrafficModel::FlowCount> flows;
  std::uint64_t missed = 0;
};

void PrintFlows(const FlowsSeen& seen) {
  for (std::size_t f = 0; f < seen.flows.size(); ++f) {
    fmt::print("flow {:<12}{} arrived, {} of them without a vehicle yet\n", f + 1, seen.flows[f].arrived,
               seen.flows[f].arrived - seen.flows[f].given);
  }
  if (!seen.flows.empty()) fmt::print("lanes missed     {} times a route's lane was not reached\n", seen.missed);
}

}  // namespace

double RowsEvery_s(const TrafficOptions& options) {
  return options.rows_every_s.value_or(std::max(kRowsEvery_s, options.step_s));
}

int TrafficRun(const TrafficOptions& given) {
  auto map = ResolveInputFile(InputKind::kWorld, given.map);
  if (!map) return base::PrintError("rodeira", map.error());
  TrafficOptions options = given;
  options.map = std::move(map).value();
  const auto world = LoadWorldAndWarn(options.map);
  if (!world) return base::PrintError("rodeira", world.error());
  const auto network = traffic::NetworkOf(world.value());
  if (road::IsTrafficMap(options.map)) {
    if (const auto lit = traffic::CheckLightsOfMap(options.map); !lit) return base::PrintError("rodeira", lit.error());
  }
  auto how = HowTrafficIs(options);
  if (!how) return base::PrintError("rodeira", how.error());
  traffic::StudySettings settings;
  settings.traffic = std::move(how).value();
  if (const auto fits = CheckStep(options, settings.traffic); !fits) return base::PrintError("rodeira", fits.error());
  settings.duration_s = options.duration_s;
  settings.step_s = options.step_s;
  settings.watch_s = std::max(std::min(0.1, RowsEvery_s(options)), options.step_s);
  settings.checks = !options.no_check;
  auto opened = TrafficFiles::Open(options, *network);
  if (!opened) return base::PrintError("rodeira", opened.error());
  TrafficFiles files = std::move(opened).value();
  if (files.wants_cells()) settings.cell_m = kCell_m;
  settings.warm_s = options.warm_s, settings.every_s = options.every_s;
  if (!options.quiet) {
    for (const std::string& controller : lanes::DarkControllers(*network))
      fmt::print(stderr, "rodeira: warning: {}: the lights of controller '{}' have no times and are dark\n",
                 options.map, controller);
  }
  if (!options.quiet && settings.traffic.physics == traffic::Physics::kFull) {
    const lanes::Graph graph(*network);
    for (const traffic::TightBend& bend : traffic::TightBendsOf(graph, settings.traffic))
      fmt::print(stderr, "rodeira: warning: {}: {}\n", options.map, traffic::Text(bend, graph));
  }
  const bool terminal = !options.quiet && ::isatty(STDERR_FILENO) == 1;
  const auto begin = WallClock::now();
  std::optional<std::pair<WallClock::time_point, double>> stepping;  // since when, and at which processor time
  bool shown = false;
  FlowsSeen flows;
  const auto watch = [&](const traffic::StudyMoment& moment) {
    files.Write(moment);
    if (!stepping) stepping.emplace(WallClock::now(), ProcessorTime_s());
    flows.flows = moment.model.flows(), flows.missed = moment.model.missed();
    if (!terminal || SecondsSince(begin) < 2.0) return;
    fmt::print(stderr, "\r{:3.0f} %", 100.0 * moment.time_s / options.duration_s);
    shown = true;
  };
  const auto result = traffic::RunStudy(settings, world.value(), watch);
  StudyTimes times{SecondsSince(begin), 0.0, 0.0};
  if (stepping) times.steps_s = SecondsSince(stepping->first), times.steps_cpu_s = ProcessorTime_s() - stepping->second;
  if (shown) fmt::print(stderr, "\r     \r");
  if (!result) return base::PrintError("rodeira", result.error());
  const auto written = files.Close(*network, result.value());
  if (!written) return base::PrintError("rodeira", written.error());
  if (options.quiet) return 0;
  PrintStudy(options, result.value(), times);
  PrintFlows(flows);
  for (const std::string& file : written.value()) fmt::print("wrote            {}\n", file);
  return 0;
}

}  // namespace rodeira::cli
