// SPDX-License-Identifier: Apache-2.0
// The traffic of a run is the model alone.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>

#include "common/runtime/launch/launch.hpp"
#include "common/runtime/lockstep/in_process.hpp"
#include "common/traffic/results/study.hpp"
#include "common/world/road/world.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "launch/rodeira/run/local_nodes.hpp"
#include "tests/tree.hpp"

namespace rodeira {
namespace {

using Poses = std::vector<traffic::AgentPose>;

// What `rodeira traffic run` counts from: the model alone, every 10 ms.
std::vector<Poses> Alone(const std::string& world, const traffic::TrafficSettings& settings, double for_s) {
  traffic::StudySettings study;
  study.traffic = settings;
  study.duration_s = for_s;
  study.watch_s = study.step_s;
  std::vector<Poses> poses;
  const auto loaded = road::World::Load(SourceDir() + "/configs/" + world).value();
  const auto result = traffic::RunStudy(
      study, loaded, [&](const traffic::StudyMoment& moment) { poses.push_back(moment.model.poses()); });
  EXPECT_TRUE(result.ok()) << result.error().Text();
  return poses;
}

// Every sample of a run is, to the bit, what the model says alone at that step.
void ExpectTheSame(const std::string& world, const std::string& config, const std::vector<Poses>& alone) {
  const std::string text = fmt::format(
      "rodeira: launch/1\nworld: ../configs/{}\nseed: 5\nnodes:\n  road: {{kind: road}}\n  others: {{kind: traffic, "
      "config: {{{}}}}}\n",
      world, config);
  auto launch = launch::Launch::Parse(text, std::filesystem::path(SourceDir()) / "launch/alone.yaml");
  ASSERT_TRUE(launch.ok()) << launch.error().Text();
  auto nodes = cli::LocalNodes::Make(launch.value());
  ASSERT_TRUE(nodes.ok()) << nodes.error().Text();
  std::size_t samples = 0, agents = 0;
  lockstep::InProcessSettings run;
  run.last_step = static_cast<lockstep::Step>(alone.size() - 1) * 10;
  run.on_sample = [&](const lockstep::Sample& sample) {
    if (launch.value().roster().source(sample.source()).topic != idl::topics::kTrafficState) return;
    const auto state = idl::Decode<msg::TrafficState>(*sample.payload).value();
    const auto k = static_cast<std::size_t>(sample.valid() / 10);
    if (k >= alone.size()) return;
    ASSERT_EQ(state.agents().size(), alone[k].size()) << sample.valid();
    for (std::size_t i = 0; i < state.agents().size(); ++i) {
      const traffic::AgentPose& pose = alone[k][i];
      ASSERT_EQ(state.agents()[i].id(), pose.id);
      ASSERT_EQ(state.agents()[i].position_x_m(), pose.p_WB_W.x()) << sample.valid();
      ASSERT_EQ(state.agents()[i].position_y_m(), pose.p_WB_W.y()) << sample.valid();
      ASSERT_EQ(state.agents()[i].position_z_m(), pose.p_WB_W.z()) << sample.valid();
      ASSERT_EQ(state.agents()[i].speed_mps(), pose.speed_mps) << sample.valid();
    }
    ++samples;
    agents = state.agents().size();
  };
  const auto outcome = lockstep::RunThreaded(launch.value().roster(), nodes.value().nodes(), run);
  EXPECT_TRUE(outcome.ok) << outcome.fault;
  EXPECT_EQ(samples, alone.size());
  EXPECT_GT(agents, 10u);
}

// Of lanes that are too narrow for a bus in their bends a run tells as `rodeira traffic run` does, and of none where
// cars go along the path exactly.
TEST(TrafficAlone, ARunTellsOfLanesThatAreTooNarrow) {
  for (const auto& [physics, told] : {std::pair{"full", true}, std::pair{"planar", false}}) {
    const std::string text = fmt::format(
        "rodeira: launch/1\nworld: ../configs/maps/crossing.motors\nnodes:\n  road: {{kind: road}}\n  others: {{kind: "
        "traffic, config: {{physics: {}, vehicles: 3, mix: {{bus: 1}}}}}}\n",
        physics);
    auto launch = launch::Launch::Parse(text, std::filesystem::path(SourceDir()) / "launch/alone.yaml");
    ASSERT_TRUE(launch.ok()) << launch.error().Text();
    testing::internal::CaptureStderr();
    const auto nodes = cli::LocalNodes::Make(launch.value());
    const std::string said = testing::internal::GetCapturedStderr();
    ASSERT_TRUE(nodes.ok()) << nodes.error().Text();
    EXPECT_EQ(said.find("rodeira: node 'others': warning: ") != std::string::npos &&
                  said.find("a bus of 10.5 m") != std::string::npos,
              told)
        << said;
  }
}

TEST(TrafficAlone, IsTheSameAsInARun) {
  traffic::TrafficSettings settings;
  settings.seed = 5;
  settings.vehicles = 20;
  ExpectTheSame("worlds/lights.yaml", "vehicles: 20", Alone("worlds/lights.yaml", settings, 30.0));
}

// A traffic map is a world as it is, its companion's lights and heights among it.
TEST(TrafficAlone, IsTheSameAsInARunOnATrafficMap) {
  traffic::TrafficSettings settings;
  settings.seed = 5;
  settings.vehicles = 20;
  for (const char* map : {"maps/town.motors", "maps/lights.motors"})
    ExpectTheSame(map, "vehicles: 20", Alone(map, settings, 20.0));
  settings.physics = traffic::Physics::kFull;
  ExpectTheSame("maps/overpass.motors", "vehicles: 20, physics: full", Alone("maps/overpass.motors", settings, 5.0));
}

// What stands beside a map is driven on, so that what is the same above says something of it: its lights are on and
// a car waits at them, its heights are climbed.
TEST(TrafficAlone, LightsAndHeightsOfATrafficMapAreThere) {
  traffic::StudySettings study;
  study.traffic.seed = 5;
  study.traffic.vehicles = 20;
  study.duration_s = 20.0;
  const auto load = [](const char* map) {
    return road::World::Load(std::filesystem::path(SourceDir()) / "configs/maps" / map).value();
  };
  std::size_t lights = 0, waits = 0;
  ASSERT_TRUE(traffic::RunStudy(study, load("lights.motors"), [&](const traffic::StudyMoment& moment) {
                lights = moment.model.colours().size();
                for (const traffic::AgentPose& pose : moment.model.poses()) waits += pose.speed_mps == 0.0 ? 1 : 0;
              }).ok());
  EXPECT_GT(lights, 0u);
  EXPECT_GT(waits, 0u);
  double low_m = 1e9, high_m = -1e9;
  ASSERT_TRUE(traffic::RunStudy(study, load("overpass.motors"), [&](const traffic::StudyMoment& moment) {
                for (const traffic::AgentPose& pose : moment.model.poses())
                  low_m = std::min(low_m, pose.p_WB_W.z()), high_m = std::max(high_m, pose.p_WB_W.z());
              }).ok());
  EXPECT_GT(high_m - low_m, 4.0);
}

// Each car's own physics feels the world's ground, which is more than its roads: terrain, measured surfaces.
TEST(TrafficAlone, IsTheSameWithFullPhysicsOnAWorldWithTerrain) {
  traffic::TrafficSettings settings;
  settings.seed = 5;
  settings.vehicles = 20;
  settings.physics = traffic::Physics::kFull;
  ExpectTheSame("worlds/example/world.yaml", "vehicles: 20, physics: full",
                Alone("worlds/example/world.yaml", settings, 5.0));
}

}  // namespace
}  // namespace rodeira
