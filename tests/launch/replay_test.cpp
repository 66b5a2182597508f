// A recording is a fact: computed again it is the same to the bit, and whatever is not is found and named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <fstream>
#include <thread>

#include "common/record/mcap_reader.hpp"
#include "common/record/mcap_writer.hpp"
#include "launch/branch.hpp"
#include "launch/verify.hpp"
#include "tests/launch/temporary_folder.hpp"
#include "tests/system/command.hpp"

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

  // A copy of the recording with one bit of one message turned.
  std::string WithABitTurned(const std::string& file, const std::string& topic, std::uint64_t message_number, std::size_t byte) {
    const std::string copy = (folder_.path() / "turned.mcap").string();
    auto reader = record::McapReader::Open(file);
    auto writer = record::McapWriter::Open(copy);
    const auto& in = reader.value();
    for (const auto& info : in.metadata()) EXPECT_TRUE(writer.value().AddMetadata(info.name, in.ReadMetadata(info).value().entries).ok());
    for (const auto& info : in.attachments()) EXPECT_TRUE(writer.value().AddAttachment(info.name, info.media_type, in.ReadAttachment(info).value().data, 0, 0).ok());
    std::map<record::ChannelId, record::ChannelId> ids;
    for (const auto& [id, channel] : in.channels()) {
      const auto& schema = in.schemas().at(channel.schema);
      const auto made = writer.value().AddSchema(schema.name, schema.encoding, schema.text);
      ids[id] = writer.value().AddChannel(channel.topic, made.value(), channel.message_encoding, channel.metadata).value();
    }
    auto cursor = in.Messages();
    std::uint64_t seen = 0;
    for (auto message = cursor.Next(); message.value(); message = cursor.Next()) {
      base::Bytes data(message.value()->data.begin(), message.value()->data.end());
      if (in.channels().at(message.value()->channel).topic == topic && seen++ == message_number) data[byte] ^= std::byte{1};
      EXPECT_TRUE(writer.value().Write(ids[message.value()->channel], message.value()->sequence, message.value()->log_time_ns, message.value()->publish_time_ns, data).ok());
    }
    EXPECT_TRUE(writer.value().Close().ok());
    return copy;
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
    EXPECT_THAT(run.out, HasSubstr("first difference at step 1: node 'c', topic rodeira/pulse")) << run.out;
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
