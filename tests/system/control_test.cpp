// SPDX-License-Identifier: Apache-2.0
// An operator at a whole run: pause, steps, paces, markers and stop from another process; what is recorded of it; and
// that none of it changes a sample.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <mutex>
#include <thread>

#include "common/runtime/dds/participant.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/names.hpp"
#include "tests/system/command.hpp"
#include "tests/system/recording.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;

class Control : public ::testing::Test {
 protected:
  std::string Runtime() const { return "XDG_RUNTIME_DIR=" + folder_.path().string(); }
  std::string Path(const std::string& name) const { return (folder_.path() / name).string(); }
  std::vector<std::string> Run(const std::string& name, std::vector<std::string> more) const {
    std::vector<std::string> command{Runtime(), Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--run", name};
    command.insert(command.end(), more.begin(), more.end());
    return command;
  }
  Ended Ctl(std::vector<std::string> words) const {
    words.insert(words.begin(), {Runtime(), Bin("rodeira"), "ctl"});
    return RunCommand(words);
  }
  // Asks until the run has begun; what it answers.
  std::string Begun(const std::string& run) const {
    for (int i = 0; i < 400; ++i) {
      const Ended state = Ctl({"state", "--run", run});
      if (state.status == 0) return state.out;
      std::this_thread::sleep_for(50ms);
    }
    return "it has not begun";
  }
  const cli::TemporaryFolder folder_;
};

// Every step of a run of `last` steps was granted once, in order, at a time that does not go back.
void ExpectAWallTimeForEveryStep(const std::string& recording, std::int64_t last) {
  const auto walls = MessagesOf<msg::WallTime>(recording, idl::topics::kWallTime);
  ASSERT_FALSE(walls.empty());
  std::int64_t through = -1, monotonic_ns = 0;
  for (const msg::WallTime& wall : walls) {
    ASSERT_EQ(wall.after_step(), through);
    ASSERT_GT(wall.through_step(), through);
    ASSERT_GE(wall.monotonic_ns(), monotonic_ns);
    ASSERT_GE(wall.late_ns(), 0);
    through = wall.through_step();
    monotonic_ns = wall.monotonic_ns();
  }
  EXPECT_EQ(through, last);
}

TEST_F(Control, WhatAnOperatorDoesChangesNoSampleAndIsRecorded) {
  const std::vector<std::string> common{"--for",           "1.5",    "--meta",
                                        "participant=P07", "--meta", "note=a \"quoted\": text"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), common.begin(), common.end());
    return more;
  };
  const Ended plain = RunCommand(Run("plain", with({"--record", Path("plain.mcap")})));
  ASSERT_EQ(plain.status, 0) << plain.out;
  const auto samples = SamplesOf(Path("plain.mcap"));
  ASSERT_GT(samples.size(), 4u * 1500u);
  for (const bool in_process : {false, true}) {
    const std::string name = in_process ? "one" : "many";
    // The pause is longer than any node may compute (0.6 s): a node that waits for the operator does not hang.
    std::vector<std::string> more{"--pace", "0.1", "--record", Path(name + ".mcap")};
    if (in_process) more.push_back("--in-process");
    Started run(Run(name, with(more)));
    EXPECT_NE(Begun(name).find("runs at 0.1 × real time at step "), std::string::npos);
    const auto ask = [&](std::vector<std::string> words) {
      const Ended ended = Ctl(std::move(words));  // the only run of this user: it needs no name
      EXPECT_EQ(ended.status, 0) << ended.out;
      return ended.out;
    };
    const std::string paused = ask({"pause"});
    EXPECT_EQ(paused.find("paused at step "), 0u) << paused;
    std::this_thread::sleep_for(1200ms);
    const std::string stands = ask({"state"}), place = paused.substr(0, paused.find('\n'));
    EXPECT_TRUE(stands.starts_with(place)) << "time stands still: " << stands;
    EXPECT_EQ(stands.find(" in domain ") == place.size(), !in_process) << "one process has no domain: " << stands;
    const Ended restart = Ctl({"restart", "aa"});
    EXPECT_EQ(restart.status, 2) << restart.out;
    EXPECT_THAT(restart.out, HasLine("node 'aa' … a, b, c, d"));
    EXPECT_NE(ask({"step", "7"}).find("7 steps from step "), std::string::npos);
    EXPECT_NE(ask({"mark", "second\nlap"}).find("marked step "), std::string::npos);
    EXPECT_NE(ask({"pace", "0.2"}).find("paused"), std::string::npos) << "a new pace does not end a pause";
    EXPECT_NE(ask({"resume"}).find("runs at 0.2 × real time at step "), std::string::npos);
    EXPECT_THAT(ask({"pace", "max"}), HasLine("runs as fast as … at step "));
    const Ended ended = run.Wait(30s);
    ASSERT_EQ(ended.status, 0) << ended.out;
    EXPECT_EQ(DigestIn(ended.out), DigestIn(plain.out)) << name;
    EXPECT_NE(ended.out.find(", of it paused "), std::string::npos) << ended.out;
    EXPECT_NE(ended.out.find("late    mean "), std::string::npos) << ended.out;
    EXPECT_EQ(FirstDifference(SamplesOf(Path(name + ".mcap")), samples), "") << name;

    std::string kinds;
    std::int64_t before_utc = 0;
    const auto remarks = MessagesOf<msg::Remark>(Path(name + ".mcap"), idl::topics::kRemarks);
    for (const msg::Remark& remark : remarks) {
      kinds += remark.kind() + " ";
      EXPECT_GE(remark.utc_ns(), before_utc);
      before_utc = remark.utc_ns();
      if (remark.kind() == "mark") {
        EXPECT_EQ(remark.text(), "second lap");
        EXPECT_EQ(remark.time_ns(), remark.step() * 1'000'000);
        EXPECT_EQ(remark.pace(), 0.1);
      }
    }
    EXPECT_EQ(kinds, "start pause step mark pace resume pace end ");
    ExpectAWallTimeForEveryStep(Path(name + ".mcap"), 1500);
    const auto reader = record::McapReader::Open(Path(name + ".mcap"));
    ASSERT_TRUE(reader.ok());
    const auto meta = reader.value().FindMetadata("rodeira.meta");
    ASSERT_TRUE(meta.ok() && meta.value());
    EXPECT_EQ(meta.value()->entries, (record::TextMap{{"note", "a \"quoted\": text"}, {"participant", "P07"}}));
    EXPECT_EQ(reader.value().FindMetadata("rodeira.end").value()->entries.at("log_complete"), "true");
  }
}

