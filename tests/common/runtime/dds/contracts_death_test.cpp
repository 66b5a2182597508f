// SPDX-License-Identifier: Apache-2.0
// Promises of callers of the transport: a run has a name, a node publishes its own samples, ground queries have room
// for their answers.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>
#include <utility>

#include "common/runtime/dds/local_exchange.hpp"
#include "common/runtime/dds/node_bus.hpp"
#include "common/runtime/dds/participant.hpp"
#include "common/runtime/dds/remote_ground.hpp"

namespace rodeira::dds {
namespace {

class SilentWriter final : public Writer {
 public:
  base::Status Write(const base::Bytes& /*payload*/) override { return {}; }
};

// Sends and receives nothing.
class SilentParticipant final : public Participant {
 public:
  base::Result<std::unique_ptr<Writer>> MakeWriter(std::string_view /*topic*/, Delivery /*delivery*/) override {
    return std::unique_ptr<Writer>(std::make_unique<SilentWriter>());
  }
  base::Result<std::unique_ptr<Reader>> MakeReader(std::string_view /*topic*/, Delivery /*delivery*/,
                                                   OnPayload /*on_payload*/) override {
    return std::make_unique<Reader>();
  }
};

TEST(ContractsDeathTest, AParticipantIsOfARunWithAName) {
  EXPECT_DEATH((void)Participant::Open({}), "settings\\.run\\.empty\\(\\)");
}

TEST(ContractsDeathTest, GroundQueriesHaveRoomForTheirAnswers) {
  SilentParticipant participant;
  const auto ground = RemoteGround::Open(participant, 0, 0, [] { return true; });
  ASSERT_TRUE(ground.ok()) << ground.error().Text();
  const std::array<ground::GroundQuery, 2> queries{};
  std::array<ground::GroundPoint, 2> points{};
  ground.value()->Query(queries, points);  // the run is over: "outside", without a server
  EXPECT_DEATH(ground.value()->Query(queries, std::span(points).first(1)),
               "queries\\.size\\(\\) == points\\.size\\(\\)");
}

// Node 0 has topic a, node 1 topic b.
void PublishTopicOf(lockstep::NodeIndex node) {
  const auto roster = lockstep::Roster::Create(1'000'000, 20,
                                               {{"one", "t", lockstep::Role::kStepped, 2, 0, 0, {"a"}, {}},
                                                {"two", "t", lockstep::Role::kStepped, 2, 0, 0, {"b"}, {}}});
  ASSERT_TRUE(roster.ok()) << roster.error().Text();
  SilentParticipant participant;
  lockstep::Mailbox mailbox(roster.value(), 0);
  const auto bus = NodeBus::Open(participant, roster.value(), mailbox, {});
  ASSERT_TRUE(bus.ok()) << bus.error().Text();
  base::Bytes payload(lockstep::SampleHeader::kEncapsulation + lockstep::SampleHeader::kSize);
  const lockstep::SampleHeader header{2, 2'000'000, roster.value().node(node).outputs.front(), 0, 0};
  header.Write(payload);
  const auto status = bus.value()->Publish({header, std::make_shared<const base::Bytes>(std::move(payload))});
  ASSERT_TRUE(status.ok()) << status.error().Text();
}

TEST(ContractsDeathTest, ANodePublishesItsOwnSamples) {
  PublishTopicOf(0);
  EXPECT_DEATH(PublishTopicOf(1), "output != outputs_\\.end\\(\\)");
}

TEST(ContractsDeathTest, ANodeOfThisProcessJoins) {
  const auto roster = lockstep::Roster::Create(1'000'000, 20,
                                               {{"one", "t", lockstep::Role::kStepped, 2, 0, 0, {"a"}, {}},
                                                {"two", "t", lockstep::Role::kStepped, 2, 0, 0, {"b"}, {}}});
  ASSERT_TRUE(roster.ok()) << roster.error().Text();
  SilentParticipant participant;
  lockstep::Mailbox mailbox(roster.value(), 0);
  const auto bus = NodeBus::Open(participant, roster.value(), mailbox, {});
  ASSERT_TRUE(bus.ok()) << bus.error().Text();
  LocalExchange exchange(roster.value(), {0});
  exchange.Join(0, *bus.value());
  EXPECT_DEATH(exchange.Join(1, *bus.value()), "Has\\(node\\)");
}

}  // namespace
}  // namespace rodeira::dds
