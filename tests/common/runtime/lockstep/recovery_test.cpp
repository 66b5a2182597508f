// SPDX-License-Identifier: Apache-2.0
// A part of a run is killed at any moment: the other parts and the recording get the samples of a run without losses.
#include "common/runtime/lockstep/recovery.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <numeric>

#include "common/runtime/lockstep/archive.hpp"
#include "common/runtime/lockstep/wait_chain.hpp"
#include "tests/common/runtime/lockstep/law.hpp"
#include "tests/common/runtime/lockstep/recorded.hpp"
#include "tests/names.hpp"

namespace rodeira::lockstep {
namespace {

using law::Disk;
using law::RecordedRoster;
using law::RecorderDouble;

TEST(Recovery, DeathsAtAnyMomentChangeNoBitAndNoRecord) {
  int deaths = 0;
  EXPECT_TRUE(rc::check("a run with deaths equals the law, and its file is whole", [&](std::uint64_t seed) {
    const Roster roster = RecordedRoster(seed);
    const Step last = 80 + static_cast<Step>(seed % 170);
    const auto recorder = static_cast<NodeIndex>(roster.nodes().size() - 1);
    Disk undisturbed, disk;
    undisturbed.seed = disk.seed = seed;
    std::vector<std::unique_ptr<Node>> alive(roster.nodes().size());
    const auto make = [&](NodeIndex n, Disk& into) -> Node* {
      if (n == recorder) {
        alive[n] = std::make_unique<RecorderDouble>(into);
      } else {
        alive[n] = std::make_unique<law::Rememberer>(roster, n);
      }
      return alive[n].get();
    };
    const auto make_all = [&](Disk& into) {
      std::vector<Node*> nodes;
      for (NodeIndex n = 0; n < roster.nodes().size(); ++n) nodes.push_back(make(n, into));
      return nodes;
    };
    InProcessSettings settings;
    settings.last_step = last;
    settings.loss = seed % 2 == 0 ? 0.0 : 0.1;
    settings.deaths.share = 0.003;
    settings.deaths.terminated = 0.5;
    settings.deaths.policies.assign(roster.nodes().size(), Policy::kRestart);
    settings.deaths.safe = [&](NodeIndex) { return disk.safe(); };
    settings.deaths.remake = [&](NodeIndex n) {
      InProcessSettings::Deaths::Remade remade{make(n, disk), -1, {}};
      if (n == recorder) remade.has_through = disk.safe();
      if (n == recorder) remade.tail = disk.file;
      return remade;
    };
    InProcessSettings calm;
    calm.last_step = last;
    RC_ASSERT(RunShuffled(roster, make_all(undisturbed), calm, seed + 2).ok);
    const RunOutcome outcome = RunShuffled(roster, make_all(disk), settings, seed + 1);
    deaths += outcome.deaths;
    if (outcome.fault.find("times without getting") != std::string::npos) RC_DISCARD("died too often at one place");
    RC_ASSERT(outcome.fault == "");
    RC_ASSERT(outcome.ok);

    // Snapshots included, sample for sample.
    RC_ASSERT(disk.file.size() == undisturbed.file.size());
    for (std::size_t i = 0; i < disk.file.size(); ++i) RC_ASSERT(SameContent(disk.file[i], undisturbed.file[i]));
    std::map<std::pair<SourceIndex, Step>, std::uint64_t> recorded;
    for (const Sample& sample : disk.file) {
      if (roster.source(sample.source()).topic != kSnapshotTopic)
        recorded[{sample.source(), sample.valid()}] = law::ContentOf(sample);
    }
    auto reference = law::Reference(roster, last);
    std::erase_if(reference, [&](const auto& entry) { return entry.first.second > last; });
    RC_ASSERT(recorded == reference);
  }));
  EXPECT_GT(deaths, 100);
}

// Whatever the order of messages: a node that is told to end is a loss, never an end that was meant.
TEST(Recovery, ANodeThatIsToldToEndEndsARunWithoutRestarts) {
  int deaths = 0;
  EXPECT_TRUE(rc::check("the run ends with the reason or ran to its end", [&](std::uint64_t seed) {
    const Roster roster = RecordedRoster(seed);
    Disk disk;
    disk.seed = seed;
    std::vector<std::unique_ptr<Node>> alive;
    std::vector<Node*> nodes;
    for (NodeIndex n = 0; n + 1 < roster.nodes().size(); ++n)
      nodes.push_back(alive.emplace_back(std::make_unique<law::Rememberer>(roster, n)).get());
    nodes.push_back(alive.emplace_back(std::make_unique<RecorderDouble>(disk)).get());
    InProcessSettings settings;
    settings.last_step = 80 + static_cast<Step>(seed % 170);
    settings.loss = seed % 2 == 0 ? 0.0 : 0.1;
    settings.deaths.share = 0.002;
    settings.deaths.terminated = 1.0;
    const Policy policy = seed % 3 == 0 ? Policy::kPause : Policy::kStop;
    settings.deaths.policies.assign(roster.nodes().size(), policy);
    settings.deaths.safe = [&](NodeIndex) { return disk.safe(); };
    const RunOutcome outcome = RunShuffled(roster, nodes, settings, seed + 1);
    if (outcome.ok) {
      RC_ASSERT(outcome.reports.size() == roster.nodes().size());
      for (const Report& report : outcome.reports) RC_ASSERT(report.phase == Phase::kFinished);
      return;
    }
    ++deaths;
    RC_ASSERT(outcome.fault.ends_with("' was told to end"));
  }));
  EXPECT_GT(deaths, 20);
}

TEST(Recovery, RepeatedCrashAtOnePlaceEndsTheRun) {
  const Roster roster = RecordedRoster(3);
  Recovery recovery(roster, std::vector<Policy>(roster.nodes().size(), Policy::kRestart));
  for (int i = 0; i < 3; ++i) EXPECT_EQ(recovery.Lost(0, 40).policy, Policy::kRestart);
  const auto fourth = recovery.Lost(0, 40);
  EXPECT_EQ(fourth.policy, Policy::kStop);
  EXPECT_EQ(fourth.why, "it was lost 4 times without getting beyond step 40");
  EXPECT_EQ(recovery.Lost(1, 40).policy, Policy::kRestart);
  Recovery onwards(roster, std::vector<Policy>(roster.nodes().size(), Policy::kRestart));
  for (Step progress = 0; progress < 100; progress += 10) EXPECT_EQ(onwards.Lost(0, progress).policy, Policy::kRestart);
}

class RecoveryOfOne : public ::testing::Test {
 protected:
  // A car each step, a recorder each 5, snapshots each 10; delays 1 and 5.
  static Roster Make(bool with_recorder) {
    std::vector<NodeSpec> specs{{"car", "t", Role::kStepped, 1, 1, 0, {"a"}, {}, with_recorder ? 10 : 0}};
    if (with_recorder) {
      specs.push_back({"recorder",
                       "t",
                       Role::kStepped,
                       5,
                       5,
                       0,
                       {},
                       {{"a", PortKind::kEvent, {"car"}}, {std::string(kSnapshotTopic), PortKind::kEvent, {"car"}}},
                       0});
    } else {
      specs.push_back({"view", "t", Role::kStepped, 5, 5, 0, {}, {{"a", PortKind::kEvent, {"car"}}}, 0});
    }
    return Roster::Create(1'000'000, 20, specs).value();
  }
  static Report Running(NodeIndex node, Step progress, Step safe = -1) {
    Report report;
    report.node = node;
    report.phase = Phase::kRunning;
    report.progress = progress;
    report.safe = safe;
    return report;
  }
};

TEST_F(RecoveryOfOne, GoesOnFromASnapshotThatLiesInTheFile) {
  const Roster roster = Make(true);
  Recovery recovery(roster, {Policy::kRestart, Policy::kRestart});
  EXPECT_EQ(recovery.safe(), -1);
  EXPECT_EQ(recovery.resume(), 0);
  recovery.Heard(Running(1, 60, 44));
  EXPECT_EQ(recovery.safe(), 44);
  EXPECT_EQ(recovery.resume(), 30) << "what is published ahead (5 steps) must be there too";
  recovery.Heard(Running(1, 60, 45));
  EXPECT_EQ(recovery.resume(), 40);
  // A lost node holds the beginning back until it is where it was.
  EXPECT_EQ(recovery.Lost(0, 66).policy, Policy::kRestart);
  recovery.Heard(Running(1, 90, 88));
  EXPECT_EQ(recovery.resume(), 40);
  recovery.Heard(Running(0, 65));
  EXPECT_EQ(recovery.resume(), 40);
  recovery.Heard(Running(0, 66));
  EXPECT_EQ(recovery.resume(), 80);
  recovery.Heard(Running(1, 0, -1));
  EXPECT_EQ(recovery.safe(), 88) << "what a recorder's other incarnation has not yet said is not forgotten";
}

TEST_F(RecoveryOfOne, NothingIsKeptWhereNoNodeCanComeBack) {
  EXPECT_EQ(Recovery(Make(false), {Policy::kPause, Policy::kPause}).safe(), kNever);
  EXPECT_EQ(Recovery(Make(true), {Policy::kStop, Policy::kStop}).safe(), kNever);
  EXPECT_EQ(Recovery(Make(true), {Policy::kPause, Policy::kStop}).safe(), -1) << "a person may start it again";
}

TEST_F(RecoveryOfOne, ANodeThatCannotSaveItsStateIsNotRestarted) {
  const Roster roster = Make(true);
  Report car = Running(0, 0);
  EXPECT_TRUE(Recovery(roster, {Policy::kRestart, Policy::kRestart}).CheckState(car).ok());
  car.cannot_save = true;
  const auto status = Recovery(roster, {Policy::kRestart, Policy::kRestart}).CheckState(car);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().Text(),
            "node 'car' cannot save its state, so it cannot be started again; 'stop' or 'pause' was expected as "
            "nodes.car.recovery");
  EXPECT_EQ(status.error().exit_status(), 2);
  EXPECT_TRUE(Recovery(roster, {Policy::kPause, Policy::kRestart}).CheckState(car).ok());
  EXPECT_TRUE(Recovery(roster, {Policy::kStop, Policy::kRestart}).CheckState(car).ok());
}

TEST_F(RecoveryOfOne, EachKindBeginsWhereItCan) {
  const Roster roster = Make(true);
  Grant grant;
  EXPECT_EQ(BeginningOf(roster, 0, grant, -1).snapshot, 0) << "the run has not begun";
  grant.through = 97;
  grant.resume = 40;
  EXPECT_EQ(BeginningOf(roster, 0, grant, -1).snapshot, 40);
  EXPECT_EQ(BeginningOf(roster, 1, grant, 61).sink_from, 65);
  EXPECT_EQ(BeginningOf(roster, 1, grant, 64).sink_from, 65);
  EXPECT_EQ(BeginningOf(Make(false), 1, grant, -1).sink_from, 80) << "its first activation from 97 - 20 on";
}

TEST_F(RecoveryOfOne, AClockThatIsStartedAgainGrantsNothingNewBeforeItHasHeardAll) {
  const Roster roster = Make(true);
  Clock clock(roster, 1000, 0, {Policy::kRestart, Policy::kRestart});
  clock.Rebuild();
  Report car = Running(0, 52);
  car.granted = 60;
  car.incarnation = 2;
  ASSERT_TRUE(clock.Take(car).ok());
  EXPECT_EQ(clock.incarnation(0), 2u);
  EXPECT_EQ(clock.Update(1000).through, 60) << "what was granted stays granted";
  Report recorder = Running(1, 45);
  recorder.granted = 55;
  ASSERT_TRUE(clock.Take(recorder).ok());
  EXPECT_EQ(clock.Update(1000).through, 65) << "45 and the window of 20";
  EXPECT_FALSE(clock.Take(Running(0, 99)).ok()) << "from now on nobody runs ahead of the grant";
}

TEST_F(RecoveryOfOne, AClockThatIsStartedAgainKnowsTheEnd) {
  const Roster roster = Make(true);
  Clock clock(roster, 1000, 0, {Policy::kRestart, Policy::kRestart});
  clock.Rebuild();
  Report car = Running(0, 52);
  car.granted = 60;
  car.granted_final = true;
  ASSERT_TRUE(clock.Take(car).ok());
  ASSERT_TRUE(clock.Take(Running(1, 45)).ok());
  EXPECT_TRUE(clock.Update(1000).final);
  EXPECT_EQ(clock.Update(1000).through, 60);
}

TEST_F(RecoveryOfOne, AClockThatIsStartedAgainSaysWhereNodesGoOnOnceItHasHeardAll) {
  const Roster roster = Make(true);
  Clock clock(roster, 1000, 0, {Policy::kRestart, Policy::kRestart});
  EXPECT_EQ(clock.grant().resume, 0);
  clock.Rebuild();
  EXPECT_EQ(clock.grant().resume, kUnknown);
  clock.NoteIncarnation(0, 3);  // lost while there was no clock: another one takes its place
  EXPECT_EQ(clock.HandleLoss(0).policy, Policy::kRestart);
  EXPECT_EQ(clock.incarnation(0), 4u);
  Report recorder = Running(1, 75, kUnknown);
  recorder.granted = 80;
  ASSERT_TRUE(clock.Take(recorder).ok());
  Report car;
  car.incarnation = 4;
  ASSERT_TRUE(clock.Take(car).ok());
  EXPECT_EQ(clock.grant().resume, kUnknown) << "what the file holds is not known yet";
  recorder.safe = 66;
  ASSERT_TRUE(clock.Take(recorder).ok());
  EXPECT_EQ(clock.grant().resume, 60);
  // What the car needs is kept until it is where it can have been.
  recorder.safe = 79;
  ASSERT_TRUE(clock.Take(recorder).ok());
  EXPECT_EQ(clock.grant().resume, 60);
  car = Running(0, 79);
  car.incarnation = 4;
  ASSERT_TRUE(clock.Take(car).ok());
  EXPECT_EQ(clock.grant().resume, 60);
  car.progress = 80;
  ASSERT_TRUE(clock.Take(car).ok());
  recorder.progress = 80;
  ASSERT_TRUE(clock.Take(recorder).ok());
  EXPECT_EQ(clock.grant().resume, 70);
}

// A stopped node may receive the lost clock's last grant only when it goes on.
TEST_F(RecoveryOfOne, AClockThatIsStartedAgainLearnsAlsoLaterWhatWasGranted) {
  const Roster roster = Make(true);
  Clock clock(roster, 1000, 0, {Policy::kRestart, Policy::kRestart});
  clock.Rebuild();
  Report car = Running(0, 52);
  car.granted = 55;
  ASSERT_TRUE(clock.Take(car).ok());
  ASSERT_TRUE(clock.Take(Running(1, 35)).ok());
  EXPECT_EQ(clock.Update(0).through, 55);
  car.progress = 58;
  car.granted = 60;
  ASSERT_TRUE(clock.Take(car).ok());
  EXPECT_EQ(clock.Update(0).through, 60);
}

// A view and a source that are lost together: the view's first activation needs samples that the source computes again.
TEST_F(RecoveryOfOne, NodesGoOnNoLaterThanSinksThatKeepNothing) {
  std::vector<NodeSpec> specs{
      {"car", "t", Role::kStepped, 1, 5, 0, {"a"}, {}, 10},
      {"view", "t", Role::kStepped, 5, 5, 0, {}, {{"a", PortKind::kEvent, {"car"}}}, 0},
      {"recorder",
       "t",
       Role::kStepped,
       5,
       5,
       0,
       {},
       {{"a", PortKind::kEvent, {"car"}}, {std::string(kSnapshotTopic), PortKind::kEvent, {"car"}}},
       0}};
  const Roster roster = Roster::Create(1'000'000, 20, specs).value();
  Recovery recovery(roster, {Policy::kRestart, Policy::kRestart, Policy::kRestart});
  recovery.Heard(Running(2, 70, 66));
  EXPECT_EQ(recovery.resume(), 60);
  EXPECT_EQ(recovery.ResumeAt(100), 60);
  EXPECT_EQ(recovery.ResumeAt(72), 50) << "the view begins at 55";
  Grant grant;
  grant.through = 72;
  EXPECT_EQ(BeginningOf(roster, 1, grant, -1).sink_from, 55);
}

TEST_F(RecoveryOfOne, TheArchiveHasNoHolesAndRefusesAContradiction) {
  const Roster roster = Make(true);
  const auto sample = [&](Step valid, std::uint64_t content) {
    base::Bytes payload = law::Payload(content);
    const SampleHeader header{valid, valid * 1'000'000, 0, 0, 0};
    header.Write(payload);
    return Sample{header, std::make_shared<const base::Bytes>(std::move(payload))};
  };
  Archive archive(roster);
  for (const Step valid : {0, 1, 2, 4, 5}) ASSERT_TRUE(archive.Add(sample(valid, 7)).ok());
  EXPECT_EQ(archive.From({0, 0}).size(), 3u) << "3 is missing";
  EXPECT_TRUE(archive.From({0, 3}).empty());
  ASSERT_TRUE(archive.Add(sample(4, 7)).ok()) << "said again";
  const auto status = archive.Add(sample(4, 8));
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.error(), IsError("run.two_samples", "car.a: … step 4"));
  archive.Forget(10);  // the recorder's activation at 10 sees the events in (5, 10]
  EXPECT_EQ(archive.size(), 0u);
  ASSERT_TRUE(archive.Add(sample(5, 1)).ok());
  EXPECT_EQ(archive.size(), 0u) << "nobody can ask for it";
  ASSERT_TRUE(archive.Add(sample(6, 1)).ok());
  EXPECT_EQ(archive.size(), 1u);
}

