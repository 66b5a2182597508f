// SPDX-License-Identifier: Apache-2.0
// Whole runs in which the car hits something: it is stopped, the event is recorded, and the run is computed again to
// the bit.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "common/vehicle/dynamics/vehicle_model.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "tests/system/command.hpp"
#include "tests/system/recording.hpp"
#include "tests/tree.hpp"

namespace rodeira::system_test {
namespace {

class Crash : public ::testing::Test {
 protected:
  Crash() { std::filesystem::create_directories(folder_); }
  ~Crash() override { std::filesystem::remove_all(folder_); }
  std::string Path(const std::string& name) const { return (folder_ / name).string(); }
  static Ended Run(const std::string& launch, std::vector<std::string> more) {
    more.insert(more.begin(), {Bin("rodeira"), "run", SourceDir() + "/tests/data/" + launch});
    return RunCommand(more);
  }
  // Of one recording: the first partner, the impulse along x of its touch, and the car's fastest and last speed.
  struct Story {
    std::optional<msg::Contact> first;
    double impulse_x_Ns = 0.0;
    int begins = 0;
    double speed_before_mps = 0.0;
  };
  Story StoryOf(const std::string& recording) const {
    Story story;
    std::int64_t hit = -1;
    for (const auto& sample : MessagesOf<msg::Collisions>(recording, idl::topics::kCollisions)) {
      for (const msg::Contact& collision : sample.contacts()) {
        if (!story.first) {
          story.first = collision;
          hit = sample.header().step();
        }
        story.impulse_x_Ns += collision.impulse_x_newton_s();
        story.begins += static_cast<int>(collision.begins());
      }
    }
    for (const auto& state : MessagesOf<msg::VehicleState>(recording, idl::topics::kVehicleState)) {
      if (state.header().step() == hit) story.speed_before_mps = state.velocity_w_mps().x();
    }
    return story;
  }
  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("rodeira-crash-" + std::to_string(::getpid()));
};

TEST_F(Crash, IntoAHouseIsRecordedAndComputedAgain) {
  const std::string recording = Path("wall.mcap");
  const Ended run = Run("crash_wall.yaml", {"--for", "10", "--record", recording});
  ASSERT_EQ(run.status, 0) << run.out;
  const Story story = StoryOf(recording);
  ASSERT_TRUE(story.first.has_value());
  EXPECT_EQ(story.first->partner_kind(), 0u);
  EXPECT_EQ(story.first->partner_name(), "main-object0");
  EXPECT_EQ(story.first->begins(), 1u);
  EXPECT_LT(story.first->normal_x(), -0.99f);
  EXPECT_NEAR(story.first->position_x_m(), 294.0, 0.1);
  EXPECT_GT(story.speed_before_mps, 15.0);
  const auto model = dynamics::LoadVehicle(SourceDir() + "/configs/vehicles/default.yaml");
  // The house takes all of its momentum; what the engine goes on pushing comes on top.
  const double momentum = model.value()->dimensions().mass_kg * story.speed_before_mps;
  EXPECT_LT(story.impulse_x_Ns, -0.98 * momentum);
  const auto states = MessagesOf<msg::VehicleState>(recording, idl::topics::kVehicleState);
  ASSERT_FALSE(states.empty());
  for (const auto& state : states)
    ASSERT_LT(state.position_w_m().x(), 294.0) << "it is in the house at step " << state.header().step();
  const Ended verified = RunCommand({Bin("rodeira"), "replay", recording, "--verify"});
  EXPECT_EQ(verified.status, 0) << verified.out;
  EXPECT_NE(verified.out.find("identical"), std::string::npos) << verified.out;
}

TEST_F(Crash, WithEveryModel) {
  for (const std::string model : {"multibody", "ode"}) {
    const std::string recording = Path(model + ".mcap");
    const Ended run = Run("crash_wall.yaml",
                          {"--for", "10", "--in-process", "--set", "vehicle.model=" + model, "--record", recording});
    ASSERT_EQ(run.status, 0) << run.out;
    const Story story = StoryOf(recording);
    ASSERT_TRUE(story.first.has_value()) << model;
    EXPECT_EQ(story.first->partner_name(), "main-object0") << model;
    EXPECT_LT(story.impulse_x_Ns, -8000.0) << model;
    const Ended verified = RunCommand({Bin("rodeira"), "replay", recording, "--verify"});
    EXPECT_EQ(verified.status, 0) << verified.out;
  }
}

TEST_F(Crash, IntoAParkedCarOfTraffic) {
  const std::string recording = Path("traffic.mcap");
  const Ended run = Run("crash_traffic.yaml", {"--for", "13", "--record", recording});
  ASSERT_EQ(run.status, 0) << run.out;
  const Story story = StoryOf(recording);
  ASSERT_TRUE(story.first.has_value());
  EXPECT_EQ(story.first->partner_kind(), 1u);
  EXPECT_LT(story.first->partner_id(), 24u);
  EXPECT_LT(story.impulse_x_Ns, -1000.0);
  EXPECT_GE(story.begins, 1);
  EXPECT_EQ(RunCommand({Bin("rodeira"), "replay", recording, "--verify"}).status, 0);
  const Ended again = Run("crash_traffic.yaml", {"--for", "13", "--in-process", "--record", Path("again.mcap")});
  ASSERT_EQ(again.status, 0) << again.out;
  EXPECT_EQ(FirstDifference(SamplesOf(recording), SamplesOf(Path("again.mcap"))), "");
}

// Cars of two nodes: each sees the other as it is at that step, so they touch in the same steps with opposite impulses.
TEST_F(Crash, IntoTheCarOfAnotherNode) {
  const std::string recording = Path("cars.mcap");
  const Ended run = Run("crash_cars.yaml", {"--for", "4", "--record", recording});
  ASSERT_EQ(run.status, 0) << run.out;
  const auto of_ego = MessagesOf<msg::Collisions>(recording, idl::topics::kCollisions, "ego");
  const auto of_other = MessagesOf<msg::Collisions>(recording, idl::topics::kCollisions, "other");
  const auto states = MessagesOf<msg::VehicleState>(recording, idl::topics::kVehicleState, "other");
  ASSERT_EQ(of_ego.size(), of_other.size());
  double all_Ns = 0.0;
  int touching = 0;
  for (std::size_t i = 0; i < of_ego.size(); ++i) {
    ASSERT_EQ(of_ego[i].contacts().size(), of_other[i].contacts().size()) << "step " << i;
    if (of_ego[i].contacts().empty()) continue;
    ++touching;
    const msg::Contact& mine = of_ego[i].contacts().front();
    const msg::Contact& theirs = of_other[i].contacts().front();
    EXPECT_EQ(mine.partner_kind(), 1u);
    EXPECT_EQ(mine.partner_source(), states.front().header().source());
    EXPECT_EQ(mine.begins(), theirs.begins());
    EXPECT_NEAR(mine.impulse_x_newton_s(), -theirs.impulse_x_newton_s(),
                1e-3 * std::fabs(mine.impulse_x_newton_s()) + 1e-3);
    all_Ns += theirs.impulse_x_newton_s();
  }
  EXPECT_GT(touching, 5);
  EXPECT_GT(all_Ns, 2000.0);
  EXPECT_GT(states.back().position_w_m().x(), 230.1) << "it was pushed on";
  EXPECT_EQ(RunCommand({Bin("rodeira"), "replay", recording, "--verify"}).status, 0);
  ASSERT_EQ(Run("crash_cars.yaml", {"--for", "4", "--in-process", "--record", Path("again.mcap")}).status, 0);
  EXPECT_EQ(FirstDifference(SamplesOf(recording), SamplesOf(Path("again.mcap"))), "");
}

TEST_F(Crash, NothingIsTouchedWhereCollisionsAreOff) {
  const std::string recording = Path("none.mcap");
  const Ended run = Run("crash_wall.yaml", {"--for", "10", "--in-process", "--set", "nodes.ego.config.collisions=none",
                                            "--record", recording});
  ASSERT_EQ(run.status, 0) << run.out;
  EXPECT_FALSE(StoryOf(recording).first.has_value());
  EXPECT_GT(MessagesOf<msg::VehicleState>(recording, idl::topics::kVehicleState).back().position_w_m().x(), 300.0);
}

}  // namespace
}  // namespace rodeira::system_test
