// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/view_node.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <map>
#include <set>

#include "common/core/base/files.hpp"
#include "common/runtime/launch/launch.hpp"
#include "common/runtime/lockstep/in_process.hpp"
#include "nodes/view/run_connection/from_wire.hpp"
#include "tests/nodes/view/fake_run.hpp"
#include "tests/nodes/view/pictures.hpp"

namespace rodeira::nodes {
namespace {

constexpr int kWidth = 640, kHeight = 360;

class ViewNode : public testing::Test {
 protected:
  void SetUp() override {
    RODEIRA_NEEDS_PICTURES();
    folder_ = std::filesystem::temp_directory_path() / ("rodeira-view-" + std::to_string(::getpid()));
    std::filesystem::remove_all(folder_);
  }
  void TearDown() override {
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }

  // Runs hands, ego, others and the view in this process; the digest of all samples.
  base::Digest Drive(const std::string& times, const std::filesystem::path& folder, lockstep::Step last,
                     std::uint64_t shuffle = 0) {
    const std::string config =
        "{width_px: 640, height_px: 360, window: never, instruments: false, frames: {times_s: " + times +
        ", folder: " + folder.string() + "}}";
    auto launch = launch::Launch::Parse(LaunchText(config), "fake.yaml");
    EXPECT_TRUE(launch.ok()) << launch.error().Text();
    const lockstep::Roster& roster = launch.value().roster();
    FakeSource hands(idl::topics::kControls, 0.001), ego(idl::topics::kVehicleState, 0.001),
        others(idl::topics::kTrafficState, 0.001);
    const lockstep::NodeIndex view = roster.Find("picture");
    PlainContext context(launch.value(), view);
    auto node = nodes::MakeViewNode(context);
    EXPECT_TRUE(node.ok()) << node.error().Text();
    if (!node.ok()) return 0;
    std::vector<lockstep::Node*> nodes(roster.nodes().size());
    nodes[roster.Find("hands")] = &hands;
    nodes[roster.Find("ego")] = &ego;
    nodes[roster.Find("others")] = &others;
    nodes[view] = node.value().get();
    lockstep::InProcessSettings settings;
    settings.last_step = last;
    const auto outcome = shuffle == 0 ? lockstep::RunThreaded(roster, nodes, settings)
                                      : lockstep::RunShuffled(roster, nodes, settings, shuffle);
    EXPECT_TRUE(outcome.ok) << outcome.fault;
    return outcome.digest;
  }

  std::set<std::string> Files() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
      names.insert(entry.path().filename().string());
    return names;
  }

  // What the frame of a step must show, drawn another way.
  static Image Expected(lockstep::Step step) {
    Picture picture;
    picture.show_instruments = false;
    picture.moment.time_ns = step * 1'000'000;
    const double time_s = static_cast<double>(step) * 0.001;
    picture.moment.cars.push_back(CarAt(CarAtTime(time_s), HeadingAt(time_s)));
    scene::AgentPose agent;
    agent.colour = scene::Colour::Of(0x1040e0);
    const double agent_s = static_cast<double>(step / 10 * 10) * 0.001;  // the traffic has a sample every 10 steps
    agent.p_WB_W = AgentAtTime(agent_s);
    agent.q_WB = scene::Attitude(HeadingAt(agent_s), 0.0, 0.0);
    agent.length_m = 4.2;
    agent.width_m = 1.75;
    agent.height_m = 1.45;
    agent.wheelbase_m = 2.6;
    picture.moment.agents.push_back(agent);
    road::WorldSpec level;
    level.plane = road::PlaneSpec{};
    level.terrain_surface = ground::Surface::kAsphalt;
    auto image = RenderStill(*road::World::Make(std::move(level)), picture, kWidth, kHeight);
    EXPECT_TRUE(image.ok());
    return image.value();
  }

