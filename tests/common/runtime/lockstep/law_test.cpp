// SPDX-License-Identifier: Apache-2.0
// Law L1 as it is lived: whatever the order of arrival, the threads and the rates, every sample is the one of the law.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "tests/common/runtime/lockstep/failing_node.hpp"
#include "tests/common/runtime/lockstep/law.hpp"

namespace rodeira::lockstep {
namespace {

using Contents = std::map<std::pair<SourceIndex, Step>, std::uint64_t>;

InProcessSettings Tracing(Contents& contents, Step last) {
  InProcessSettings settings;
  settings.last_step = last;
  settings.on_sample = [&contents](const Sample& sample) {
    const auto [at, fresh] = contents.insert({{sample.source(), sample.valid()}, law::ContentOf(sample)});
    EXPECT_TRUE(fresh || at->second == law::ContentOf(sample)) << "said again with another content";
  };
  return settings;
}

// Everything that the reference has up to the last step; what lies behind it belongs to no run.
void ExpectLawful(const Roster& roster, const Contents& contents, Step last) {
  const Contents reference = law::Reference(roster, last);
  for (const auto& [key, content] : reference) {
    const auto found = contents.find(key);
    ASSERT_NE(found, contents.end()) << roster.SourceName(key.first) << " at " << key.second << " is missing";
    ASSERT_EQ(found->second, content) << roster.SourceName(key.first) << " at " << key.second;
  }
  EXPECT_EQ(contents.size(), reference.size());
}

TEST(Law, HoldsInAnyOrderOfArrival) {
  EXPECT_TRUE(rc::check("shuffled runs equal the reference", [](std::uint64_t seed) {
    const Roster roster = law::RandomRoster(seed);
    const Step last = 60 + static_cast<Step>(seed % 17);
    auto made = law::MakeNodes(roster);
    Contents contents;
    const RunOutcome outcome = RunShuffled(roster, made.nodes, Tracing(contents, last), seed + 1);
    RC_ASSERT(outcome.fault == "");
    RC_ASSERT(outcome.ok);
    RC_ASSERT(outcome.last_step == last);
    RC_ASSERT(contents == law::Reference(roster, last));
  }));
}

TEST(Law, HoldsWithOneThreadANode) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Roster roster = law::RandomRoster(seed);
    auto made = law::MakeNodes(roster);
    Contents contents;
    const RunOutcome outcome = RunThreaded(roster, made.nodes, Tracing(contents, 300));
    ASSERT_TRUE(outcome.ok) << outcome.fault;
    ExpectLawful(roster, contents, 300);
  }
}

TEST(Law, HoldsWhereMessagesAreLost) {
  EXPECT_TRUE(rc::check("runs with losses equal the reference", [](std::uint64_t seed) {
    const Roster roster = law::RandomRoster(seed);
    const Step last = 40 + static_cast<Step>(seed % 13);
    auto made = law::MakeNodes(roster);
    Contents contents;
    auto settings = Tracing(contents, last);
    settings.loss = 0.05 + 0.1 * static_cast<double>(seed % 5);
    const RunOutcome outcome = RunShuffled(roster, made.nodes, settings, seed + 1);
    RC_ASSERT(outcome.fault == "");
    RC_ASSERT(outcome.ok);
    RC_ASSERT(contents == law::Reference(roster, last));
  }));
}

TEST(Law, WhereNothingArrivesTheRunEndsWithTheNamesOfWaitingNodes) {
  const Roster roster = law::RandomRoster(1);
  auto made = law::MakeNodes(roster);
  InProcessSettings settings;
  settings.last_step = 100;
  settings.loss = 1.0;
  const RunOutcome outcome = RunShuffled(roster, made.nodes, settings, 1);
  EXPECT_FALSE(outcome.ok);
  EXPECT_THAT(outcome.fault, ::testing::StartsWith("deadlock: "));
}

TEST(Law, TheDigestTellsRunsApart) {
  const Roster roster = law::RandomRoster(3);
  const auto digest = [&](Step last, std::uint64_t shuffle) {
    auto made = law::MakeNodes(roster);
    Contents contents;
    return RunShuffled(roster, made.nodes, Tracing(contents, last), shuffle).digest;
  };
  EXPECT_EQ(digest(100, 1), digest(100, 2));
  EXPECT_NE(digest(100, 1), digest(140, 1));
}

TEST(Law, ASlowConsumerOfEventsLosesNoneAndASinkClosesWithTheRest) {
  const auto roster =
      Roster::Create(1'000'000, 50,
                     {{"fast", "test", Role::kStepped, 3, 0, 0, {"press"}, {}},
                      {"slow", "test", Role::kStepped, 10, 0, 0, {"a"}, {{"press", PortKind::kEvent, {"fast"}}}},
                      {"sink",
                       "test",
                       Role::kStepped,
                       7,
                       0,
                       0,
                       {},
                       {{"press", PortKind::kEvent, {"fast"}}, {"a", PortKind::kEvent, {"slow"}}}}})
          .value();
  auto made = law::MakeNodes(roster);
  InProcessSettings settings;
  settings.last_step = 100;
  ASSERT_TRUE(RunShuffled(roster, made.nodes, settings, 5).ok);
  std::vector<std::pair<SourceIndex, Step>> presses;
  for (Step v = 0; v <= 100; v += 3) presses.push_back({0, v});
  EXPECT_EQ(made.owned[1]->seen(), presses);  // its last activation is at 100
  auto sunk = made.owned[2]->seen();
  std::vector<std::pair<SourceIndex, Step>> all = presses;
  for (Step v = 0; v <= 100; v += 10) all.push_back({1, v});
  std::sort(sunk.begin(), sunk.end());
  std::sort(all.begin(), all.end());
  EXPECT_EQ(sunk, all);
  EXPECT_EQ(made.owned[2]->finished_at(), 100);
  EXPECT_TRUE(made.owned[2]->complete());
}

