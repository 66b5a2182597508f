// SPDX-License-Identifier: Apache-2.0
// The nodes of examples/own_node take part in whole runs as Rodeira's own do: lockstep, digest, recording,
// verification, restart. What is wrong with one ends the run with one sentence, and nothing is left.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <set>

#include "common/core/base/files.hpp"
#include "launch/rodeira/run/shared_memory.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/names.hpp"
#include "tests/system/command.hpp"
#include "tests/system/recording.hpp"
#include "tests/tree.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

const fs::path kExample = fs::path(SourceDir()) / "examples/own_node";

class OwnNode : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* file : {"eye.yaml", "monitor.yaml", "gaze.idl"}) fs::copy(kExample / file, folder_.path() / file);
    fs::create_symlink(Bin("rodeira-test-eye-tracker"), folder_.path() / "eye_tracker");
    fs::create_symlink(Bin("rodeira-test-gaze-monitor"), folder_.path() / "gaze_monitor");
    fs::create_symlink(Bin("rodeira-test-eye-tracker.so"), folder_.path() / "eye_tracker.so");
    fs::create_symlink(Bin("rodeira-test-gaze-monitor.so"), folder_.path() / "gaze_monitor.so");
    std::string text = base::ReadText(kExample / "own_node.yaml.in").value();
    for (std::size_t at; (at = text.find("@RODEIRA_DATA@")) != std::string::npos;)
      text.replace(at, std::string("@RODEIRA_DATA@").size(), SourceDir());
    launch_ = folder_.Write("own_node.yaml", text).string();
  }
  std::string File(const std::string& name) const { return (folder_.path() / name).string(); }
  std::vector<std::string> Command(const std::string& recording, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> command{Bin("rodeira"), "run", launch_, "--run", Name(), "--record", File(recording)};
    if (std::ranges::find(more, "--for") == more.end()) command.insert(command.end(), {"--for", "2"});
    command.insert(command.end(), more.begin(), more.end());
    return command;
  }
  std::string Name() const { return "own-" + folder_.path().filename().string(); }
  Ended Run(const std::string& recording, const std::vector<std::string>& more = {}) const {
    return RunCommand(Command(recording, more));
  }
  // A run that ends with this status, with one line that holds the node's name, and leaves nothing.
  std::string Failure(int status, const std::vector<std::string>& more = {}) const {
    const auto before = cli::SharedMemoryFiles();
    const auto begin = std::chrono::steady_clock::now();
    fs::remove(File("never.mcap"));
    const Ended ended = Run("never.mcap", more);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, 30s);
    EXPECT_EQ(ended.status, status) << ended.out;
    EXPECT_THAT(ended.out, HasSubstr("eye"));
    EXPECT_TRUE(ProcessesWith("--run " + Name()).empty());
    std::set<std::string> left;
    std::ranges::set_difference(cli::SharedMemoryFiles(), before, std::inserter(left, left.end()));
    EXPECT_TRUE(left.empty()) << *left.begin();
    const bool has_report = ended.out.find("rodeira: report of the failure: ") != std::string::npos;
    EXPECT_EQ(std::ranges::count(ended.out, '\n'), has_report ? 2 : 1) << "one sentence was expected:\n" << ended.out;
    return ended.out;
  }
  // Until so much of a recording is on the disk: the run is under way then.
  static void WaitForBytes(const std::string& recording, std::uintmax_t bytes) {
    const auto until = std::chrono::steady_clock::now() + 30s;
    std::error_code missing;
    for (std::uintmax_t size = 0; size < bytes && std::chrono::steady_clock::now() < until; ::usleep(5000)) {
      size = fs::file_size(recording, missing);
      if (missing) size = 0;
    }
    ASSERT_GE(fs::file_size(recording, missing), bytes);
  }
  // A program that does this in place of the eye tracker.
  std::string Script(const std::string& text) const {
    return "nodes.eye.program=" + folder_.Write("script", "#!/bin/sh\n" + text + "\n", 0755).string();
  }
  const cli::TemporaryFolder folder_;
  std::string launch_;
};

