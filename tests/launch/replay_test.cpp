// A recording is a fact: computed again it is the same to the bit, and whatever is not is found and named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <thread>

#include "common/base/files.hpp"
#include "common/record/mcap_reader.hpp"
#include "common/record/mcap_writer.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "launch/branch.hpp"
#include "launch/verify.hpp"
#include "tests/launch/copied_recording.hpp"
#include "tests/launch/temporary_folder.hpp"
#include "tests/system/command.hpp"
#include "tests/system/recording.hpp"

namespace rodeira::front {
namespace {

using system_test::Bin;
using system_test::LaunchFile;
using system_test::RunCommand;
using ::testing::HasSubstr;

class ReplayTest : public ::testing::Test {
 protected:
  std::string Record(const std::string& name, const std::string& launch, std::vector<std::string> more) {
    const std::string file = (folder_.path() / name).string();
    std::vector<std::string> command{Bin("rodeira"), "run", launch, "--in-process", "--record", file};
    command.insert(command.end(), more.begin(), more.end());
    const auto ended = RunCommand(command);
    EXPECT_EQ(ended.status, 0) << ended.out;
    return file;
  }
  std::string Drive(double seconds = 3.0) { return Record("drive.mcap", LaunchFile("first_drive.yaml"), {"--for", std::to_string(seconds)}); }

  static base::Result<Verdict> VerifyFile(const std::string& file, lockstep::Step from = 0, const launch::Overrides& extra = {}) {
    const auto run = replay::RecordedRun::Open(file, extra);
    if (!run) return run.error();
    return Verify(run.value(), from);
  }

  // A copy of the recording, its metadata and messages changed on the way; a message for which `keep` says no is left out.
  std::string Copied(const std::string& file, const Entries& change, const Keep& keep, const KeepFile& keep_file = [](const std::string&) { return true; }) {
    const std::string copy = (folder_.path() / "copied.mcap").string();
    CopyRecording(file, copy, change, keep, keep_file);
    return copy;
  }
  // With one bit of one message turned.
  std::string WithABitTurned(const std::string& file, const std::string& topic, std::uint64_t message_number, std::size_t byte) {
    std::uint64_t seen = 0;
    return Copied(file, [](const std::string&, record::TextMap&) {}, [&](const std::string& on, const record::Message&, base::Bytes& data) {
      if (on == topic && seen++ == message_number) data[byte] ^= std::byte{1};
      return true;
    });
  }
  // The car's published state at a step.
  static msg::VehicleState CarAt(const replay::RecordedRun& run, lockstep::Step step) {
    auto samples = run.Samples(step);
    for (auto next = samples.Next(); next.ok() && next.value(); next = samples.Next()) {
      if (next.value()->valid() != step || run.roster().source(next.value()->source()).topic != idl::topics::kVehicleState) continue;
      return idl::Decode<msg::VehicleState>(*next.value()->payload).value();
    }
    ADD_FAILURE() << "no car at step " << step;
    return {};
  }

