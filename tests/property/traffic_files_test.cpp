// SPDX-License-Identifier: Apache-2.0
// What says which cars drive where: files of traffic, the companions of traffic maps with their lights, and scenarios,
// mutated by bytes and by structure (tests/property/fuzz.hpp) and taken all the way: to traffic that drives, or to one
// sentence.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>

#include "common/core/base/files.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "common/driving/scenario/scenario_file.hpp"
#include "common/traffic/demand/map_demand.hpp"
#include "common/traffic/traffic_model.hpp"
#include "common/world/traffic_map/heights.hpp"
#include "common/world/traffic_map/lane_map.hpp"
#include "common/world/traffic_map/map_network.hpp"
#include "tests/common/world/opendrive/sample.hpp"
#include "tests/property/fuzz.hpp"
#include "tests/property/mutate_structure.hpp"
#include "tests/tree.hpp"

namespace rodeira::property {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = SourceDir();

// With all that such a file may say.
constexpr const char* kDrivers = R"(rodeira: traffic/1
vehicles: 12
threads: 1
physics: planar
variety: 0.1
speed_factor_low: 0.8
speed_factor_high: 1.1
side_margin_m: 0.2
sight_m: 150
following: {time_gap_s: 1.2, min_gap_m: 2, acceleration_mps2: 1.4, braking_mps2: 2, max_deceleration_mps2: 8}
comfort: {lateral_mps2: 2, vertical_mps2: 2, braking_mps2: 1.5, steep_grade: 0.1, steep_factor: 0.8}
lane_changes: {allowed: true, politeness: 0.2, threshold_mps2: 0.1, bias_mps2: 0.3, safe_mps2: 2, overtaking: true,
  overtaking_sight_m: 300, overtaking_margin_s: 2}
mix: {car: 8, van: 1, lorry: 1, bus: 1}
entering: {rule: free, free_m: 6}
scripted: [car, lorry]
)";

constexpr const char* kFlows = R"(rodeira: traffic/1
routes:
  through: ["1", "2:-1"]
  back: ["2", "1"]
flows:
  - {lane: "1:-1", vehicles_per_h: 400, route: through}
  - {lane: "2:1", by_hour: [200, 500, 300], arrivals: even, route: back, from_s: 1, to_s: 500, mix: {bus: 1}}
  - {every_s: [3, 8]}
turns:
  - {lane: "1:-1", shares: {"2": 70}}
)";

// Two roads, one behind the other, with a lane for each direction.
std::shared_ptr<const network::Network> TwoRoads() {
  static const auto network = [] {
    opendrive::RoadText first, second;
    first.link = R"(<successor elementType="road" elementId="2" contactPoint="start"/>)";
    second.id = "2";
    second.link = R"(<predecessor elementType="road" elementId="1" contactPoint="end"/>)";
    second.geometry = R"(<geometry s="0" x="100" y="0" hdg="0" length="100"><line/></geometry>)";
    const std::string links = "<link><predecessor id=\"{0}\"/><successor id=\"{0}\"/></link>";
    for (opendrive::RoadText* road : {&first, &second}) {
      road->left.insert(road->left.find("<width"), fmt::format(fmt::runtime(links), 1));
      road->right.insert(road->right.find("<width"), fmt::format(fmt::runtime(links), -1));
    }
    return opendrive::MustRead(opendrive::Document(first.Text() + second.Text()));
  }();
  return network;
}

// It drives, with numbers that are numbers.
void Drive(traffic::TrafficModel& model) {
  for (int i = 0; i < 30; ++i) model.Step(0.1, {});
  for (const traffic::AgentPose& pose : model.poses()) {
    EXPECT_TRUE(pose.p_WB_W.allFinite() && std::isfinite(pose.speed_mps) && pose.speed_mps >= 0.0);
  }
}