TEST_F(OwnNode, HasOneDigestInEveryRunAndOverEveryTransport) {
  const Ended first = Run("first.mcap");
  ASSERT_EQ(first.status, 0) << first.out;
  EXPECT_THAT(first.out, HasSubstr("gaze_monitor: 201 samples, farthest glance"));
  const Ended second = Run("second.mcap");
  const Ended udp = Run("udp.mcap", {"--set", "transport=udp"});
  EXPECT_NE(DigestIn(first.out), "");
  EXPECT_EQ(DigestIn(second.out), DigestIn(first.out)) << second.out;
  EXPECT_EQ(DigestIn(udp.out), DigestIn(first.out)) << udp.out;
  EXPECT_EQ(FirstDifference(SamplesOf(File("first.mcap")), SamplesOf(File("udp.mcap"))), "");
  const Ended other = Run("other.mcap", {"--set", "nodes.eye.config.lookahead_s=2"});
  EXPECT_NE(DigestIn(other.out), DigestIn(first.out)) << "the node is in the digest";
}

// The monitor's factory asks for none of its keys.
TEST_F(OwnNode, KeysOfANodeThatReadsNoneAreRefused) {
  for (const bool in_process : {false, true}) {
    std::vector<std::string> more{"--set", "nodes.monitor.config={lookahead_s: 2}"};
    if (in_process) more.push_back("--in-process");
    const Ended ended = Run("never.mcap", more);
    EXPECT_EQ(ended.status, 2) << ended.out;
    EXPECT_THAT(ended.out, HasSubstr("unknown key 'nodes.monitor.config.lookahead_s'"));
  }
}

TEST_F(OwnNode, IsRecordedWithItsTypeAndVerifiedByItsSamples) {
  ASSERT_EQ(Run("own.mcap").status, 0);
  const auto reader = record::McapReader::Open(File("own.mcap"));
  ASSERT_TRUE(reader.ok());
  const auto channels = reader.value().ChannelsOf("lab/gaze");
  ASSERT_EQ(channels.size(), 1u);
  const auto& schema = reader.value().schemas().at(reader.value().channels().at(*channels.begin()).schema);
  EXPECT_EQ(schema.name, "lab::Gaze");
  EXPECT_THAT(schema.text, HasSubstr("struct SampleHeader"));
  EXPECT_THAT(schema.text, Not(HasSubstr("#include")));
  const Ended info = RunCommand({Bin("rodeira"), "info", File("own.mcap")});
  EXPECT_EQ(info.status, 0) << info.out;
  EXPECT_THAT(info.out, HasSubstr("lab/gaze"));
  EXPECT_THAT(info.out, HasSubstr("lossless"));
  const Ended table = RunCommand({Bin("rodeira"), "export", File("own.mcap"), "--csv", File("tables")});
  EXPECT_EQ(table.status, 0) << table.out;
  bool has_column = false;
  for (const auto& entry : fs::recursive_directory_iterator(File("tables"))) {
    if (entry.path().extension() != ".csv") continue;
    has_column = has_column || base::ReadText(entry.path()).value().find("target_x_m") != std::string::npos;
  }
  EXPECT_TRUE(has_column);

  // The folder of the launch file is not needed any more.
  for (const char* file : {"eye.yaml", "gaze.idl", "eye_tracker"}) fs::remove(folder_.path() / file);
  const Ended verified = RunCommand({Bin("rodeira"), "replay", File("own.mcap"), "--verify"});
  EXPECT_EQ(verified.status, 0) << verified.out;
  EXPECT_THAT(verified.out,
              HasSubstr("not computed again, their programs are not part of Rodeira: eye; their samples"));
  EXPECT_THAT(verified.out, HasSubstr("identical: 2000 steps, 2 nodes"));
  const Ended branch = RunCommand({Bin("rodeira"), "replay", File("own.mcap"), "--from", "1", "--branch", "seed=2",
                                   "--record", File("branch.mcap")});
  EXPECT_EQ(branch.status, 2) << branch.out;
  EXPECT_THAT(branch.out, HasSubstr("node 'eye' is an external program, which a branch cannot run"));
  EXPECT_FALSE(fs::exists(File("branch.mcap")));
}

