// SPDX-License-Identifier: Apache-2.0
// Promises of callers: a road has lane sections, a place is asked of a lane of the network.
#include <gtest/gtest.h>

#include <memory>

#include "common/world/network/network.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::network {
namespace {

TEST(ContractsDeathTest, ARoadHasLaneSections) {
  const auto network = opendrive::MustRead(opendrive::Document(opendrive::RoadText().Text()));
  const Road& road = network->roads()[0];
  EXPECT_EQ(Road(road.spec(), road.axis()).SectionIndex(0.0), 0U);
  RoadSpec bare = road.spec();
  bare.sections.clear();
  EXPECT_DEATH(Road(bare, road.axis()), "!spec_.sections.empty\\(\\)");
}

TEST(ContractsDeathTest, AMiddleIsThatOfALaneOfTheNetwork) {
  const auto network = opendrive::MustRead(opendrive::Document(opendrive::RoadText().Text()));
  EXPECT_NEAR(network->Centre({0, 0, -1}, 30.0).x(), 30.0, 1e-9);
  for (const int lane : {0, 17}) EXPECT_DEATH((void)network->Centre({0, 0, lane}, 30.0), "span.has_value\\(\\)");
}

}  // namespace
}  // namespace rodeira::network
