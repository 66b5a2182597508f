// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/stepped_run.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "tests/common/runtime/lockstep/failing_node.hpp"
#include "tests/common/runtime/lockstep/law.hpp"

namespace rodeira::lockstep {
namespace {

using Contents = std::map<std::pair<SourceIndex, Step>, std::uint64_t>;

constexpr Step kLast = 60;

SteppedRun::Settings Collect(Contents& contents) {
  SteppedRun::Settings settings;
  settings.on_sample = [&contents](const Sample& sample) {
    contents[{sample.source(), sample.valid()}] = law::ContentOf(sample);
  };
  return settings;
}

// In pieces of 1 to 9 steps.
void DriveToTheEnd(SteppedRun& run, std::uint64_t seed, const std::function<void(Step)>& after_piece) {
  std::uint64_t draws = 0;
  for (Step step = -1; step < kLast;) {
    step = std::min<Step>(kLast, step + 1 + static_cast<Step>(base::RandomBits({seed, draws++}) % 9));
    RC_ASSERT(run.RunThrough(step).ok());
    after_piece(step);
  }
  RC_ASSERT(run.Finish().ok());
}

TEST(SteppedRun, InPiecesItPublishesWhatTheLawSays) {
  EXPECT_TRUE(rc::check("pieces equal the whole", [](std::uint64_t seed) {
    const Roster roster = law::RandomRoster(seed);
    const Contents reference = law::Reference(roster, kLast);
    InProcessSettings whole_settings;
    whole_settings.last_step = kLast;
    auto whole_nodes = law::MakeNodes(roster);
    const RunOutcome whole = RunShuffled(roster, whole_nodes.nodes, whole_settings, seed);

    Contents contents;
    auto made = law::MakeNodes(roster);
    SteppedRun run(roster, made.nodes, Collect(contents));
    RC_ASSERT(run.Start().ok());
    DriveToTheEnd(run, seed, [&](Step step) {
      for (const auto& [key, content] : reference) {  // all that activations through `step` publish, and nothing else
        const RosterNode& node = roster.node(roster.source(key.first).node);
        RC_ASSERT(contents.contains(key) == (key.second < node.delay || key.second - node.delay <= step));
        if (contents.contains(key)) RC_ASSERT(contents.at(key) == content);
      }
    });
    RC_ASSERT(run.digest() == whole.digest);
    RC_ASSERT(made.owned.back()->finished_at() == kLast);  // a sink
    RC_ASSERT(made.owned.back()->complete());
  }));
}

TEST(SteppedRun, TheSameNodesBeginAgainWithTheSameBits) {
  EXPECT_TRUE(rc::check("second runs equal the first", [](std::uint64_t seed) {
    const Roster roster = law::RandomRoster(seed);
    auto made = law::MakeNodes(roster);
    Contents first, second;
    SteppedRun run(roster, made.nodes, Collect(first));
    RC_ASSERT(run.Start().ok());
    const std::vector<Snapshot> beginning = run.Beginning();
    DriveToTheEnd(run, seed, [](Step) {});

    SteppedRun::Settings settings = Collect(second);
    settings.resume = beginning;
    SteppedRun again(roster, made.nodes, std::move(settings));
    RC_ASSERT(again.Start().ok());
    DriveToTheEnd(again, seed + 1, [](Step) {});
    RC_ASSERT(second == first);
    RC_ASSERT(again.digest() == run.digest());
  }));
}

TEST(SteppedRun, AFailureNamesNodeAndStepAndEndsTheOthers) {
  NodeSpec source, sink;
  source.name = "source", sink.name = "sink";
  source.period = 2;
  source.outputs = {"a"};
  sink.inputs = {{"a", PortKind::kEvent, {"source"}}};
  const Roster roster = Roster::Create(1'000'000, 10, {source, sink}).value();
  FailingNode failing(6, base::WrongInput("node.wrong", "six was found"));
  law::Rememberer rememberer(roster, 1);
  SteppedRun run(roster, {&failing, &rememberer}, {});
  ASSERT_TRUE(run.Start().ok());
  ASSERT_TRUE(run.RunThrough(5).ok());
  const base::Status status = run.RunThrough(9);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().exit_status(), 2);
  EXPECT_NE(status.error().Text().find("'source' failed at step 6"), std::string::npos) << status.error().Text();
  EXPECT_TRUE(run.has_ended());
  EXPECT_EQ(rememberer.finished_at(), 7);  // the source's sample of step 8 is missing
  EXPECT_FALSE(rememberer.complete());
}

}  // namespace
}  // namespace rodeira::lockstep