std::optional<base::Error> ReadTraffic(const std::string& text) {
  static const auto folder = base::TemporaryFolder::Make("traffic-fuzz");
  if (!folder) return folder.error();
  const fs::path file = folder.value().path() / "fuzz.yaml";
  std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
  auto settings = traffic::LoadTraffic(file, 1);
  if (!settings) return settings.error();
  settings.value().vehicles = std::min(settings.value().vehicles, 40u);
  settings.value().threads = 1;
  settings.value().physics = traffic::Physics::kPlanar;
  auto model = traffic::TrafficModel::Make(settings.value(), TwoRoads(), {});
  if (!model) return model.error();
  Drive(model.value());
  return std::nullopt;
}

TEST(TrafficFiles, ChangedByBytes) { Fuzz("traffic", {kDrivers, kFlows, kFlows}, ReadTraffic); }

TEST(TrafficFiles, ChangedByStructure) {
  Fuzz("traffic, structure", {kDrivers, kFlows, kFlows}, ReadTraffic, MutateStructure);
}

// What each wrong word is answered, with the file and its line.
TEST(TrafficFiles, WhatIsNotThereIsNamed) {
  const auto said = [](const std::string& text) {
    const auto error = ReadTraffic("rodeira: traffic/1\n" + text);
    return error ? error->Text() : "taken";
  };
  EXPECT_NE(said("flows: [{lane: \"7:-1\", vehicles_per_h: 100}]\n").find("fuzz.yaml:2"), std::string::npos);
  EXPECT_NE(said("flows: [{lane: \"7:-1\", vehicles_per_h: 100}]\n").find("7"), std::string::npos);
  EXPECT_NE(said("flows: [{lane: \"1:-1\", vehicles_per_h: 100, route: thruogh}]\nroutes: {through: [\"1\", \"2\"]}\n")
                .find("through"),
            std::string::npos);
  EXPECT_NE(said("routes: {no: [\"1\", \"9\"]}\nflows: [{lane: \"1:-1\", vehicles_per_h: 100, route: no}]\n").find("9"),
            std::string::npos);
  EXPECT_NE(said("lane_changes: {overtakign: true}\n").find("overtaking"), std::string::npos);
  EXPECT_NE(said("lane_changes: {overtaking_margin_s: 0}\n").find("overtaking_margin_s"), std::string::npos);
}

// Programs of lights: where two may be green that cross, the model refuses them by name.
TEST(TrafficFiles, LightsOfMaps) {
  const auto folder = base::TemporaryFolder::Make("lights-fuzz");
  ASSERT_TRUE(folder.ok());
  const fs::path map = folder.value().path() / "fuzz.motors", companion = folder.value().path() / "fuzz.motors.yaml";
  fs::copy_file(kRoot / "configs/maps/lights.motors", map);
  const auto good = base::ReadText(kRoot / "configs/maps/lights.motors.yaml");
  ASSERT_TRUE(good.ok());
  int conflicts = 0;
  const std::string flows = good.value() + "flows_vehph:\n  1: 300\n";
  Fuzz(
      "lights", {good.value(), good.value(), flows},
      [&](const std::string& text) -> std::optional<base::Error> {
        std::ofstream(companion, std::ios::binary | std::ios::trunc) << text;
        const auto heights = traffic_map::LoadHeightsOf(map);
        if (!heights) return heights.error();
        const auto network = traffic_map::LoadNetwork(map);
        if (!network) return network.error();
        traffic::TrafficSettings settings;
        settings.vehicles = 6;
        settings.demand.flows = traffic::DemandOf(heights.value(), companion).flows;
        auto model = traffic::TrafficModel::Make(settings, network.value(), {});
        if (!model) {
          ++conflicts;
          return model.error();
        }
        Drive(model.value());
        return std::nullopt;
      },
      MutateStructure);
  if (Setting("RODEIRA_FUZZ_FILES", 400) >= 400) {
    EXPECT_GT(conflicts, 0);
  }
}