TEST_F(Control, StopEndsARunWellAtTheStepThatItSays) {
  Started run(Run("stopped", {"--for", "1000", "--no-record", "--pace", "real"}));
  (void)Begun("stopped");
  ASSERT_EQ(Ctl({"pause"}).status, 0);
  const Ended stop = Ctl({"stop"});
  EXPECT_EQ(stop.status, 0) << stop.out;
  EXPECT_EQ(stop.out.find("stops after step "), 0u) << stop.out;
  const Ended ended = run.Wait(10s);
  EXPECT_EQ(ended.status, 0) << ended.out;
  EXPECT_NE(ended.out.find("faults  none"), std::string::npos) << ended.out;
}

TEST_F(Control, AFaultIsInTheRecordingToo) {
  const Ended ended = RunCommand(
      Run("faulty", {"--for", "1", "--record", Path("faulty.mcap"), "--set", "nodes.b.config.fail_at_step=200"}));
  EXPECT_EQ(ended.status, 1) << ended.out;
  const auto remarks = MessagesOf<msg::Remark>(Path("faulty.mcap"), idl::topics::kRemarks);
  ASSERT_EQ(remarks.size(), 2u);
  EXPECT_EQ(remarks[1].kind(), "fault");
  EXPECT_EQ(remarks[1].text().find("node 'b' failed at step 200: "), 0u) << remarks[1].text();
}

TEST_F(Control, ExternalRecordersAreTriggeredAtStartMarkersAndEnd) {
  constexpr std::uint32_t kDomain = 218;
  std::mutex mutex;
  std::vector<msg::Trigger> heard;
  auto participant = dds::Participant::Open({kDomain, "eeg", "an EEG", launch::Transport::kSharedMemory, {}});
  ASSERT_TRUE(participant.ok()) << participant.error().Text();
  auto reader =
      participant.value()->MakeReader(idl::topics::kTrigger, dds::Delivery::kHistory, [&](base::Bytes&& bytes) {
        const auto trigger = idl::Decode<msg::Trigger>(bytes);
        const std::lock_guard lock(mutex);
        if (trigger) heard.push_back(trigger.value());
      });
  ASSERT_TRUE(reader.ok());
  Started run(Run("eeg", {"--for", "1000", "--no-record", "--pace", "real", "--domain", std::to_string(kDomain)}));
  (void)Begun("eeg");
  ASSERT_EQ(Ctl({"mark", "stimulus"}).status, 0);
  ASSERT_EQ(Ctl({"stop"}).status, 0);
  ASSERT_EQ(run.Wait(10s).status, 0);
  const auto all = [&] {
    const std::lock_guard lock(mutex);
    return heard.size() >= 3;
  };
  for (int i = 0; i < 200 && !all(); ++i) std::this_thread::sleep_for(10ms);
  const std::lock_guard lock(mutex);
  ASSERT_EQ(heard.size(), 3u);
  EXPECT_EQ(heard[0].code(), 1u);
  EXPECT_EQ(heard[1].code(), 3u);
  EXPECT_EQ(heard[1].text(), "stimulus");
  EXPECT_EQ(heard[1].time_ns(), heard[1].step() * 1'000'000);
  EXPECT_EQ(heard[2].code(), 2u);
  EXPECT_EQ(heard[2].text(), "ok");
  EXPECT_EQ(heard[2].number(), 3u);
  EXPECT_EQ(heard[2].run(), "eeg");
  EXPECT_GT(heard[2].utc_ns(), heard[1].utc_ns());
}

