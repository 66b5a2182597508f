// SPDX-License-Identifier: Apache-2.0
// A recording is a fact: computed again it is the same to the bit, and whatever is not is found and named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <map>
#include <thread>

#include "common/core/base/files.hpp"
#include "idl/topics.hpp"
#include "launch/rodeira/replay/branch.hpp"
#include "launch/rodeira/replay/verify.hpp"
#include "tests/launch/rodeira/replay/replay_fixture.hpp"
#include "tests/names.hpp"
#include "tests/system/recording.hpp"

namespace rodeira::cli {
namespace {

using ::testing::HasSubstr;

TEST_F(ReplayTest, ComputedAgainIsTheSame) {
  const std::string file = Drive();
  const auto whole = VerifyFile(file);
  ASSERT_TRUE(whole.ok()) << whole.error().Text();
  EXPECT_FALSE(whole.value().difference.has_value()) << whole.value().difference->Text();
  EXPECT_EQ(whole.value().nodes, 2u);
  EXPECT_EQ(whole.value().samples, 2u * 3001u + 301u + 2u * 4u)
      << "the car's state and what it hits, the controls, snapshots";
  EXPECT_EQ(whole.value().snapshots, 8u);
  const auto late = VerifyFile(file, 2500);
  ASSERT_TRUE(late.ok()) << late.error().Text();
  EXPECT_EQ(late.value().first_step, 2000);
  EXPECT_FALSE(late.value().difference.has_value()) << late.value().difference->Text();
  EXPECT_EQ(late.value().samples, 2u * 1001u + 101u + 2u * 2u);
}

TEST_F(ReplayTest, ATurnedBitIsFound) {
  const std::string file = WithABitTurned(Drive(), "rodeira/vehicle_state", 1234, 100);
  const auto verdict = VerifyFile(file);
  ASSERT_TRUE(verdict.ok()) << verdict.error().Text();
  ASSERT_TRUE(verdict.value().difference.has_value());
  EXPECT_EQ(verdict.value().difference->step, 1234);
  EXPECT_EQ(verdict.value().difference->node, "ego");
  EXPECT_EQ(verdict.value().difference->topic, "rodeira/vehicle_state");
  EXPECT_THAT(verdict.value().difference->field, HasSubstr("_w"));  // a component of a vector, in the world's axes
  EXPECT_NE(verdict.value().difference->recorded, verdict.value().difference->computed);
}

TEST_F(ReplayTest, ATurnedBitOfAStateIsFoundAndTheFieldNamed) {
  const std::string file = Drive();
  // Behind the snapshot's head (some 100 bytes): in the node's state.
  const std::string turned = WithABitTurned(file, "rodeira/snapshot", 3, 150);
  const auto verdict = VerifyFile(turned);
  ASSERT_TRUE(verdict.ok()) << verdict.error().Text();
  ASSERT_TRUE(verdict.value().difference.has_value());
  EXPECT_EQ(verdict.value().difference->step, 1000);
  EXPECT_EQ(verdict.value().difference->topic, "rodeira/snapshot");
  EXPECT_THAT(verdict.value().difference->field, ::testing::StartsWith("state."));
}

// Outputs and states are digested separately: a state that differs is found at its step, though the output is the same.
TEST_F(ReplayTest, AChangedStateDigestIsFoundThoughTheOutputIsTheSame) {
  constexpr std::size_t kStateDigestAt =
      lockstep::SampleHeader::kEncapsulation + lockstep::SampleHeader::kSize - sizeof(base::Digest);
  const std::string file = Drive();
  const auto original = replay::RecordedRun::Open(file),
             changed = replay::RecordedRun::Open(WithABitTurned(file, "rodeira/vehicle_state", 777, kStateDigestAt));
  EXPECT_EQ(CarAt(original.value(), 777).header().state_digest() ^ 1u,
            CarAt(changed.value(), 777).header().state_digest());
  EXPECT_EQ(CarAt(original.value(), 777).position_w_m().x(), CarAt(changed.value(), 777).position_w_m().x());
  const auto verdict = Verify(changed.value(), 0);
  ASSERT_TRUE(verdict.ok()) << verdict.error().Text();
  ASSERT_TRUE(verdict.value().difference.has_value());
  EXPECT_EQ(verdict.value().difference->step, 777);
  EXPECT_EQ(verdict.value().difference->node, "ego");
  EXPECT_EQ(verdict.value().difference->field, "header.state_digest");
  EXPECT_NE(verdict.value().difference->recorded, verdict.value().difference->computed);
}

// What a person reads, with the numbers of the law: steps, nodes that compute, samples of all sources, snapshots of
// both nodes.
TEST_F(ReplayTest, WhatIsIdenticalIsSaidInNumbers) {
  const std::string file = Drive();
  const auto whole = RunCommand({Bin("rodeira"), "replay", file, "--verify"});
  EXPECT_EQ(whole.status, 0) << whole.out;
  EXPECT_THAT(whole.out,
              ::testing::StartsWith("identical: 3000 steps, 2 nodes (6311 samples, 8 snapshots; from 0.000 s; "));
  const auto late = RunCommand({Bin("rodeira"), "replay", file, "--verify", "--from", "2.5"});
  EXPECT_EQ(late.status, 0) << late.out;
  EXPECT_THAT(late.out,
              ::testing::StartsWith("identical: 1000 steps, 2 nodes (2107 samples, 4 snapshots; from 2.000 s; "));
}

TEST_F(ReplayTest, AChangedConstantIsFound) {
  const std::string file = Drive();
  const auto verdict = VerifyFile(file, 0, {{"nodes.ego.config.start.speed_mps", "0.001"}});
  ASSERT_TRUE(verdict.ok()) << verdict.error().Text();
  ASSERT_TRUE(verdict.value().difference.has_value());
  EXPECT_EQ(verdict.value().difference->step, 0);
  EXPECT_EQ(verdict.value().difference->node, "ego");
}

TEST_F(ReplayTest, ABrokenNodeIsFoundAndNamed) {
  for (const char* broken : {"clock", "order"}) {
    const std::string file = Record(
        std::string(broken) + ".mcap", LaunchFile("empty.yaml"),
        {"--for", "1.5", "--set", std::string("nodes.c.config.broken=") + broken, "--set", "snapshot_every_s=0.5"});
    const auto run = RunCommand({Bin("rodeira"), "replay", file, "--verify"});  // in another process: other addresses
    EXPECT_EQ(run.status, 1) << run.out;
    EXPECT_THAT(run.out, HasSubstr("first difference at step 1: node 'c', topic rodeira/pulse, field 'value'"))
        << run.out;
  }
}

// What is left of a recording is a run again: up to its last whole step it is verified and may be branched from.
TEST_F(ReplayTest, ARepairedFileIsARunUpToWhereItIsWhole) {
  const std::string file = Drive();
  const std::string cut = (folder_.path() / "cut.mcap").string(), good = (folder_.path() / "good.mcap").string();
  std::filesystem::copy_file(file, cut);
  std::filesystem::resize_file(cut, std::filesystem::file_size(file) * 6 / 10);
  const auto repair = RunCommand({Bin("rodeira"), "repair", cut, "--out", good});
  ASSERT_EQ(repair.status, 1) << "what is lost is no success: " << repair.out;
  const auto run = replay::RecordedRun::Open(good);
  ASSERT_TRUE(run.ok()) << run.error().Text();
  EXPECT_FALSE(run.value().complete());
  EXPECT_GT(run.value().last_step(), 700);
  EXPECT_LT(run.value().last_step(), 3000);
  const auto verdict = VerifyFile(good);
  ASSERT_TRUE(verdict.ok()) << verdict.error().Text();
  EXPECT_FALSE(verdict.value().difference.has_value()) << verdict.value().difference->Text();
  EXPECT_EQ(verdict.value().last_step, run.value().last_step());
  EXPECT_GE(verdict.value().samples, static_cast<std::uint64_t>(run.value().last_step()));
  EXPECT_TRUE(Branch({good, 500, {{"seed", "2"}}, std::nullopt, (folder_.path() / "branch.mcap").string()}).ok());
}

// A byte anywhere behind the first bytes, also where it is not read otherwise: metadata, embedded files.
TEST_F(ReplayTest, AChangedByteOutsideOfTheSamplesIsFoundToo) {
  const std::string file =
      Record("drive.mcap", LaunchFile("first_drive.yaml"), {"--for", "1", "--meta", "participant=P07"});
  const auto original = base::ReadText(file).value();
  for (const auto& [from, to] : {std::pair<std::string, std::string>{"P07", "P06"},
                                 {"last_step", "last_stop"},
                                 {"1000", "0999"},
                                 {"rodeira.end", "rodeira.eno"}}) {
    std::string text = original;
    const auto at = text.rfind(from);
    ASSERT_NE(at, std::string::npos) << from;
    const std::string changed = folder_.Write("changed.mcap", text.replace(at, from.size(), to)).string();
    const auto verify = RunCommand({Bin("rodeira"), "replay", changed, "--verify"});
    EXPECT_EQ(verify.status, 2) << from << ": " << verify.out;
    const auto info = RunCommand({Bin("rodeira"), "info", changed});
    EXPECT_NE(info.status, 0) << from << ": " << info.out;
    EXPECT_THAT(info.out, testing::AnyOf(HasSubstr("damage"), HasSubstr("rodeira: "))) << from;
  }
}

// The demo with another model of its car: a word on the command line, the same nodes, recorded and computed again.
TEST_F(ReplayTest, TheDemoMayBeDrivenByAnyModel) {
  std::map<std::string, double> driven_m;
  for (const std::string model : {"bicycle", "multibody", "ode"}) {
    const std::string file =
        Record(model + ".mcap", LaunchFile("demo.yaml"),
               {"--for", "3", "--headless", "--set", "nodes.view.config.frames=~", "--set", "vehicle.model=" + model});
    const auto verdict = VerifyFile(file);
    ASSERT_TRUE(verdict.ok()) << verdict.error().Text();
    EXPECT_FALSE(verdict.value().difference.has_value()) << model << ": " << verdict.value().difference->Text();
    const auto run = replay::RecordedRun::Open(file);
    ASSERT_TRUE(run.ok()) << run.error().Text();
    driven_m[model] = CarAt(run.value(), 3000).odometer_m();
    EXPECT_GT(driven_m[model], 1.0) << model;
  }
  EXPECT_NE(driven_m["ode"], driven_m["bicycle"]);
  EXPECT_NE(driven_m["multibody"], driven_m["bicycle"]);
  const auto unknown = RunCommand({Bin("rodeira"), "run", LaunchFile("demo.yaml"), "--in-process", "--headless",
                                   "--no-record", "--set", "vehicle.model=bycicle"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.out, HasSubstr("this car is wanted as model 'bycicle'; did you mean 'bicycle'?"));
}

// What cannot save its state is computed from the first step, wherever one asks it to begin.
TEST_F(ReplayTest, ANodeWithoutAStateIsComputedFromTheStart) {
  const std::string file =
      Record("without.mcap", LaunchFile("empty.yaml"),
             {"--for", "1.5", "--set", "nodes.c.config.saves=false", "--set", "snapshot_every_s=0.5"});
  const auto late = VerifyFile(file, 1200);
  ASSERT_TRUE(late.ok()) << late.error().Text();
  EXPECT_FALSE(late.value().difference.has_value()) << late.value().difference->Text();
  EXPECT_EQ(late.value().first_step, 0);
  EXPECT_EQ(late.value().without_state, std::vector<std::string>{"c"});
  EXPECT_EQ(late.value().samples, 4u * 1501u + 4u * 4u);
  const auto said = RunCommand({Bin("rodeira"), "replay", file, "--verify", "--from", "1.2"});
  EXPECT_EQ(said.status, 0) << said.out;
  EXPECT_THAT(
      said.out,
      HasSubstr("node 'c' cannot save its state: all is computed again from step 0\nidentical: 1500 steps, 4 nodes"));
  EXPECT_THAT(RunCommand({Bin("rodeira"), "info", file}).out,
              HasSubstr("state   node 'c' cannot save its state: replayed from the first step"));
  // Its digests are compared like all others: a change of another node reaches it.
  const auto changed = VerifyFile(file, 1200, {{"nodes.c.config.broken", "clock"}});
  ASSERT_TRUE(changed.ok()) << changed.error().Text();
  ASSERT_TRUE(changed.value().difference.has_value());
  EXPECT_EQ(changed.value().difference->node, "c");
  EXPECT_EQ(changed.value().difference->step, 1);
}

TEST_F(ReplayTest, AMissingSnapshotIsNamed) {
  const std::string file = Drive(2.0);
  const auto nothing = [](const std::string&, record::TextMap&) {};
  const std::string lacking =
      Copied(file, nothing, [](const std::string& topic, const record::Message& message, base::Bytes&) {
        return topic != idl::topics::kSnapshot || message.log_time_ns != 1'000'000'000;
      });
  const auto branch = Branch({lacking, 1500, {}, std::nullopt, (folder_.path() / "branch.mcap").string()});
  ASSERT_FALSE(branch.ok());
  EXPECT_EQ(branch.error().exit_status(), 2);
  EXPECT_THAT(branch.error().Text(), Names("snapshot … step 1000 … missing"));
}

// Ctrl-C while what was recorded is unpacked and while it is computed: a sentence, status 1, and no folder is left.
TEST_F(ReplayTest, CtrlCEndsInOrderAndLeavesNothing) {
  const std::string file = Drive(100.0);
  const std::filesystem::path unpacked = folder_.path() / "tmp";
  const std::filesystem::path branch = folder_.path() / "branch.mcap";
  std::filesystem::create_directory(unpacked);
  const std::vector<std::string> verify{"TMPDIR=" + unpacked.string(), Bin("rodeira"), "replay", file, "--verify"};
  std::vector<std::string> to_branch{verify.begin(), verify.end() - 1};
  to_branch.insert(to_branch.end(), {"--from", "0.5", "--branch", "seed=2", "--record", branch.string()});
  for (const auto& [command, number, wait_ms] :
       {std::tuple(verify, SIGINT, 0), std::tuple(verify, SIGTERM, 200), std::tuple(to_branch, SIGINT, 0),
        std::tuple(to_branch, SIGTERM, 200)}) {
    system_test::Started replay(command);
    for (int i = 0; i < 2000 && std::filesystem::is_empty(unpacked); ++i) ::usleep(5000);
    ASSERT_FALSE(std::filesystem::is_empty(unpacked));
    std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms));
    ASSERT_EQ(::kill(replay.pid(), number), 0);
    const auto ended = replay.Wait();
    EXPECT_EQ(ended.status, 1) << ended.out;
    EXPECT_THAT(ended.out, HasSubstr("interrupted at step ")) << wait_ms;
    EXPECT_EQ(std::count(ended.out.begin(), ended.out.end(), '\n'), 1) << ended.out;
    EXPECT_TRUE(std::filesystem::is_empty(unpacked)) << command.back();
    EXPECT_FALSE(std::filesystem::exists(branch));
  }
}

}  // namespace
}  // namespace rodeira::cli
