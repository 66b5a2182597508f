// SPDX-License-Identifier: Apache-2.0
// Promises of callers of the lockstep: payloads of an outbox, sizes of samples, nodes of a roster, the order of calls.
#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

#include "common/runtime/lockstep/in_process.hpp"
#include "common/runtime/lockstep/inbox.hpp"
#include "common/runtime/lockstep/kept_samples.hpp"
#include "common/runtime/lockstep/outbox.hpp"
#include "common/runtime/lockstep/snapshot.hpp"
#include "common/runtime/lockstep/stepped_run.hpp"
#include "tests/common/runtime/lockstep/law.hpp"

namespace rodeira::lockstep {
namespace {

// A source of two topics and a sink, without snapshots.
Roster TwoNodes() {
  return Roster::Create(1'000'000, 20,
                        {{"maker", "t", Role::kStepped, 2, 0, 0, {"a", "b"}, {}},
                         {"taker", "t", Role::kStepped, 2, 0, 0, {}, {{"a", PortKind::kState, {"maker"}}}}})
      .value();
}

Sample SampleOf(SourceIndex source) {
  base::Bytes payload = law::Payload(1);
  const SampleHeader header{2, 2'000'000, source, 0, 0};
  header.Write(payload);
  return {header, std::make_shared<const base::Bytes>(std::move(payload))};
}

TEST(ContractsDeathTest, AnOutboxGetsOnePayloadForEachTopicOfItsNode) {
  const Roster roster = TwoNodes();
  Outbox outbox(roster, 0);
  EXPECT_DEATH(outbox.Put("a", base::Bytes(SampleHeader::kEncapsulation + SampleHeader::kSize - 1)), "HasHeader");
  EXPECT_DEATH(outbox.Put("c", law::Payload(1)), "a topic that the roster does not know");
  outbox.Put("a", law::Payload(1));
  EXPECT_DEATH(outbox.Put("a", law::Payload(1)), "empty\\(\\)");
  EXPECT_DEATH((void)outbox.Take(2, 0, 0), "empty\\(\\)") << "topic b has no payload";
  outbox.Put("b", law::Payload(2));
  EXPECT_EQ(outbox.Take(2, 0, 0).size(), 2U);
}

TEST(ContractsDeathTest, APayloadHoldsAHeader) {
  base::Bytes bytes(SampleHeader::kEncapsulation + SampleHeader::kSize);
  EXPECT_EQ(SampleHeader::Read(bytes).step, 0);
  bytes.pop_back();
  EXPECT_DEATH((void)SampleHeader::Read(bytes), "HasHeader");
  EXPECT_DEATH(SampleHeader().Write(bytes), "HasHeader");
}

TEST(ContractsDeathTest, TheLatestOfAPortIsOfOneSource) {
  const Inbox inbox({{"none", {}}, {"one", {SampleOf(0)}}, {"two", {SampleOf(0), SampleOf(1)}}});
  EXPECT_EQ(inbox.Latest("one").valid(), 2);
  for (const char* topic : {"none", "two", "another"}) EXPECT_DEATH((void)inbox.Latest(topic), "size\\(\\) == 1");
}

TEST(ContractsDeathTest, ANodeKeepsItsOwnSamples) {
  const Roster roster = TwoNodes();
  KeptSamples kept(roster, 1);
  EXPECT_DEATH(kept.Add(SampleOf(0)), "outputs_.end\\(\\)");
}

TEST(ContractsDeathTest, ASnapshotIsOfANodeThatMakesThem) {
  const Roster roster = TwoNodes();
  EXPECT_DEATH((void)Snapshot().ToSample(roster, 0), "snapshots");
}

TEST(ContractsDeathTest, ARunHasOneNodeForEachOfTheRoster) {
  const Roster roster = TwoNodes();
  auto made = law::MakeNodes(roster);
  auto nodes = made.nodes;
  nodes.pop_back();
  EXPECT_DEATH((void)RunThreaded(roster, nodes, {}), "nodes.size\\(\\)");
  EXPECT_DEATH((void)RunShuffled(roster, nodes, {}, 1), "nodes.size\\(\\)");
  EXPECT_DEATH((void)SteppedRun(roster, nodes, {}), "nodes.size\\(\\)");
  SteppedRun::Settings settings;
  settings.resume.resize(1);
  EXPECT_DEATH((void)SteppedRun(roster, made.nodes, settings), "resume.size\\(\\)");
}

TEST(ContractsDeathTest, ASteppedRunGoesForwardsUntilItsEnd) {
  const Roster roster = TwoNodes();
  auto made = law::MakeNodes(roster);
  SteppedRun run(roster, made.nodes, {});
  EXPECT_DEATH((void)run.Beginning(), "all_ready\\(\\)");
  ASSERT_TRUE(run.Start().ok());
  ASSERT_TRUE(run.RunThrough(6).ok());
  EXPECT_DEATH((void)run.Beginning(), "limit_ < 0");
  EXPECT_DEATH((void)run.RunThrough(5), "step >= limit_");
  ASSERT_TRUE(run.Finish().ok());
  EXPECT_DEATH((void)run.RunThrough(8), "ended_");
  EXPECT_DEATH((void)run.Finish(), "ended_");
}

}  // namespace
}  // namespace rodeira::lockstep