TEST_F(OwnNode, RunsInOneProcessAsASharedObject) {
  const Ended apart = Run("apart.mcap");
  ASSERT_EQ(apart.status, 0) << apart.out;
  const Ended together = Run("together.mcap", {"--in-process"});
  ASSERT_EQ(together.status, 0) << together.out;
  EXPECT_THAT(together.out, HasSubstr("gaze_monitor: 201 samples"));
  EXPECT_EQ(DigestIn(together.out), DigestIn(apart.out));
  EXPECT_EQ(FirstDifference(SamplesOf(File("apart.mcap")), SamplesOf(File("together.mcap"))), "");
}

// Its shared object is loaded by the process that it shares with nodes of Rodeira and with another external one.
TEST_F(OwnNode, InASharedProcessItHasTheSameDigest) {
  const Ended apart = Run("apart.mcap", {"--for", "6"});
  ASSERT_EQ(apart.status, 0) << apart.out;
  std::vector<std::string> more{"--for", "6"};
  for (const char* node : {"driver", "ego", "eye", "monitor"})
    more.insert(more.end(), {"--set", std::string("nodes.") + node + ".process=cars"});
  const Ended shared = Run("shared.mcap", more);
  ASSERT_EQ(shared.status, 0) << shared.out;
  EXPECT_THAT(shared.out, HasSubstr("gaze_monitor: 601 samples"));
  EXPECT_EQ(DigestIn(shared.out), DigestIn(apart.out));
  EXPECT_EQ(FirstDifference(SamplesOf(File("apart.mcap")), SamplesOf(File("shared.mcap"))), "");
  const Ended restarted = [&] {
    more.insert(more.end(), {"--pace", "2", "--set", "recovery=restart"});
    Started run(Command("restarted.mcap", more));
    EXPECT_TRUE(Runs(Name()));
    WaitForGrowth(File("restarted.mcap"));
    const pid_t victim = ProcessWith("--run " + Name(), "--process cars");
    if (victim > 0) ::kill(victim, SIGKILL);
    EXPECT_GT(victim, 0);
    return run.Wait(60s);
  }();
  ASSERT_EQ(restarted.status, 0) << restarted.out;
  EXPECT_THAT(restarted.out, Names("again … process 'cars' … signal 9"));
  EXPECT_EQ(DigestIn(restarted.out), DigestIn(apart.out)) << restarted.out;
}

TEST_F(OwnNode, AWrongSharedObjectInASharedProcessIsRefused) {
  const auto with = [&](const std::string& file) {
    return Failure(
        2, {"--set", "nodes.eye.library=" + file, "--set", "nodes.eye.process=p", "--set", "nodes.monitor.process=p"});
  };
  EXPECT_THAT(with("none.so"), HasSubstr("none.so"));
  EXPECT_THAT(with(Bin("rodeira-test-other-build.so")), HasSubstr("rodeira-test-other-build.so"));
  EXPECT_THAT(with("~"), HasSubstr("'library'"));
  std::string text = base::ReadText(folder_.path() / "gaze.idl").value();
  folder_.Write("gaze.idl", text.replace(text.find("double target_x_m"), 17, "float target_x_m"));
  EXPECT_THAT(with("eye_tracker.so"), HasSubstr("lab/gaze"));
  EXPECT_FALSE(fs::exists(File("never.mcap")));
}