  std::filesystem::path folder_;
};

// The share of pixels that differ by more than a little.
double Difference(const Image& a, const Image& b) {
  EXPECT_EQ(a.rgb.size(), b.rgb.size());
  std::size_t differ = 0;
  for (std::size_t i = 0; i < std::min(a.rgb.size(), b.rgb.size()); ++i) differ += std::abs(a.rgb[i] - b.rgb[i]) > 6;
  return static_cast<double>(differ) / static_cast<double>(a.rgb.size());
}

TEST_F(ViewNode, AFrameShowsExactlyItsStep) {
  // On an activation of the view (every 20 steps), on none of the traffic's samples, at the very end of the run, and at
  // its beginning.
  Drive("[0, 0.3, 0.333, 0.457]", folder_, 457);
  EXPECT_EQ(Files(), (std::set<std::string>{"step_000000000.png", "step_000000300.png", "step_000000333.png",
                                            "step_000000457.png"}));
  for (const lockstep::Step step : {0, 300, 333, 457}) {
    char name[32];
    std::snprintf(name, sizeof(name), "step_%09d.png", static_cast<int>(step));
    const Image frame = ReadPng(folder_ / name);
    ASSERT_EQ(frame.width_px, kWidth);
    ASSERT_EQ(frame.height_px, kHeight);
    EXPECT_LT(Difference(frame, Expected(step)), 1e-4) << step;
    EXPECT_GT(Difference(frame, Expected(step + 10)), 1e-3) << "a picture of another time must not pass for it";
  }
}

// The agent drives aside while the camera goes with the car: its colour is where its position of that step projects to.
TEST_F(ViewNode, AFrameShowsTheTrafficWhereItWas) {
  Drive("[0.1, 0.9]", folder_, 1000);
  for (const int step : {100, 900}) {
    const double time_s = step * 0.001;
    road::WorldSpec level;
    level.plane = road::PlaneSpec{};
    const auto world = road::World::Make(std::move(level));
    const scene::Camera camera = scene::ChaseCamera(CarAt(CarAtTime(time_s), HeadingAt(time_s)), *world);
    char name[32];
    std::snprintf(name, sizeof(name), "step_%09d.png", step);
    const Image frame = ReadPng(folder_ / name);
    const auto tailgate = [&](double at_s) {  // of the agent, were it where it is beside the car at at_s
      const Eigen::Vector3d p_B = AgentInCar(at_s) + Eigen::Vector3d(-2.1, 0.0, 0.82);
      const Eigen::Vector3d p_W = CarAtTime(time_s) + scene::Attitude(HeadingAt(time_s), 0.0, 0.0) * p_B;
      return ProbeAt(frame, camera, p_W);
    };
    EXPECT_TRUE(tailgate(time_s).IsBlue()) << tailgate(time_s);
    EXPECT_FALSE(tailgate(1.0 - time_s).IsBlue()) << "where it is at the other frame's time";
    EXPECT_TRUE(
        ProbeAt(frame, camera,
                CarAtTime(time_s) + scene::Attitude(HeadingAt(time_s), 0.0, 0.0) * Eigen::Vector3d(-1.8, 0.0, 0.80))
            .IsRed());
  }
}

TEST_F(ViewNode, TheOrderOfArrivalCannotChangeAFrame) {
  const base::Digest digest = Drive("[0.05, 0.1]", folder_, 120);
  const auto first = base::ReadBytes(folder_ / "step_000000050.png");
  ASSERT_TRUE(first.ok());
  for (const std::uint64_t seed : {1U, 2U}) {
    std::filesystem::remove_all(folder_);
    EXPECT_EQ(Drive("[0.05, 0.1]", folder_, 120, seed), digest);
    const auto again = base::ReadBytes(folder_ / "step_000000050.png");
    ASSERT_TRUE(again.ok());
    EXPECT_EQ(first.value(), again.value());
  }
}

TEST_F(ViewNode, FramesBeyondTheEndAreToldOf) {
  testing::internal::CaptureStderr();
  Drive("[0.02, 0.5, 0.6]", folder_, 100);
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "rodeira: node 'picture': warning: the run ended at step 100, before 2 of the frames asked for (the first "
            "of them "
            "is of step 500)\n");
  EXPECT_EQ(Files(), std::set<std::string>{"step_000000020.png"});
}

// Restored in the middle, the view writes the same frames from there on; it remembers the traffic's last sample.
TEST_F(ViewNode, ARestoredViewWritesTheSameFrames) {
  const std::string config =
      "{width_px: 640, height_px: 360, window: never, instruments: false, frames: {times_s: [0.305], folder: " +
      folder_.string() + "}}";
  auto launch = launch::Launch::Parse(LaunchText(config), "fake.yaml");
  ASSERT_TRUE(launch.ok());
  const lockstep::Roster& roster = launch.value().roster();
  const auto drive = [&](std::vector<lockstep::Snapshot> resume, lockstep::Step first,
                         std::vector<lockstep::Snapshot>* taken) {
    FakeSource hands(idl::topics::kControls, 0.001), ego(idl::topics::kVehicleState, 0.001),
        others(idl::topics::kTrafficState, 0.001);
    PlainContext context(launch.value(), roster.Find("picture"));
    auto node = nodes::MakeViewNode(context);
    ASSERT_TRUE(node.ok()) << node.error().Text();
    std::vector<lockstep::Node*> nodes(roster.nodes().size());
    nodes[roster.Find("hands")] = &hands;
    nodes[roster.Find("ego")] = &ego;
    nodes[roster.Find("others")] = &others;
    nodes[roster.Find("picture")] = node.value().get();
    lockstep::InProcessSettings settings;
    settings.last_step = 400;
    settings.first_step = first;
    settings.resume = std::move(resume);
    if (taken != nullptr) {
      settings.snapshot_every = 301;
      taken->resize(nodes.size());
      settings.on_snapshot = [taken](const lockstep::Snapshot& snapshot) { (*taken)[snapshot.node] = snapshot; };
    }
    const auto outcome = lockstep::RunThreaded(roster, nodes, settings);
    ASSERT_TRUE(outcome.ok) << outcome.fault;
  };
  std::vector<lockstep::Snapshot> taken;
  drive({}, 0, &taken);
  const auto whole = base::ReadBytes(folder_ / "step_000000305.png");
  ASSERT_TRUE(whole.ok());
  std::filesystem::remove_all(folder_);
  drive(taken, 301, nullptr);
  const auto resumed = base::ReadBytes(folder_ / "step_000000305.png");
  ASSERT_TRUE(resumed.ok()) << resumed.error().Text();
  EXPECT_EQ(whole.value(), resumed.value());
}

TEST(FromWire, AnotherTripIsAnotherAppearance) {
  msg::TrafficState message;
  for (const auto& [id, trip] : {std::pair(9U, 0U), std::pair(2U, 5U)}) {
    msg::TrafficAgent agent;
    agent.id(id);
    agent.trip(trip);
    message.agents().push_back(agent);
  }
  std::vector<scene::AgentPose> now, later;
  AppendAgents(message, 3, now);
  message.agents()[0].trip(1);
  AppendAgents(message, 3, later);
  ASSERT_EQ(now.size(), 2U);
  EXPECT_LT(now[0].id, now[1].id);
  EXPECT_EQ(now[0].id, later[0].id);
  EXPECT_NE(now[1].id, later[1].id);
}

}  // namespace
}  // namespace rodeira::nodes
