// SPDX-License-Identifier: Apache-2.0
// A branch continues a recording from any step: up to there its samples are the parent's, bit for bit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

#include "common/core/base/files.hpp"
#include "common/data/record/mcap_reader.hpp"
#include "common/data/record/mcap_writer.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "launch/rodeira/replay/branch.hpp"
#include "launch/rodeira/replay/recording_audit.hpp"
#include "launch/rodeira/replay/verify.hpp"
#include "tests/launch/rodeira/replay/replay_fixture.hpp"
#include "tests/names.hpp"
#include "tests/system/recording.hpp"
#include "tests/tree.hpp"

namespace rodeira::cli {
namespace {

using ::testing::HasSubstr;

using BranchTest = ReplayTest;

TEST_F(BranchTest, ABranchWithoutAChangeIsItsParent) {
  const std::string file = Drive();
  BranchSpec spec{file, 1500, {}, std::nullopt, (folder_.path() / "branch.mcap").string()};
  const auto outcome = Branch(spec);
  ASSERT_TRUE(outcome.ok()) << outcome.error().Text();
  EXPECT_FALSE(outcome.value().difference.has_value());
  EXPECT_EQ(outcome.value().recomputed_from, 1000);
  EXPECT_TRUE(outcome.value().taken_over.empty());
  auto a = replay::RecordedRun::Open(file);
  auto b = replay::RecordedRun::Open(spec.recording);
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
  EXPECT_EQ(count, 2u * 3001u + 301u + 8u);
  const auto reader = record::McapReader::Open(spec.recording);
  const auto end = reader.value().FindMetadata("rodeira.end").value()->entries;
  EXPECT_EQ(end.at("samples"), std::to_string(count)) << "the parent's are counted too";
  EXPECT_EQ(end.at("missing"), "0");
}

// A person who stops it is told so, also where no step was driven yet.
TEST_F(BranchTest, ABranchStoppedAtOnceSaysSo) {
  const std::string file = Drive();
  for (const lockstep::Step at : {0, 1500}) {
    BranchSpec spec{file, at, {}, std::nullopt, (folder_.path() / "branch.mcap").string()};
    bool is_branching =
        false;  // the parent has been computed up to there, and the operator is asked for the first time
    spec.next_command = [&] {
      is_branching = true;
      return std::optional<lockstep::OperatorCommand>();
    };
    spec.stop_requested = [&] { return is_branching; };
    const auto outcome = Branch(spec);
    ASSERT_FALSE(outcome.ok());
    EXPECT_EQ(outcome.error().exit_status(), 1);
    EXPECT_THAT(outcome.error().Text(), HasSubstr("interrupted at step ")) << at;
    EXPECT_FALSE(std::filesystem::exists(spec.recording));
  }
}

// Marks and wall times are those of the parent up to the branch's first step, and the branch's own from there on.
TEST_F(BranchTest, ABranchHasMarksAndWallTimesOfParentAndBranch) {
  const std::string file = Drive();
  BranchSpec spec{file, 1500, {}, std::nullopt, (folder_.path() / "branch.mcap").string()};
  int asked = 0;
  std::string marked;
  spec.next_command = [&]() -> std::optional<lockstep::OperatorCommand> {
    // The mark is sent again until the branch has begun. The run reads commands until none comes.
    if (++asked % 2 == 0 || marked.starts_with("marked step ")) return std::nullopt;
    lockstep::Command mark;
    mark.kind = lockstep::Command::Kind::kMark;
    mark.text = "hello";
    return lockstep::OperatorCommand{
        mark, [&](const base::Result<std::string>& done) { marked = done ? done.value() : done.error().Text(); }};
  };
  spec.pace = 2;
  ASSERT_TRUE(Branch(spec).ok());
  const auto of_parent = system_test::MessagesOf<msg::WallTime>(file, idl::topics::kWallTime);
  const auto of_branch = system_test::MessagesOf<msg::WallTime>(spec.recording, idl::topics::kWallTime);
  std::size_t same = 0;
  while (same < of_parent.size() && of_parent[same].after_step() < 1500) ++same;
  ASSERT_GT(same, 0u);
  ASSERT_GT(of_branch.size(), same);
  // The last of them may reach beyond the branch's first step, and beyond its first grant.
  for (std::size_t i = 0; i < same; ++i) {
    EXPECT_TRUE(std::any_of(of_branch.begin(), of_branch.end(), [&](const msg::WallTime& wall) {
      return wall.utc_ns() == of_parent[i].utc_ns();
    })) << i;
  }
  for (std::size_t i = same; i < of_branch.size(); ++i) EXPECT_GE(of_branch[i].through_step(), 1500) << i;
  EXPECT_EQ(of_branch.back().through_step(), 3000);
  EXPECT_EQ(Audit(record::McapReader::Open(spec.recording).value()).steps_without_wall_time, 0);
  std::string kinds;
  for (const auto& remark : system_test::MessagesOf<msg::Remark>(spec.recording, idl::topics::kRemarks)) {
    kinds += remark.kind() + " ";
    if (remark.kind() == "mark") {
      EXPECT_EQ(remark.text(), "hello");
    }
  }
  EXPECT_THAT(marked, HasSubstr("marked step "));
  EXPECT_EQ(kinds, "start start mark end ");
}

TEST_F(BranchTest, ABranchLastsAsLongAsItsChangesSayAndTellsWhatItsParentAnswersFor) {
  const std::string file = Drive();
  const std::string branch = (folder_.path() / "branch.mcap").string();
  const auto outcome = Branch({file, 1500, {{"duration_s", "2.5"}}, std::nullopt, branch});
  ASSERT_TRUE(outcome.ok()) << outcome.error().Text();
  EXPECT_EQ(outcome.value().last_step, 2500);
  const auto verified = RunCommand({Bin("rodeira"), "replay", branch, "--verify"});
  EXPECT_EQ(verified.status, 0) << verified.out;
  EXPECT_THAT(verified.out,
              HasSubstr("not computed: what lies before 2.000 s is its parent's; verify that one, drive.mcap"));
}

// What a user keeps beside it is not the branch's.
TEST_F(BranchTest, ABranchTouchesNoOtherFile) {
  const std::string file = Drive();
  const auto precious = folder_.Write("branch.mcap.part", "precious");
  BranchSpec spec{file, 1500, {}, std::nullopt, (folder_.path() / "branch.mcap").string()};
  ASSERT_TRUE(Branch(spec).ok());
  EXPECT_EQ(base::ReadText(precious).value(), "precious");
}

TEST_F(BranchTest, ABranchHasItsParentsPastAndItsOwnFuture) {
  const std::string file = Drive();
  const auto script = folder_.Write("brake.csv", "time_s,steering_wheel_rad,throttle,brake\n0,0,0,1\n");
  BranchSpec spec{file,
                  2000,
                  {{"nodes.driver.config.script", "\"" + script.string() + "\""}},
                  4000,
                  (folder_.path() / "branch.mcap").string()};
  const auto outcome = Branch(spec);
  ASSERT_TRUE(outcome.ok()) << outcome.error().Text();
  EXPECT_EQ(outcome.value().last_step, 4000);
  auto parent = replay::RecordedRun::Open(file);
  auto branch = replay::RecordedRun::Open(spec.recording);
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
TEST_F(BranchTest, ABranchMayLeaveAtTheFirstStepAndABranchsBranchBehindItsOwn) {
  const std::string file = Drive();
  const std::string first = (folder_.path() / "first.mcap").string(),
                    second = (folder_.path() / "second.mcap").string();
  BranchSpec spec{file, 0, {}, std::nullopt, first};
  const auto outcome = Branch(spec);
  ASSERT_TRUE(outcome.ok()) << outcome.error().Text();
  const auto parent = replay::RecordedRun::Open(file), branch = replay::RecordedRun::Open(first);
  auto of_a = parent.value().Samples(), of_b = branch.value().Samples();
  for (;;) {
    const auto x = of_a.Next(), y = of_b.Next();
    ASSERT_EQ(x.value().has_value(), y.value().has_value());
    if (!x.value()) break;
    ASSERT_EQ(*x.value()->payload, *y.value()->payload) << "at step " << x.value()->valid();
  }
  spec = {file, 1500, {}, std::nullopt, second};
  ASSERT_TRUE(Branch(spec).ok());
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

// The car of another model goes on where the other one was: pose, speed and yaw rate at the next published step.
TEST_F(BranchTest, ABranchMayHaveAnotherVehicleModel) {
  const std::string file = Drive(4.0);
  const std::string other = SourceDir() + "/configs/vehicles/prototype.yaml";
  const BranchSpec spec{
      file, 3000, {{"nodes.ego.config.vehicle", "\"" + other + "\""}}, 4000, (folder_.path() / "branch.mcap").string()};
  const auto outcome = Branch(spec);
  ASSERT_TRUE(outcome.ok()) << outcome.error().Text();
  EXPECT_EQ(outcome.value().taken_over, std::vector<std::string>{"ego"});
  // A word does the same where the car's file names the other one.
  const BranchSpec by_word{
      file, 3000, {{"vehicle.model", "multibody"}}, 4000, (folder_.path() / "by_word.mcap").string()};
  const auto worded = Branch(by_word);
  ASSERT_TRUE(worded.ok()) << worded.error().Text();
  EXPECT_EQ(worded.value().taken_over, std::vector<std::string>{"ego"});
  EXPECT_EQ(CarAt(replay::RecordedRun::Open(by_word.recording).value(), 4000),
            CarAt(replay::RecordedRun::Open(spec.recording).value(), 4000));
  const auto parent = replay::RecordedRun::Open(file), branch = replay::RecordedRun::Open(spec.recording);
  ASSERT_TRUE(branch.ok()) << branch.error().Text();
  const auto was = CarAt(parent.value(), 3005), is = CarAt(branch.value(), 3005), later = CarAt(branch.value(), 4000),
             default_value = CarAt(parent.value(), 4000);
  EXPECT_GT(was.velocity_w_mps().x(), 1.0);
  EXPECT_NEAR(is.position_w_m().x(), was.position_w_m().x(), 0.005);
  EXPECT_NEAR(is.position_w_m().y(), was.position_w_m().y(), 0.005);
  EXPECT_NEAR(is.position_w_m().z(), was.position_w_m().z(), 0.3) << "another car's origin";
  EXPECT_NEAR(is.velocity_w_mps().x(), was.velocity_w_mps().x(), 0.05);
  EXPECT_GT(std::fabs(later.velocity_w_mps().x() - default_value.velocity_w_mps().x()), 0.01) << "and is another car";
  const auto verdict = Verify(branch.value(), 0);
  ASSERT_TRUE(verdict.ok()) << verdict.error().Text();
  EXPECT_FALSE(verdict.value().difference.has_value()) << verdict.value().difference->Text();
}

TEST_F(BranchTest, ABranchMayHaveAnotherTrafficSeed) {
  const std::string file = Record("traffic.mcap", LaunchFile("demo.yaml"),
                                  {"--for", "4", "--headless", "--set", "nodes.view.config.frames=~"});
  const BranchSpec spec{file, 2000, {{"seed", "77"}}, 4000, (folder_.path() / "branch.mcap").string()};
  const auto outcome = Branch(spec);
  ASSERT_TRUE(outcome.ok()) << outcome.error().Text();
  const auto branch = replay::RecordedRun::Open(spec.recording);
  ASSERT_TRUE(branch.ok()) << branch.error().Text();
  EXPECT_EQ(branch.value().launch().seed(), 77u);
  const auto verdict = Verify(branch.value(), 0);
  ASSERT_TRUE(verdict.ok()) << verdict.error().Text();
  EXPECT_FALSE(verdict.value().difference.has_value()) << verdict.value().difference->Text();
  // Another number of vehicles is refused: their states are the parent's.
  const auto more = Branch({file, 2000, {{"nodes.traffic.config.vehicles", "21"}}, 2100, spec.recording + "2"});
  ASSERT_FALSE(more.ok());
  EXPECT_THAT(more.error(), IsError("run.cannot_restore", "'traffic' … nodes.traffic.config.vehicles"));
}

// Unchanged, it goes on itself, to the bit: no other one could stand where it stood.
TEST_F(BranchTest, ANodeWithoutAStateGoesOnInABranch) {
  const std::string file =
      Record("without.mcap", LaunchFile("empty.yaml"),
             {"--for", "1.5", "--set", "nodes.c.config.saves=false", "--set", "nodes.c.delay_s=0.003"});
  for (const lockstep::Step at : {0, 700}) {
    const BranchSpec spec{
        file, at, {}, std::nullopt, (folder_.path() / ("branch" + std::to_string(at) + ".mcap")).string()};
    const auto outcome = Branch(spec);
    ASSERT_TRUE(outcome.ok()) << outcome.error().Text();
    EXPECT_EQ(outcome.value().recomputed_from, 0);
    EXPECT_EQ(outcome.value().without_state, std::vector<std::string>{"c"});
    EXPECT_TRUE(outcome.value().taken_over.empty());
    const auto parent = replay::RecordedRun::Open(file), branch = replay::RecordedRun::Open(spec.recording);
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
    EXPECT_THAT(verdict.error().Text(),
                HasSubstr("node 'c' cannot save its state, and up to step 700 its parent's nodes computed"));
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
      if (parent.value().roster().node(source.node).name == node && source.topic == "rodeira/pulse" &&
          *x.value()->payload != *y.value()->payload)
        return x.value()->valid();
    }
  };
  EXPECT_EQ(first_other_value(other, "a"), 701);
  EXPECT_EQ(first_other_value(other, "c"), 704) << "activated at 701, valid three steps later";
  EXPECT_EQ(first_other_value(own, "c"), 703);
}

}  // namespace
}  // namespace rodeira::cli
