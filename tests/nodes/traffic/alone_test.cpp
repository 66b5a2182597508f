// The traffic of a run is the model alone.
#include <gtest/gtest.h>

#include "common/launch/launch.hpp"
#include "common/lockstep/in_process.hpp"
#include "common/road/world.hpp"
#include "common/traffic/traffic_model.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "launch/local_nodes.hpp"
#include "tests/tree.hpp"

namespace rodeira {
namespace {

// Every sample is, to the bit, what `rodeira traffic run`'s model says at that step.
TEST(TrafficAlone, IsTheSameAsInARun) {
  const std::string text =
      "rodeira: launch/1\nworld: ../configs/worlds/lights.yaml\nseed: 5\nnodes:\n  road: {kind: road}\n"
      "  others: {kind: traffic, config: {vehicles: 20}}\n";
  auto launch = launch::Launch::Parse(text, std::filesystem::path(SourceDir()) / "launch/alone.yaml");
  ASSERT_TRUE(launch.ok()) << launch.error().Text();
  auto nodes = front::LocalNodes::Make(launch.value());
  ASSERT_TRUE(nodes.ok()) << nodes.error().Text();
  const auto world = road::World::Load(std::filesystem::path(SourceDir()) / "configs/worlds/lights.yaml").value();
  traffic::TrafficSettings settings;
  settings.seed = 5;
  settings.vehicles = 20;
  // Nobody begins where the driver's car would.
  const std::vector<driver::Footprint> clear{{0, world->start().x_m, world->start().y_m, world->start().heading_rad, 0.0, 20.0, 2.0}};
  traffic::TrafficModel model = traffic::TrafficModel::Make(settings, world, clear).value();
  int samples = 0;
  std::size_t agents = 0;
  lockstep::InProcessSettings run;
  run.last_step = 30'000;
  run.on_sample = [&](const lockstep::Sample& sample) {
    if (launch.value().roster().source(sample.source()).topic != idl::topics::kTrafficState) return;
    const auto state = idl::Decode<msg::TrafficState>(*sample.payload).value();
    if (sample.valid() > 0) model.Step(0.01, {});
    ASSERT_EQ(state.agents().size(), model.poses().size()) << sample.valid();
    for (std::size_t i = 0; i < state.agents().size(); ++i) {
      const traffic::AgentPose& pose = model.poses()[i];
      ASSERT_EQ(state.agents()[i].id(), pose.id);
      ASSERT_EQ(state.agents()[i].position_x_m(), pose.p_WB_W.x()) << sample.valid();
      ASSERT_EQ(state.agents()[i].position_y_m(), pose.p_WB_W.y()) << sample.valid();
      ASSERT_EQ(state.agents()[i].speed_mps(), pose.speed_mps) << sample.valid();
    }
    ++samples;
    agents = state.agents().size();
  };
  const auto outcome = lockstep::RunThreaded(launch.value().roster(), nodes.value().nodes(), run);
  EXPECT_TRUE(outcome.ok) << outcome.fault;
  EXPECT_GE(samples, 3000);
  EXPECT_GT(agents, 10u);
}

}  // namespace
}  // namespace rodeira