TEST_F(Control, WithoutARunWithSeveralAndNonsenseAreSentences) {
  const auto refused = [this](std::vector<std::string> words, const std::string& text) {
    const Ended ended = Ctl(std::move(words));
    EXPECT_EQ(ended.status, 2) << ended.out;
    EXPECT_THAT(ended.out, HasLine(text));
  };
  refused({"pause"}, "rodeira: ctl: no run of yours is going on on this PC");
  refused({"pause", "--run", "nobody"}, "ctl --run: no run 'nobody' of yours is going on on this PC");
  refused({"pace", "0"}, "pace: '0' … max, real");
  refused({"puase"}, "unknown command 'puase'; did you mean 'pause'?");
  refused({"step", "none"}, "step: 'none' was found");
  refused({}, "COMMAND");
  Started one(Run("alpha", {"--for", "1000", "--no-record", "--pace", "real"}));
  Started two(Run("beta", {"--for", "1000", "--no-record", "--pace", "real", "--in-process"}));
  (void)Begun("alpha");
  (void)Begun("beta");
  refused({"pause"}, "2 runs are going on: alpha, beta; choose one by --run NAME");
  refused({"pause", "--run", "alhpa"}, "did you mean 'alpha'?");
  for (const std::string run : {"alpha", "beta"}) {  // of processes, and of one
    refused({"restart", "nobody", "--run", run, "--json"}, R"({"id":"launch.unknown_node",)");
  }
  EXPECT_EQ(Ctl({"stop", "--run", "alpha"}).status, 0);
  EXPECT_EQ(Ctl({"stop", "--run", "beta"}).status, 0);
  EXPECT_EQ(one.Wait(10s).status, 0);
  EXPECT_EQ(two.Wait(10s).status, 0);
  for (const std::string wrong : {"participant", "=x", "a.b=c", "a b=c"}) {
    const Ended ended = RunCommand(Run("meta", {"--meta", wrong, "--record", Path("never.mcap")}));
    EXPECT_EQ(ended.status, 2) << ended.out;
    EXPECT_NE(ended.out.find("--meta: '" + wrong + "' was found; KEY=VALUE was expected"), std::string::npos)
        << ended.out;
  }
  EXPECT_NE(RunCommand(Run("meta", {"--meta", "a=b", "--no-record"})).out.find("--meta: nothing is recorded"),
            std::string::npos);
}

// A run that is stopped takes no connections, and soon no more can wait: others are asked all the same.
TEST_F(Control, AStoppedRunKeepsNoOtherFromBeingAsked) {
  Started stopped(Run("stopped", {"--no-record", "--for", "1000", "--pace", "real"}));
  EXPECT_NE(Begun("stopped").find("step"), std::string::npos);
  ::kill(stopped.pid(), SIGSTOP);
  Started other(Run("other", {"--no-record", "--for", "1000", "--pace", "real"}));
  EXPECT_NE(Begun("other").find("step"), std::string::npos);
  for (int i = 0; i < 14; ++i) {
    const Ended without = Ctl({"state"});  // looks at every run
    EXPECT_EQ(without.status, 2) << without.out;
    EXPECT_EQ(Ctl({"state", "--run", "other"}).status, 0);
  }
  EXPECT_EQ(Ctl({"stop", "--run", "other"}).status, 0);
  EXPECT_EQ(other.Wait(10s).status, 0);
  ::kill(stopped.pid(), SIGKILL);
  ::kill(stopped.pid(), SIGCONT);
}

}  // namespace
}  // namespace rodeira::system_test