TEST_F(RecoveryOfOne, TheChainOfWaitingEndsAtItsCause) {
  const Roster roster =
      Roster::Create(1'000'000, 20,
                     {{"driver", "t", Role::kStepped, 1, 1, 0, {"c"}, {{"a", PortKind::kState, {"car"}}}},
                      {"car", "t", Role::kStepped, 1, 1, 0, {"a"}, {{"c", PortKind::kState, {"driver"}}}},
                      {"view", "t", Role::kStepped, 5, 5, 0, {}, {{"a", PortKind::kEvent, {"car"}}}}})
          .value();
  std::vector<Report> reports{Running(0, 12), Running(1, 12), Running(2, 10)};
  for (Report& report : reports) report.waiting = Waiting::kGrant;
  EXPECT_EQ(WaitChain(roster, reports), "") << "everybody waits for time";
  reports[2].waiting = Waiting::kInputs;
  reports[2].waiting_source = 1;
  EXPECT_EQ(WaitChain(roster, reports), "") << "the view too";
  reports[1].waiting = Waiting::kInputs;
  reports[1].waiting_source = 0;
  reports[0].waiting = Waiting::kNothing;
  reports[0].since_ms = 3200;
  EXPECT_EQ(WaitChain(roster, reports),
            "'view' waits for 'car', 'car' waits for 'driver', 'driver' computes step 12 since 3.2 s");
  reports[0].message = "waits for pictures to be written since 3.1 s";
  EXPECT_EQ(WaitChain(roster, reports),
            "'view' waits for 'car', 'car' waits for 'driver', 'driver' computes step 12 since 3.2 s and waits for "
            "pictures to be written since 3.1 s");
  reports[0].message.clear();
  reports[0].waiting = Waiting::kServer;
  EXPECT_EQ(
      WaitChain(roster, reports),
      "'view' waits for 'car', 'car' waits for 'driver', 'driver' waits at step 12 for a server's answer since 3.2 s");
  reports[0].waiting = Waiting::kOutput;
  EXPECT_EQ(WaitChain(roster, reports),
            "'view' waits for 'car', 'car' waits for 'driver', 'driver' still writes the output of the steps before "
            "12, since 3.2 s");
  reports[0].phase = Phase::kStarting;
  reports[0].waiting = Waiting::kNothing;
  EXPECT_EQ(WaitChain(roster, reports), "'view' waits for 'car', 'car' waits for 'driver', 'driver' is starting");
}

}  // namespace
}  // namespace rodeira::lockstep
