// SPDX-License-Identifier: Apache-2.0
// Where points lie on N222, as the world's own network says, against an oracle that reads the exported file by other
// means.
#include <gtest/gtest.h>

#include "common/world/road/world_export.hpp"
#include "tests/common/world/network/against_oracle.hpp"
#include "tests/n222.hpp"

namespace rodeira::road {
namespace {

TEST(N222Oracle, AgreesWithTheNetwork) {
  const auto world = rodeira::N222();
  const auto text = ExportOpenDrive(*world);
  ASSERT_TRUE(text.ok()) << text.error().Text();
  const network::FileOracle oracle(text.value());
  EXPECT_EQ(oracle.roads(), world->network()->roads().size());
  network::ExpectAgreement(*world->network(), oracle, false,
                           "n222");  // without heights: its cross-section is not level
}

}  // namespace
}  // namespace rodeira::road