TEST_F(OwnNode, IsVerifiedAndBranchedWithItsSharedObject) {
  ASSERT_EQ(Run("own.mcap").status, 0);
  const std::string library = "eye=" + Bin("rodeira-test-eye-tracker.so");
  const Ended verified = RunCommand({Bin("rodeira"), "replay", File("own.mcap"), "--verify", "--library", library});
  EXPECT_EQ(verified.status, 0) << verified.out;
  EXPECT_THAT(verified.out, HasSubstr("identical: 2000 steps, 3 nodes"));
  EXPECT_THAT(verified.out, Not(HasSubstr("not computed again")));
  const auto branch = [&](const std::string& change, const std::string& file) {
    return RunCommand({Bin("rodeira"), "replay", File("own.mcap"), "--from", "1", "--branch", change, "--library",
                       library, "--record", File(file)});
  };
  const Ended same = branch("nodes.eye.config.lookahead_s=1.5", "same.mcap");
  ASSERT_EQ(same.status, 0) << same.out;
  EXPECT_EQ(FirstDifference(SamplesOf(File("own.mcap")), SamplesOf(File("same.mcap"))), "");
  const Ended other = branch("nodes.eye.config.lookahead_s=2.5", "other.mcap");
  ASSERT_EQ(other.status, 0) << other.out;
  EXPECT_THAT(FirstDifference(SamplesOf(File("own.mcap")), SamplesOf(File("other.mcap"))), HasSubstr("lab/gaze"));
  const Ended again = RunCommand({Bin("rodeira"), "replay", File("other.mcap"), "--verify", "--library", library});
  EXPECT_EQ(again.status, 0) << again.out;

  const Ended unknown = RunCommand({Bin("rodeira"), "replay", File("own.mcap"), "--verify", "--library", "ey=x.so"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.out, HasSubstr("--library: the recording has no external node 'ey'; did you mean 'eye'?"));
  const Ended shown =
      RunCommand({Bin("rodeira"), "replay", File("own.mcap"), "--frames", File("frames"), "--library", library});
  EXPECT_EQ(shown.status, 2);
  EXPECT_THAT(shown.out, HasSubstr("--library is of --verify and --branch"));
  const Ended missing = RunCommand({Bin("rodeira"), "replay", File("own.mcap"), "--verify", "--library", "eye=/no.so"});
  EXPECT_EQ(missing.status, 2);
  EXPECT_THAT(missing.out, HasSubstr("node 'eye'"));
  EXPECT_THAT(missing.out, HasSubstr("No such file"));
}

TEST_F(OwnNode, AWrongSharedObjectIsRefused) {
  const auto with = [&](const std::string& file) {
    return Failure(2, {"--in-process", "--set", "nodes.eye.library=" + file});
  };
  EXPECT_THAT(with("none.so"), HasSubstr("cannot load the shared object"));
  folder_.Write("text.so", "this is no shared object");
  EXPECT_THAT(with("text.so"), HasSubstr("cannot load the shared object"));
  EXPECT_THAT(with(Bin("rodeira-test-no-node.so")), HasSubstr("no entry point 'rodeira_node_build'"));
  EXPECT_THAT(with(Bin("rodeira-test-other-build.so")),
              HasSubstr("was built with an earlier Rodeira, this program is"));
  EXPECT_THAT(with("~"), HasSubstr("a run in one process needs its shared object, as 'library'"));
  std::string text = base::ReadText(folder_.path() / "gaze.idl").value();
  folder_.Write("gaze.idl", text.replace(text.find("double target_x_m"), 17, "float target_x_m"));
  EXPECT_THAT(with("eye_tracker.so"), HasLine("lab/gaze … manifest's"));
  EXPECT_FALSE(fs::exists(File("never.mcap")));
}

TEST_F(OwnNode, KilledItIsStartedAgainAndNothingIsLost) {
  const Ended calm = Run("calm.mcap", {"--for", "4"});
  ASSERT_EQ(calm.status, 0) << calm.out;
  for (const char* node : {"eye", "monitor"}) {
    Started run(Command("killed.mcap", {"--for", "4", "--pace", "2", "--set", "recovery=restart"}));
    ASSERT_TRUE(Runs(Name()));
    WaitForBytes(File("killed.mcap"), 100'000);
    const auto victim = ProcessesWith("--run " + Name(), std::string("--node ") + node);
    ASSERT_EQ(victim.size(), 1u);
    ::kill(victim.front(), SIGKILL);
    const Ended ended = run.Wait(60s);
    ASSERT_EQ(ended.status, 0) << ended.out;
    EXPECT_THAT(ended.out, HasSubstr(std::string("node '") + node + "' was killed by signal 9"));
    EXPECT_EQ(DigestIn(ended.out), DigestIn(calm.out)) << ended.out;
    EXPECT_EQ(FirstDifference(SamplesOf(File("calm.mcap")), SamplesOf(File("killed.mcap"))), "");
    fs::remove(File("killed.mcap"));
  }
}

TEST_F(OwnNode, WithoutAStateItIsNotStartedAgain) {
  std::string text = base::ReadText(folder_.path() / "eye.yaml").value();
  folder_.Write("eye.yaml", text.replace(text.find("can_save: true"), 14, "can_save: false"));
  EXPECT_THAT(Failure(2, {"--set", "recovery=restart"}),
              HasSubstr("node 'eye' cannot save its state, so it cannot be started again"));
  const Ended ended = Run("own.mcap");
  ASSERT_EQ(ended.status, 0) << ended.out;
  const Ended verified = RunCommand({Bin("rodeira"), "replay", File("own.mcap"), "--verify", "--from", "1"});
  EXPECT_EQ(verified.status, 0) << verified.out;
  EXPECT_THAT(verified.out, HasSubstr("from 1.000 s")) << "its samples stand in, so the others begin at a snapshot";
}

TEST_F(OwnNode, AProgramThatCannotBeStartedIsRefusedBeforeTheRun) {
  EXPECT_THAT(Failure(2, {"--set", "nodes.eye.program=eye_trackr"}),
              HasSubstr("eye_trackr: No such file or directory"));
  folder_.Write("plain", "#!/bin/sh\n");
  EXPECT_THAT(Failure(2, {"--set", "nodes.eye.program=plain"}), HasSubstr("plain: Permission denied"));
  EXPECT_THAT(Failure(2, {"--set", "nodes.eye.program=."}), HasSubstr("Is a directory"));
  EXPECT_FALSE(fs::exists(File("never.mcap")));
}

TEST_F(OwnNode, AProgramThatNeverTakesPartEndsTheRun) {
  EXPECT_THAT(Failure(1, {"--set", Script("exit 0")}), HasSubstr("node 'eye' left with status 0"));
  EXPECT_THAT(Failure(2, {"--set", Script("echo 'rodeira: end: refused 0 the eye is shut' >&2; exit 2")}),
              HasSubstr("node 'eye' failed at step 0: the eye is shut"))
      << "the last word needs no network";
  EXPECT_THAT(Failure(1, {"--set", Script("exit 7")}), HasSubstr("node 'eye' left with status 7"));
  EXPECT_THAT(Failure(1, {"--set", Script("kill -SEGV $$")}), HasLine("node 'eye' … signal 11"));
  EXPECT_THAT(Failure(1, {"--set", Script("exec sleep 100"), "--set", "limits.start_s=2"}), HasSubstr("'eye'"));
  folder_.Write("noise", "this is no program", 0755);
  EXPECT_THAT(Failure(1, {"--set", "nodes.eye.program=noise"}), HasSubstr("node 'eye' could not be started"));
}

TEST_F(OwnNode, AProgramOfAnotherBuildIsRefused) {
  const std::string program = Bin("rodeira-test-eye-tracker-pretends");
  const std::string pretend = "PRETEND_TYPE='rodeira/vehicle_state|double odometer_m|float odometer_m' exec ";
  EXPECT_THAT(Failure(2, {"--set", Script(pretend + program + " \"$@\"")}),
              HasLine("rodeira/vehicle_state … odometer_m"));
  std::string text = base::ReadText(folder_.path() / "gaze.idl").value();
  folder_.Write("gaze.idl", text.replace(text.find("double target_x_m"), 17, "float target_x_m"));
  const std::string said = Failure(2, {"--set", "nodes.monitor.kind=none"});
  EXPECT_THAT(said, HasSubstr("node 'eye'"));
  EXPECT_THAT(said, HasLine("lab/gaze … lab::Gaze, member 2"));
  EXPECT_THAT(said, HasSubstr("build its program again"));
}

TEST_F(OwnNode, AWrongManifestIsRefusedBeforeTheRun) {
  folder_.Write("eye.yaml", "rodeira: node/1\nperiod_s: 0.01\ninputs:\n  - {topic: rodeira/vehicle_state}\n");
  EXPECT_THAT(Failure(2), HasSubstr("eye.yaml:4: key 'inputs[0].port' is missing"));
  EXPECT_FALSE(fs::exists(File("never.mcap")));
}

}  // namespace
}  // namespace rodeira::system_test