TEST(Law, MutuallyPrimePeriodsAndLongDelays) {
  std::vector<NodeSpec> specs;
  const std::vector<std::pair<Step, Step>> rates{{2, 6}, {3, 3}, {5, 20}, {7, 14}, {11, 11}};
  for (std::size_t n = 0; n < rates.size(); ++n) {
    specs.push_back({"n" + std::to_string(n), "test", Role::kStepped, rates[n].first, rates[n].second, 0, {"a"}, {}});
  }
  for (std::size_t n = 0; n < rates.size(); ++n) {
    PortSpec port{"a", n % 2 == 0 ? PortKind::kState : PortKind::kEvent, {}};
    for (std::size_t m = 0; m < rates.size(); ++m) port.sources.push_back(specs[m].name);
    specs[n].inputs.push_back(port);
  }
  const Roster roster = Roster::Create(1'000'000, 1, specs).value();  // the narrowest window there is
  auto made = law::MakeNodes(roster);
  Contents contents;
  ASSERT_TRUE(RunShuffled(roster, made.nodes, Tracing(contents, 2310), 9).ok);
  ExpectLawful(roster, contents, 2310);
}

TEST(Law, AFailingNodeStopsTheRunAndIsNamed) {
  const auto roster =
      Roster::Create(1'000'000, 20,
                     {{"car", "test", Role::kStepped, 1, 0, 0, {"a"}, {}},
                      {"sink", "test", Role::kStepped, 4, 0, 0, {}, {{"a", PortKind::kEvent, {"car"}}}}})
          .value();
  FailingNode car(40, base::Failed("vehicle.not_finite", "the spring broke"));
  law::Rememberer sink(roster, 1);
  InProcessSettings settings;
  settings.last_step = 1000;
  const RunOutcome outcome = RunThreaded(roster, {&car, &sink}, settings);
  EXPECT_FALSE(outcome.ok);
  EXPECT_EQ(outcome.fault, "node 'car' failed at step 40: the spring broke");
  EXPECT_FALSE(sink.complete());
  EXPECT_EQ(sink.finished_at(), 40);  // activation 39 gave the sample valid at 40
  EXPECT_EQ(sink.seen().size(), 41u);
}

// A sink (a recorder on a busy machine) that is still busy with a step when the run is cancelled.
class BusySink final : public Node {
 public:
  explicit BusySink(law::Rememberer& sink) : sink_(sink) {}
  base::Status Initialise(Outbox& outbox) override { return sink_.Initialise(outbox); }
  base::Status Step(const StepInfo& step, const Inbox& inbox, Outbox& outbox) override {
    auto status = sink_.Step(step, inbox, outbox);
    if (step.step == 24)
      std::this_thread::sleep_for(
          std::chrono::milliseconds(100));  // meanwhile the car goes on within the window, and fails
    return status;
  }
  base::Status Finish(const Inbox& rest, lockstep::Step last, bool complete) override {
    return sink_.Finish(rest, last, complete);
  }
  void Save(base::StateWriter&) const override {}
  void Restore(base::StateReader&) override {}

 private:
  law::Rememberer& sink_;
};

TEST(Law, WhatASinkTookInWhileTheRunWasBrokenOffItTakesOnce) {
  const auto roster =
      Roster::Create(1'000'000, 20,
                     {{"car", "test", Role::kStepped, 1, 0, 0, {"a"}, {}},
                      {"sink", "test", Role::kStepped, 4, 0, 0, {}, {{"a", PortKind::kEvent, {"car"}}}}})
          .value();
  FailingNode car(40, base::Failed("vehicle.not_finite", "the spring broke"));
  law::Rememberer remembers(roster, 1);
  BusySink sink(remembers);
  InProcessSettings settings;
  settings.last_step = 1000;
  EXPECT_FALSE(RunThreaded(roster, {&car, &sink}, settings).ok);
  ASSERT_EQ(remembers.seen().size(), 41u);
  for (std::size_t i = 0; i < remembers.seen().size(); ++i)
    EXPECT_EQ(remembers.seen()[i].second, static_cast<lockstep::Step>(i));
}

TEST(Law, StopEndsTheRunAtAGrantedStepForAllNodes) {
  const Roster roster = law::RandomRoster(8);
  auto made = law::MakeNodes(roster);
  InProcessSettings settings;
  Contents contents;
  settings = Tracing(contents, 0);
  settings.last_step.reset();
  std::atomic<int> published = 0;
  settings.on_sample = [&published, trace = settings.on_sample](const Sample& sample) {
    ++published;
    trace(sample);
  };
  settings.stop_requested = [&published] { return published > 500; };
  const RunOutcome outcome = RunThreaded(roster, made.nodes, settings);
  ASSERT_TRUE(outcome.ok) << outcome.fault;
  ASSERT_GT(outcome.last_step, 0);
  ASSERT_EQ(outcome.reports.size(), roster.nodes().size());
  for (const Report& report : outcome.reports) {
    EXPECT_GT(report.progress, outcome.last_step);
    EXPECT_LE(report.progress, outcome.last_step + roster.node(report.node).period);
  }
  ExpectLawful(roster, contents, outcome.last_step);
}

}  // namespace
}  // namespace rodeira::lockstep
