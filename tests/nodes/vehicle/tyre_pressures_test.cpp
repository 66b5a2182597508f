// SPDX-License-Identifier: Apache-2.0
// Pressures that change within the time of their event.
#include "nodes/vehicle/tyre_pressures.hpp"

#include <gtest/gtest.h>

namespace rodeira::nodes {
namespace {

TEST(TyrePressures, FallEvenlyWithinTheirTimeAndStay) {
  TyrePressures pressures;
  EXPECT_FALSE(pressures.changed());
  pressures.Change({"ego", 2, 0.5}, 0.2);
  EXPECT_TRUE(pressures.changed());
  for (int i = 1; i <= 600; ++i) {
    const auto& share = pressures.Step(0.001);
    EXPECT_NEAR(share[2], i < 500 ? 1.0 - 0.8 * i / 500.0 : 0.2, 1e-9) << i;
    EXPECT_EQ(share[0], 1.0);
  }
  EXPECT_EQ(pressures.Step(0.001)[2], 0.2);
}

TEST(TyrePressures, AtOnceAndFromWhatItIsNow) {
  TyrePressures pressures;
  pressures.Change({"ego", 0, 0.0}, 0.0);
  EXPECT_EQ(pressures.Step(0.001)[0], 0.0);
  pressures.Change({"ego", 0, 1.0}, 1.0);  // a pump
  for (int i = 0; i < 500; ++i) (void)pressures.Step(0.001);
  EXPECT_NEAR(pressures.Step(0.001)[0], 0.501, 1e-9);
  pressures.Change({"ego", 0, 1.0}, 0.0);  // replaces the change before
  for (int i = 0; i < 1000; ++i) (void)pressures.Step(0.001);
  EXPECT_EQ(pressures.Step(0.001)[0], 0.0);
}

TEST(TyrePressures, RestoredTheyGoOnWithTheSameBits) {
  TyrePressures first, second;
  first.Change({"ego", 3, 0.7}, 0.1);
  for (int i = 0; i < 200; ++i) (void)first.Step(0.001);
  base::StateWriter writer;
  first.Save(writer);
  base::StateReader reader(writer.bytes());
  second.Restore(reader);
  EXPECT_TRUE(second.changed());
  for (int i = 0; i < 700; ++i) ASSERT_EQ(first.Step(0.001), second.Step(0.001)) << i;
}

}  // namespace
}  // namespace rodeira::nodes
