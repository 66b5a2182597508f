// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/roster.hpp"

#include <gtest/gtest.h>

namespace rodeira::lockstep {
namespace {

std::string Refusal(const std::vector<NodeSpec>& specs) {
  const auto roster = Roster::Create(1'000'000, 20, specs);
  return roster.ok() ? "" : roster.error().Text();
}

const NodeSpec kCar{"car", "vehicle", Role::kStepped, 1, 0, 0, {"state"}, {}};

TEST(Roster, NumbersSourcesInTheOrderOfTheLaunchFile) {
  const auto roster =
      Roster::Create(1'000'000, 20,
                     {kCar, {"view", "view", Role::kStepped, 16, 32, 0, {}, {{"state", PortKind::kState, {"car"}}}}})
          .value();
  EXPECT_EQ(roster.Find("view"), 1u);
  EXPECT_EQ(roster.Find("nobody"), 2u);
  EXPECT_EQ(roster.SourceName(0), "car.state");
  EXPECT_EQ(roster.node(0).delay, 1);
  EXPECT_EQ(roster.node(1).delay, 32);
  EXPECT_TRUE(roster.node(1).is_sink());
}

TEST(Roster, RefusesWhatCannotBeWired) {
  EXPECT_EQ(Refusal({kCar, kCar}), "two nodes are named 'car'");
  EXPECT_EQ(Refusal({kCar, {"view", "view", Role::kStepped, 1, 0, 0, {}, {{"state", PortKind::kState, {"cra"}}}}}),
            "node 'view', input 'state': there is no node 'cra'; did you mean 'car'?");
  EXPECT_EQ(Refusal({kCar, {"view", "view", Role::kStepped, 1, 0, 0, {}, {{"pose", PortKind::kState, {"car"}}}}}),
            "node 'view', input 'pose': node 'car' does not publish this topic");
  EXPECT_EQ(Refusal({{"x", "x", Role::kStepped, 0, 0, 0, {}, {}}}),
            "node 'x': period 0 was found, at least 1 step was expected");
  EXPECT_EQ(Refusal({{"x", "x", Role::kStepped, 4, 6, 0, {}, {}}}),
            "node 'x': delay 6 was found, a multiple of the period 4 was expected");
  EXPECT_EQ(Refusal({{"x", "x", Role::kStepped, 4, 2, 0, {}, {}}}),
            "node 'x': delay 2 was found, a multiple of the period 4 was expected");
  EXPECT_EQ(Refusal({{"x", "x", Role::kService, 1, 0, 0, {"y"}, {}}}),
            "node 'x': a service has neither inputs nor outputs in the lockstep");
  EXPECT_NE(Refusal({kCar, {"v", "v", Role::kStepped, 1, 0, 0, {}, {{"state", PortKind::kState, {"car", "car"}}}}})
                .find("wired twice"),
            std::string::npos);
}

TEST(Roster, TheHashSeesEveryWire) {
  const auto hash = [](Step period, PortKind kind, std::int64_t step_ns) {
    return Roster::Create(step_ns, 20,
                          {{"car", "vehicle", Role::kStepped, period, 0, 0, {"state"}, {}},
                           {"view", "view", Role::kStepped, 1, 0, 0, {}, {{"state", kind, {"car"}}}}})
        .value()
        .hash();
  };
  EXPECT_EQ(hash(1, PortKind::kState, 1000), hash(1, PortKind::kState, 1000));
  EXPECT_NE(hash(1, PortKind::kState, 1000), hash(2, PortKind::kState, 1000));
  EXPECT_NE(hash(1, PortKind::kState, 1000), hash(1, PortKind::kEvent, 1000));
  EXPECT_NE(hash(1, PortKind::kState, 1000), hash(1, PortKind::kState, 2000));
}

TEST(Roster, FloorAndCeil) {
  EXPECT_EQ(FloorTo(7, 3), 6);
  EXPECT_EQ(FloorTo(-1, 3), -3);
  EXPECT_EQ(CeilTo(7, 3), 9);
  EXPECT_EQ(CeilTo(9, 3), 9);
  EXPECT_EQ(CeilTo(-2, 3), 0);
}

}  // namespace
}  // namespace rodeira::lockstep