  TemporaryFolder folder_;
};

TEST_F(ReplayTest, ComputedAgainIsTheSame) {
  const std::string file = Drive();
  const auto whole = VerifyFile(file);
  ASSERT_TRUE(whole.ok()) << whole.error().Text();
  EXPECT_FALSE(whole.value().difference.has_value()) << whole.value().difference->Text();
  EXPECT_EQ(whole.value().nodes, 2u);
  EXPECT_EQ(whole.value().samples, 3001u + 301u + 2u * 4u);
  EXPECT_EQ(whole.value().snapshots, 8u);
  const auto late = VerifyFile(file, 2500);
  ASSERT_TRUE(late.ok()) << late.error().Text();
  EXPECT_EQ(late.value().first_step, 2000);
  EXPECT_FALSE(late.value().difference.has_value()) << late.value().difference->Text();
  EXPECT_EQ(late.value().samples, 1001u + 101u + 2u * 2u);
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
  constexpr std::size_t kStateDigestAt = lockstep::SampleHeader::kEncapsulation + lockstep::SampleHeader::kSize - sizeof(base::Digest);
  const std::string file = Drive();
  const auto original = replay::RecordedRun::Open(file), changed = replay::RecordedRun::Open(WithABitTurned(file, "rodeira/vehicle_state", 777, kStateDigestAt));
  EXPECT_EQ(CarAt(original.value(), 777).header().state_digest() ^ 1u, CarAt(changed.value(), 777).header().state_digest());
  EXPECT_EQ(CarAt(original.value(), 777).position_w_m().x(), CarAt(changed.value(), 777).position_w_m().x());
  const auto verdict = Verify(changed.value(), 0);
  ASSERT_TRUE(verdict.ok()) << verdict.error().Text();
  ASSERT_TRUE(verdict.value().difference.has_value());
  EXPECT_EQ(verdict.value().difference->step, 777);
  EXPECT_EQ(verdict.value().difference->node, "ego");
  EXPECT_EQ(verdict.value().difference->field, "header.state_digest");
  EXPECT_NE(verdict.value().difference->recorded, verdict.value().difference->computed);
}

// What a person reads, with the numbers of the law: steps, nodes that compute, samples of all sources, snapshots of both nodes.
TEST_F(ReplayTest, WhatIsIdenticalIsSaidInNumbers) {
  const std::string file = Drive();
  const auto whole = RunCommand({Bin("rodeira"), "replay", file, "--verify"});
  EXPECT_EQ(whole.status, 0) << whole.out;
  EXPECT_THAT(whole.out, ::testing::StartsWith("identical: 3000 steps, 2 nodes (3310 samples, 8 snapshots; from 0.000 s; "));
  const auto late = RunCommand({Bin("rodeira"), "replay", file, "--verify", "--from", "2.5"});
  EXPECT_EQ(late.status, 0) << late.out;
  EXPECT_THAT(late.out, ::testing::StartsWith("identical: 1000 steps, 2 nodes (1106 samples, 4 snapshots; from 2.000 s; "));
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
    const std::string file = Record(std::string(broken) + ".mcap", LaunchFile("empty.yaml"),
                                    {"--for", "1.5", "--set", std::string("nodes.c.config.broken=") + broken, "--set", "snapshot_every_s=0.5"});
    const auto run = RunCommand({Bin("rodeira"), "replay", file, "--verify"});  // in another process: other addresses
    EXPECT_EQ(run.status, 1) << run.out;
    EXPECT_THAT(run.out, HasSubstr("first difference at step 1: node 'c', topic rodeira/pulse, field 'value'")) << run.out;
  }
}

TEST_F(ReplayTest, ABranchWithoutAChangeIsItsParent) {
  const std::string file = Drive();
  BranchWish wish{file, 1500, {}, std::nullopt, (folder_.path() / "branch.mcap").string()};
  const auto outcome = Branch(wish);
  ASSERT_TRUE(outcome.ok()) << outcome.error().Text();
  EXPECT_FALSE(outcome.value().difference.has_value());
  EXPECT_EQ(outcome.value().recomputed_from, 1000);
  EXPECT_TRUE(outcome.value().taken_over.empty());
  auto a = replay::RecordedRun::Open(file);
  auto b = replay::RecordedRun::Open(wish.recording);
  ASSERT_TRUE(b.ok()) << b.error().Text();
  EXPECT_EQ(b.value().branched_at(), 1500);
  auto of_a = a.value().Samples();
  auto of_b = b.value().Samples();
  std::size_t count = 0;
  for (;;) {
    const auto x = of_a.Next();
    const auto y = of_b.Next();
    ASSERT_EQ(x.value().has_value(), y.value().has_value());
    if (!x.value()) break;
    ++count;
    ASSERT_EQ(*x.value()->payload, *y.value()->payload) << "at step " << x.value()->valid();
  }
  EXPECT_EQ(count, 3001u + 301u + 8u);
  const auto reader = record::McapReader::Open(wish.recording);
  const auto end = reader.value().FindMetadata("rodeira.end").value()->entries;
  EXPECT_EQ(end.at("samples"), std::to_string(count)) << "the parent's are counted too";
  EXPECT_EQ(end.at("missing"), "0");
}

// What the parent's clock and operator said up to there, and the branch's own from there on.
TEST_F(ReplayTest, ABranchHasMarksAndWallTimesOfBothItsLives) {
  const std::string file = Drive();
  BranchWish wish{file, 1500, {}, std::nullopt, (folder_.path() / "branch.mcap").string()};
  int asked = 0;
  std::string marked;
  wish.next_command = [&]() -> std::optional<lockstep::Asked> {
    // Again and again until the branch has begun; it is asked until nothing comes.
    if (++asked % 2 == 0 || marked.starts_with("marked step ")) return std::nullopt;
    lockstep::Command mark;
    mark.kind = lockstep::Command::Kind::kMark;
    mark.text = "hello";
    return lockstep::Asked{mark, [&](const base::Result<std::string>& done) { marked = done ? done.value() : done.error().Text(); }};
  };
  wish.pace = 2;
  ASSERT_TRUE(Branch(wish).ok());
  const auto of_parent = system_test::MessagesOf<msg::WallTime>(file, idl::topics::kWall);
  const auto of_branch = system_test::MessagesOf<msg::WallTime>(wish.recording, idl::topics::kWall);
  std::size_t same = 0;
  while (same < of_parent.size() && of_parent[same].through_step() <= 1500) ++same;
  ASSERT_GT(same, 0u);
  ASSERT_GT(of_branch.size(), same);
  for (std::size_t i = 0; i < same; ++i) EXPECT_EQ(of_branch[i].utc_ns(), of_parent[i].utc_ns()) << i;
  for (std::size_t i = same; i < of_branch.size(); ++i) EXPECT_GE(of_branch[i].through_step(), 1500) << i;
  EXPECT_EQ(of_branch.back().through_step(), 3000);
  std::string kinds;
  for (const auto& remark : system_test::MessagesOf<msg::Remark>(wish.recording, idl::topics::kRemarks)) {
    kinds += remark.kind() + " ";
    if (remark.kind() == "mark") {
      EXPECT_EQ(remark.text(), "hello");
    }
  }
  EXPECT_THAT(marked, HasSubstr("marked step "));
  EXPECT_EQ(kinds, "start start mark end ");
}

// What a user keeps beside it is not the branch's.
TEST_F(ReplayTest, ABranchTouchesNoOtherFile) {
  const std::string file = Drive();
  const auto precious = folder_.Write("branch.mcap.part", "precious");
  BranchWish wish{file, 1500, {}, std::nullopt, (folder_.path() / "branch.mcap").string()};
  ASSERT_TRUE(Branch(wish).ok());
  EXPECT_EQ(base::ReadText(precious).value(), "precious");
}

TEST_F(ReplayTest, ABranchHasItsParentsPastAndItsOwnFuture) {
  const std::string file = Drive();
  const auto script = folder_.Write("brake.csv", "time_s,steering_wheel_rad,throttle,brake\n0,0,0,1\n");
  BranchWish wish{file, 2000, {{"nodes.driver.config.script", "\"" + script.string() + "\""}}, 4000, (folder_.path() / "branch.mcap").string()};
  const auto outcome = Branch(wish);
  ASSERT_TRUE(outcome.ok()) << outcome.error().Text();
  EXPECT_EQ(outcome.value().last_step, 4000);
  auto parent = replay::RecordedRun::Open(file);
  auto branch = replay::RecordedRun::Open(wish.recording);
  ASSERT_TRUE(branch.ok()) << branch.error().Text();
  auto of_parent = parent.value().Samples();
  auto of_branch = branch.value().Samples();
  for (;;) {  // the past, to the bit
    const auto x = of_parent.Next();
    const auto y = of_branch.Next();
    ASSERT_TRUE(x.value() && y.value());
    if (x.value()->valid() >= 2000) break;
    ASSERT_EQ(*x.value()->payload, *y.value()->payload) << "at step " << x.value()->valid();
  }
  // And the branch is a recording like any other: it can be verified from its first own snapshot on.
  const auto verdict = Verify(branch.value(), 0);
  ASSERT_TRUE(verdict.ok()) << verdict.error().Text();
  EXPECT_EQ(verdict.value().first_step, 2000);
  EXPECT_FALSE(verdict.value().difference.has_value()) << verdict.value().difference->Text();
  EXPECT_EQ(verdict.value().last_step, 4000);
}

// At the beginning too, where nothing is computed again; and of a branch, only behind its own beginning.
TEST_F(ReplayTest, ABranchMayLeaveAtTheFirstStepAndABranchsBranchBehindItsOwn) {
  const std::string file = Drive();
  const std::string first = (folder_.path() / "first.mcap").string(), second = (folder_.path() / "second.mcap").string();
  BranchWish wish{file, 0, {}, std::nullopt, first};
  const auto outcome = Branch(wish);
  ASSERT_TRUE(outcome.ok()) << outcome.error().Text();
  const auto parent = replay::RecordedRun::Open(file), branch = replay::RecordedRun::Open(first);
  auto of_a = parent.value().Samples(), of_b = branch.value().Samples();
  for (;;) {
    const auto x = of_a.Next(), y = of_b.Next();
    ASSERT_EQ(x.value().has_value(), y.value().has_value());
    if (!x.value()) break;
    ASSERT_EQ(*x.value()->payload, *y.value()->payload) << "at step " << x.value()->valid();
  }
  wish = {file, 1500, {}, std::nullopt, second};
  ASSERT_TRUE(Branch(wish).ok());
  const std::string third = (folder_.path() / "third.mcap").string();
  const auto refusal = [&](lockstep::Step at) {
    const auto refused = Branch({second, at, {}, std::nullopt, third});
    EXPECT_FALSE(refused.ok());
    if (refused.ok()) return std::string();
    EXPECT_EQ(refused.error().exit_status(), 2);
    EXPECT_FALSE(std::filesystem::exists(third));
    return refused.error().Text();
  };
  EXPECT_THAT(refusal(0), HasSubstr("this recording left its parent at 1.500 s"));
  EXPECT_THAT(refusal(1490), HasSubstr("this recording left its parent at 1.500 s"));
  EXPECT_THAT(refusal(1800), HasSubstr("the first snapshots of this run's own are at step 2000"));
  EXPECT_TRUE(Branch({second, 2100, {}, std::nullopt, third}).ok());
}

// What is left of a recording is a run again: up to its last whole step it is verified and may be branched from.
TEST_F(ReplayTest, ARepairedFileIsARunUpToWhereItIsWhole) {
  const std::string file = Drive();
  const std::string cut = (folder_.path() / "cut.mcap").string(), good = (folder_.path() / "good.mcap").string();
  std::filesystem::copy_file(file, cut);
  std::filesystem::resize_file(cut, std::filesystem::file_size(file) * 6 / 10);
  const auto repair = RunCommand({Bin("rodeira"), "repair", cut, "--out", good});
  ASSERT_EQ(repair.status, 0) << repair.out;
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

// A byte anywhere behind the first bytes, also where nobody reads it otherwise: metadata, embedded files.
TEST_F(ReplayTest, AChangedByteOutsideOfTheSamplesIsFoundToo) {
  const std::string file = Record("drive.mcap", LaunchFile("first_drive.yaml"), {"--for", "1", "--meta", "participant=P07"});
  const auto original = base::ReadText(file).value();
  for (const auto& [from, to] : {std::pair<std::string, std::string>{"P07", "P06"}, {"last_step", "last_stop"}, {"1000", "0999"}, {"rodeira.end", "rodeira.eno"}}) {
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
    const std::string file = Record(model + ".mcap", LaunchFile("demo.yaml"),
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
  const auto unknown = RunCommand({Bin("rodeira"), "run", LaunchFile("demo.yaml"), "--in-process", "--headless", "--no-record", "--set", "vehicle.model=bycicle"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.out, HasSubstr("this car is wanted as model 'bycicle'; did you mean 'bicycle'?"));
}

// The car of another model goes on where the other one was: pose, speed and yaw rate at the next published step.
TEST_F(ReplayTest, ABranchMayHaveAnotherVehicleModel) {
  const std::string file = Drive(4.0);
  const std::string other = std::string(RODEIRA_SOURCE_DIR) + "/configs/vehicles/prototype.yaml";
  const BranchWish wish{file, 3000, {{"nodes.ego.config.vehicle", "\"" + other + "\""}}, 4000, (folder_.path() / "branch.mcap").string()};
  const auto outcome = Branch(wish);
  ASSERT_TRUE(outcome.ok()) << outcome.error().Text();
  EXPECT_EQ(outcome.value().taken_over, std::vector<std::string>{"ego"});
  // A word does the same where the car's file names the other one.
  const BranchWish by_word{file, 3000, {{"vehicle.model", "multibody"}}, 4000, (folder_.path() / "by_word.mcap").string()};
  const auto worded = Branch(by_word);
  ASSERT_TRUE(worded.ok()) << worded.error().Text();
  EXPECT_EQ(worded.value().taken_over, std::vector<std::string>{"ego"});
  EXPECT_EQ(CarAt(replay::RecordedRun::Open(by_word.recording).value(), 4000), CarAt(replay::RecordedRun::Open(wish.recording).value(), 4000));
  const auto parent = replay::RecordedRun::Open(file), branch = replay::RecordedRun::Open(wish.recording);
  ASSERT_TRUE(branch.ok()) << branch.error().Text();
  const auto was = CarAt(parent.value(), 3005), is = CarAt(branch.value(), 3005), later = CarAt(branch.value(), 4000), otherwise = CarAt(parent.value(), 4000);
  EXPECT_GT(was.velocity_w_mps().x(), 1.0);
  EXPECT_NEAR(is.position_w_m().x(), was.position_w_m().x(), 0.005);
  EXPECT_NEAR(is.position_w_m().y(), was.position_w_m().y(), 0.005);
  EXPECT_NEAR(is.position_w_m().z(), was.position_w_m().z(), 0.3) << "another car's origin";
  EXPECT_NEAR(is.velocity_w_mps().x(), was.velocity_w_mps().x(), 0.05);
  EXPECT_GT(std::fabs(later.velocity_w_mps().x() - otherwise.velocity_w_mps().x()), 0.01) << "and is another car";
  const auto verdict = Verify(branch.value(), 0);
  ASSERT_TRUE(verdict.ok()) << verdict.error().Text();
  EXPECT_FALSE(verdict.value().difference.has_value()) << verdict.value().difference->Text();
}

TEST_F(ReplayTest, ABranchMayHaveAnotherTrafficSeed) {
  const std::string file = Record("traffic.mcap", LaunchFile("demo.yaml"), {"--for", "4", "--headless", "--set", "nodes.view.config.frames=~"});
  const BranchWish wish{file, 2000, {{"seed", "77"}}, 4000, (folder_.path() / "branch.mcap").string()};
  const auto outcome = Branch(wish);
  ASSERT_TRUE(outcome.ok()) << outcome.error().Text();
  const auto branch = replay::RecordedRun::Open(wish.recording);
  ASSERT_TRUE(branch.ok()) << branch.error().Text();
  EXPECT_EQ(branch.value().launch().seed(), 77u);
  const auto verdict = Verify(branch.value(), 0);
  ASSERT_TRUE(verdict.ok()) << verdict.error().Text();
  EXPECT_FALSE(verdict.value().difference.has_value()) << verdict.value().difference->Text();
}

// What cannot save its state is computed from the first step, wherever one asks it to begin.
TEST_F(ReplayTest, ANodeWithoutAStateIsComputedFromTheStart) {
  const std::string file = Record("without.mcap", LaunchFile("empty.yaml"), {"--for", "1.5", "--set", "nodes.c.config.saves=false", "--set", "snapshot_every_s=0.5"});
  const auto late = VerifyFile(file, 1200);
  ASSERT_TRUE(late.ok()) << late.error().Text();
  EXPECT_FALSE(late.value().difference.has_value()) << late.value().difference->Text();
  EXPECT_EQ(late.value().first_step, 0);
  EXPECT_EQ(late.value().without_state, std::vector<std::string>{"c"});
  EXPECT_EQ(late.value().samples, 4u * 1501u + 4u * 4u);
  const auto said = RunCommand({Bin("rodeira"), "replay", file, "--verify", "--from", "1.2"});
  EXPECT_EQ(said.status, 0) << said.out;
  EXPECT_THAT(said.out, HasSubstr("node 'c' cannot save its state: all is computed again from step 0\nidentical: 1500 steps, 4 nodes"));
  EXPECT_THAT(RunCommand({Bin("rodeira"), "info", file}).out, HasSubstr("state   node 'c' cannot save its state: replayed from the first step"));
  // Its digests are compared like everybody's: a change of another node reaches it.
  const auto changed = VerifyFile(file, 1200, {{"nodes.c.config.broken", "clock"}});
  ASSERT_TRUE(changed.ok()) << changed.error().Text();
  ASSERT_TRUE(changed.value().difference.has_value());
  EXPECT_EQ(changed.value().difference->node, "c");
  EXPECT_EQ(changed.value().difference->step, 1);
}

// Unchanged, it goes on itself, to the bit: nobody could make another one that stands where it stood.
TEST_F(ReplayTest, ANodeWithoutAStateGoesOnInABranch) {
  const std::string file = Record("without.mcap", LaunchFile("empty.yaml"), {"--for", "1.5", "--set", "nodes.c.config.saves=false", "--set", "nodes.c.delay_s=0.003"});
  for (const lockstep::Step at : {0, 700}) {
    const BranchWish wish{file, at, {}, std::nullopt, (folder_.path() / ("branch" + std::to_string(at) + ".mcap")).string()};
    const auto outcome = Branch(wish);
    ASSERT_TRUE(outcome.ok()) << outcome.error().Text();
    EXPECT_EQ(outcome.value().recomputed_from, 0);
    EXPECT_EQ(outcome.value().without_state, std::vector<std::string>{"c"});
    EXPECT_TRUE(outcome.value().taken_over.empty());
    const auto parent = replay::RecordedRun::Open(file), branch = replay::RecordedRun::Open(wish.recording);
    ASSERT_TRUE(branch.ok()) << branch.error().Text();
    auto of_a = parent.value().Samples(), of_b = branch.value().Samples();
    std::size_t count = 0;
    for (;;) {
      const auto x = of_a.Next(), y = of_b.Next();
      ASSERT_EQ(x.value().has_value(), y.value().has_value());
      if (!x.value()) break;
      ++count;
      ASSERT_EQ(*x.value()->payload, *y.value()->payload) << "at step " << x.value()->valid();
    }
    EXPECT_EQ(count, 4u * 1501u + 4u * 2u);
    const auto verdict = Verify(branch.value(), 0);
    if (at == 0) {
      ASSERT_TRUE(verdict.ok()) << verdict.error().Text();
      EXPECT_FALSE(verdict.value().difference.has_value());
      continue;
    }
    ASSERT_FALSE(verdict.ok());
    EXPECT_EQ(verdict.error().exit_status(), 2);
    EXPECT_THAT(verdict.error().Text(), HasSubstr("node 'c' cannot save its state, and up to step 700 its parent's nodes computed"));
  }
  // Another node's change reaches it one step later; one of its own lets it begin from what it had published.
  const std::string other = (folder_.path() / "other.mcap").string(), own = (folder_.path() / "own.mcap").string();
  ASSERT_TRUE(Branch({file, 700, {{"nodes.a.config.broken", "order"}}, 1000, other}).ok());
  const auto fresh = Branch({file, 700, {{"nodes.c.config.saves", "true"}}, 1000, own});
  ASSERT_TRUE(fresh.ok()) << fresh.error().Text();
  EXPECT_EQ(fresh.value().taken_over, std::vector<std::string>{"c"});
  const auto first_other_value = [&](const std::string& name, const std::string& node) {
    const auto parent = replay::RecordedRun::Open(file), branch = replay::RecordedRun::Open(name);
    auto of_a = parent.value().Samples(), of_b = branch.value().Samples();
    for (;;) {
      const auto x = of_a.Next(), y = of_b.Next();
      if (!x.value() || !y.value()) return lockstep::Step{-1};
      const auto& source = parent.value().roster().source(x.value()->source());
      if (parent.value().roster().node(source.node).name == node && source.topic == "rodeira/pulse" && *x.value()->payload != *y.value()->payload) return x.value()->valid();
    }
  };
  EXPECT_EQ(first_other_value(other, "a"), 701);
  EXPECT_EQ(first_other_value(other, "c"), 704) << "activated at 701, valid three steps later";
  EXPECT_EQ(first_other_value(own, "c"), 703);
}

// Embedded files are unpacked to be read; what is wrong with one is said by its name in the recording, not by where it was unpacked.
TEST_F(ReplayTest, AnEmbeddedFileIsNamedAsItIsEmbedded) {
  const std::string file = Drive(1.0);
  const auto all = [](const std::string&, const record::Message&, base::Bytes&) { return true; };
  const auto nothing = [](const std::string&, record::TextMap&) {};
  const auto without = [&](const std::string& name) {
    const std::string copy = Copied(file, nothing, all, [&](const std::string& other) { return other != name; });
    const auto verdict = VerifyFile(copy);
    EXPECT_FALSE(verdict.ok()) << name;
    if (verdict.ok()) return std::string();
    EXPECT_EQ(verdict.error().exit_status(), 2) << name;
    EXPECT_THAT(verdict.error().Text(), ::testing::StartsWith(copy + ": ")) << name;
    EXPECT_THAT(verdict.error().Text(), ::testing::Not(HasSubstr("rodeira-replay"))) << name;
    return verdict.error().Text().substr(copy.size() + 2);
  };
  EXPECT_EQ(without("launch.yaml"), "the embedded file 'launch.yaml' is missing; without it nobody knows who took part");
  EXPECT_THAT(without("files/../configs/vehicles/default.yaml"), HasSubstr("../configs/vehicles/default.yaml: there is no such file"));
  EXPECT_THAT(without("files/../configs/worlds/plane.yaml"), HasSubstr("../configs/worlds/plane.yaml: there is no such file"));
  const auto wrong_change = Branch({file, 500, {{"nodes.ego.config.vehicel", "2"}}, std::nullopt, (folder_.path() / "branch.mcap").string()});
  ASSERT_FALSE(wrong_change.ok());
  EXPECT_THAT(wrong_change.error().Text(), ::testing::StartsWith(file + ": "));
  EXPECT_THAT(wrong_change.error().Text(), HasSubstr(": first_drive.yaml: unknown key 'nodes.ego.config.vehicel'"));
}

TEST_F(ReplayTest, ADifferenceIsSaidWithTheProgramThatRecorded) {
  const std::string file = Drive(1.0);
  const auto otherwise = [](const std::string& topic, const record::Message& message, base::Bytes& data) {
    if (topic == "rodeira/vehicle_state" && message.log_time_ns == 500'000'000) data[100] ^= std::byte{1};
    return true;
  };
  const auto verify = [](const std::string& recording) {
    const auto ended = RunCommand({Bin("rodeira"), "replay", recording, "--verify"});
    EXPECT_EQ(ended.status, 1) << ended.out;
    EXPECT_THAT(ended.out, HasSubstr("first difference at step 500"));
    return ended.out;
  };
  EXPECT_THAT(verify(Copied(file, [](const std::string&, record::TextMap&) {}, otherwise)), ::testing::Not(HasSubstr("recorded by another program")));
  const auto by_another = [](const std::string& name, record::TextMap& entries) {
    if (name == "rodeira") entries["commit"] = "0123456";
  };
  EXPECT_THAT(verify(Copied(file, by_another, otherwise)), HasSubstr("recorded by another program (version 0.1.0, commit 0123456; this one is version 0.1.0, commit "));
}

TEST_F(ReplayTest, AnotherProtocolAndAMissingSnapshotAreNamed) {
  const std::string file = Drive(2.0);
  const auto all = [](const std::string&, const record::Message&, base::Bytes&) { return true; };
  const auto nothing = [](const std::string&, record::TextMap&) {};
  const auto about_another = [](const std::string& name, record::TextMap& entries) {
    if (name == "rodeira") entries["protocol_hash"] = "0123456789abcdef";
  };
  const auto refused = VerifyFile(Copied(file, about_another, all));
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().exit_status(), 2);
  EXPECT_THAT(refused.error().Text(), HasSubstr("the recording's protocol hash is 0123456789abcdef, this program's is "));
  const std::string lacking = Copied(file, nothing, [](const std::string& topic, const record::Message& message, base::Bytes&) {
    return topic != idl::topics::kSnapshot || message.log_time_ns != 1'000'000'000;
  });
  const auto branch = Branch({lacking, 1500, {}, std::nullopt, (folder_.path() / "branch.mcap").string()});
  ASSERT_FALSE(branch.ok());
  EXPECT_EQ(branch.error().exit_status(), 2);
  EXPECT_THAT(branch.error().Text(), testing::MatchesRegex(".*the snapshot of node '[a-z]+' at step 1000 is missing.*"));
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
  for (const auto& [command, number, wait_ms] : {std::tuple(verify, SIGINT, 0), std::tuple(verify, SIGTERM, 200), std::tuple(to_branch, SIGINT, 0), std::tuple(to_branch, SIGTERM, 200)}) {
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

TEST_F(ReplayTest, WhatCannotBeReplayedIsRefusedInOneSentence) {
  const std::string file = Drive(1.0);
  const auto complaint = [&](std::vector<std::string> arguments) {
    std::vector<std::string> command{Bin("rodeira"), "replay"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const auto ended = RunCommand(command);
    EXPECT_EQ(ended.status, 2) << ended.out;
    EXPECT_EQ(std::count(ended.out.begin(), ended.out.end(), '\n'), 1) << ended.out;
    return ended.out;
  };
  EXPECT_THAT(complaint({file}), HasSubstr("nothing to do was named; --view, --frames, --verify or --branch was expected"));
  EXPECT_THAT(complaint({file, "--verify", "--from", "7"}), HasSubstr("the run ends at 1.000 s"));
  EXPECT_THAT(complaint({file, "--verify", "--from", "-1"}), HasSubstr("--from -1 s was found; a time from 0 s to the run's end was expected"));
  EXPECT_THAT(complaint({file, "--branch", "seed=2", "--from", "nan", "--record", "x.mcap"}), HasSubstr("--from nan s was found"));
  EXPECT_THAT(complaint({file, "--branch", "nodes.ego.config.vehicle=nonesuch.yaml", "--from", "0.5", "--record", "x.mcap"}), HasSubstr("nonesuch.yaml"));
  EXPECT_THAT(complaint({file, "--branch", "seed=2", "--from", "7", "--record", "x.mcap"}), HasSubstr("the run ends at 1.000 s"));
  EXPECT_THAT(complaint({file, "--branch", "seed=2", "--from", "0.503", "--record", "x.mcap"}), HasSubstr("the nearest such time is 0.500 s"));
  EXPECT_THAT(complaint({file, "--branch", "seed=2", "--from", "0.5"}), HasSubstr("--record is missing"));
  EXPECT_THAT(complaint({file, "--branch", "nodes.ego.config.vehicel=2", "--from", "0.5", "--record", "x.mcap"}), HasSubstr("unknown key 'nodes.ego.config.vehicel'"));
  EXPECT_THAT(complaint({file, "--branch", "nodes.ego.period_s=0.002", "--from", "0.5", "--record", "x.mcap"}), HasSubstr("another roster"));
  EXPECT_THAT(complaint({(folder_.path() / "none.mcap").string(), "--verify"}), HasSubstr("none.mcap"));
  std::ofstream(folder_.path() / "text.mcap") << "hello";
  EXPECT_THAT(complaint({(folder_.path() / "text.mcap").string(), "--verify"}), HasSubstr("text.mcap"));
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  EXPECT_THAT(complaint({file, "--verify"}), HasSubstr("the recording is not whole"));
}

}  // namespace
}  // namespace rodeira::front