// Maps: what can be made into lanes at all can be made into a network, and driven on.
TEST(TrafficFiles, MapsChangedByBytes) {
  const auto crossing = base::ReadText(kRoot / "configs/maps/crossing.motors"),
             roundabout = base::ReadText(kRoot / "configs/maps/roundabout.motors");
  ASSERT_TRUE(crossing.ok() && roundabout.ok());
  int driven = 0;
  Fuzz("motors, driven", {crossing.value(), roundabout.value()},
       [&](const std::string& text) -> std::optional<base::Error> {
         const auto file = traffic_map::ParseMap(text, "fuzz.motors");
         if (!file) return file.error();
         const auto made = traffic_map::MakeLaneMap(file.value(), {}, "fuzz.motors");
         if (!made) return made.error();
         const auto network = traffic_map::ToNetwork(made.value(), "fuzz.motors");
         if (!network) return network.error();
         traffic::TrafficSettings settings;
         settings.vehicles = 6;
         auto model = traffic::TrafficModel::Make(settings, network.value(), {});
         if (!model) return model.error();
         Drive(model.value());
         driven += model.value().on_road() > 0 ? 1 : 0;
         return std::nullopt;
       });
  if (Setting("RODEIRA_FUZZ_FILES", 400) >= 400) {
    EXPECT_GT(driven, 20);  // of the first 400
  }
}

TEST(TrafficFiles, ScenariosChangedByStructure) {
  const auto folder = base::TemporaryFolder::Make("scenario-fuzz");
  ASSERT_TRUE(folder.ok());
  const auto good = base::ReadText(kRoot / "configs/scenarios/car_ahead_brakes.yaml"),
             rain = base::ReadText(kRoot / "configs/scenarios/rain_at_dusk.yaml");
  ASSERT_TRUE(good.ok() && rain.ok());
  const std::string scripted =
      "rodeira: scenario/1\nevents:\n  - {at_s: 1, name: traffic.appear, agent: 4, at: {lane: \"1:-1\", s_m: 40}, "
      "speed_mps: 12}\n"
      "  - {at_s: 1, name: traffic.appear, agent: 5, at: {lane: \"2:1\", s_m: 50}, speed_mps: 0}\n  - {at_s: 2, name: "
      "traffic.overtake, agent: ahead}\n"
      "  - {at_s: 3, name: traffic.change_lane, agent: 4, side: left}\n";
  traffic::TrafficSettings settings;
  settings.vehicles = 4;
  settings.scripted = {traffic::VehicleKind::kCar, traffic::VehicleKind::kBus};
  const traffic::TrafficModel start = traffic::TrafficModel::Make(settings, TwoRoads(), {}).value();
  int appeared = 0;
  Fuzz(
      "scenario, structure", {good.value(), rain.value(), scripted},
      [&](const std::string& text) -> std::optional<base::Error> {
        const fs::path file = folder.value().path() / "fuzz.yaml";
        std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
        const auto scenario = scenario::LoadScenario(file, {1'000'000, 10, 10});
        if (!scenario) return scenario.error();
        std::optional<base::Error> refused;
        traffic::TrafficModel model = start;
        for (const auto& [step, event, place] : scenario.value().scheduled) {
          EXPECT_NE(scenario::FindEventKind(event.name), nullptr) << event.name;
          if (event.name != scenario::kTrafficAppear) continue;
          const auto choice = scenario::ParseAgentOnLane(event.argument).value();
          if (!choice.at) {
            ADD_FAILURE() << event.argument << " names no place";
            continue;
          }
          const auto told = model.Spawn(choice.id, choice.at->road, choice.at->s_m, event.value);
          if (!told) refused = told.error().WithContext(event.name);  // the traffic node says which event, too
          appeared += told && told.value() ? 1 : 0;
        }
        Drive(model);
        return refused;
      },
      MutateStructure);
  if (Setting("RODEIRA_FUZZ_FILES", 400) >= 400) {
    EXPECT_GT(appeared, 0);
  }
}

}  // namespace
}  // namespace rodeira::property
