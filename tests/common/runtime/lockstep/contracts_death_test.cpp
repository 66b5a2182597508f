// SPDX-License-Identifier: Apache-2.0
// Promises of callers of the lockstep: payloads of an outbox, sizes of samples, nodes of a roster, the order of calls.
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <utility>
#include <vector>

#include "common/runtime/lockstep/in_process.hpp"
#include "common/runtime/lockstep/inbox.hpp"
#include "common/runtime/lockstep/kept_samples.hpp"
#include "common/runtime/lockstep/mailbox.hpp"
#include "common/runtime/lockstep/outbox.hpp"
#include "common/runtime/lockstep/planned_losses.hpp"
#include "common/runtime/lockstep/runner.hpp"
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
  EXPECT_DEATH(outbox.Put("a", base::Bytes(SampleHeader::kEncapsulation + SampleHeader::kSize - 1)),
               "SampleHeader::HasHeader");
  EXPECT_DEATH(outbox.Put("c", law::Payload(1)), "a topic that the roster does not know");
  outbox.Put("a", law::Payload(1));
  EXPECT_DEATH(outbox.Put("a", law::Payload(1)), "failed: payloads_\\[i\\].empty\\(\\)");
  EXPECT_DEATH((void)outbox.Take(2, 0, 0), "failed: !payloads_\\[i\\].empty\\(\\)") << "topic b has no payload";
  outbox.Put("b", law::Payload(2));
  EXPECT_EQ(outbox.Take(2, 0, 0).size(), 2U);
}

TEST(ContractsDeathTest, APayloadHoldsAHeader) {
  base::Bytes bytes(SampleHeader::kEncapsulation + SampleHeader::kSize);
  EXPECT_EQ(SampleHeader::Read(bytes).step, 0);
  bytes.pop_back();
  EXPECT_DEATH((void)SampleHeader::Read(bytes), "failed: HasHeader");
  EXPECT_DEATH(SampleHeader().Write(bytes), "failed: HasHeader");
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
  EXPECT_DEATH((void)RunThreaded(roster, nodes, {}), "in_process.cpp.*nodes.size\\(\\)");
  EXPECT_DEATH((void)RunShuffled(roster, nodes, {}, 1), "shuffled.cpp.*nodes.size\\(\\)");
  EXPECT_DEATH((void)RunWithLosses(roster, nodes, {}, 1, {}), "shuffled.cpp.*nodes.size\\(\\)");
  EXPECT_DEATH((void)SteppedRun(roster, nodes, {}), "stepped_run.cpp.*failed: nodes.size\\(\\)");
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
  EXPECT_DEATH((void)run.RunThrough(8), "step >= limit_ && !ended_");
  EXPECT_DEATH((void)run.Finish(), "failed: !ended_");
}

class NoBus final : public Bus {
 public:
  base::Status Publish(const Sample&) override { return {}; }
  void SendNack(const Gap&) override {}
  void Tell(const Report&) override {}
};

TEST(ContractsDeathTest, ANodeIsNotAdvancedAfterItsEnd) {
  const Roster roster = TwoNodes();
  law::Rememberer node(roster, 0);
  NoBus bus;
  Mailbox mailbox(roster, 0);
  Grant abort;
  abort.abort = true;
  mailbox.DeliverGrant(abort);
  Runner runner(roster, 0, node, bus, mailbox, {});
  ASSERT_EQ(runner.Run(), Runner::Outcome::kAborted);
  EXPECT_DEATH((void)runner.Advance(std::chrono::milliseconds(0)), "a node is advanced after its end");
}

TEST(ContractsDeathTest, OnlyASinkBeginsWithoutASnapshot) {
  const Roster roster = TwoNodes();
  law::Rememberer node(roster, 0);
  NoBus bus;
  Mailbox mailbox(roster, 0);
  Runner::Settings settings;
  settings.sink_from = 2;
  Runner runner(roster, 0, node, bus, mailbox, settings);
  EXPECT_DEATH((void)runner.Run(), "spec_.is_sink\\(\\)");
}

TEST(ContractsDeathTest, AnInboxIsOpenedWhenItsSamplesAreThere) {
  const Roster roster = TwoNodes();
  Mailbox mailbox(roster, 1);
  Inbox inbox;
  EXPECT_DEATH(mailbox.Open(2, inbox), "sample != nullptr");
  ASSERT_TRUE(mailbox.Deliver(SampleOf(0)).ok());
  mailbox.Open(2, inbox);
  EXPECT_EQ(inbox.ports().size(), 1U);
}

}  // namespace
}  // namespace rodeira::lockstep
