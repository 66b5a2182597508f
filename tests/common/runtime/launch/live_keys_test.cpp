// SPDX-License-Identifier: Apache-2.0
// The border between a window's keys and the node that drives by them.
#include "common/runtime/launch/live_keys.hpp"

#include <gtest/gtest.h>

namespace rodeira::launch {
namespace {

TEST(LiveKeys, TheNewestStateCountsWhateverWasLost) {
  LiveKeysMemory memory;
  memory.Hear({7, 1, {}}, 0.0);
  memory.Hear({7, 2, {{26, true, 1}}}, 0.01);
  EXPECT_TRUE(memory.Take(0.02).Holds(26));
  // Messages 3 to 8, in which the key went up, down and up again, never came.
  memory.Hear({7, 9, {{26, false, 2}, {8, true, 4}}}, 0.1);
  const KeysNow now = memory.Take(0.1);
  EXPECT_FALSE(now.Holds(26));
  EXPECT_TRUE(now.Holds(8));
  EXPECT_EQ(now.PressesOf(26), 1u) << "one since the last that was taken";
  EXPECT_EQ(now.PressesOf(8), 4u);
  EXPECT_EQ(memory.Take(0.1).PressesOf(8), 0u) << "each press once";
}

TEST(LiveKeys, AnOvertakenMessageIsIgnored) {
  LiveKeysMemory memory;
  memory.Hear({7, 1, {}}, 0.0);
  memory.Hear({7, 5, {{26, true, 3}}}, 0.1);
  memory.Hear({7, 4, {{26, false, 2}}}, 0.11);
  memory.Hear({7, 5, {{26, true, 3}}}, 0.12);  // twice
  const KeysNow now = memory.Take(0.12);
  EXPECT_TRUE(now.Holds(26));
  EXPECT_EQ(now.PressesOf(26), 3u);
}

TEST(LiveKeys, ASilentWindowHasLetGoOfEverything) {
  LiveKeysMemory memory;
  memory.Hear({7, 1, {}}, 0.0);
  memory.Hear({7, 2, {{26, true, 1}}}, 10.0);
  EXPECT_TRUE(memory.Take(10.0 + 0.9 * LiveKeysMemory::kSilence_s).Holds(26));
  EXPECT_TRUE(memory.Take(10.0 + 1.1 * LiveKeysMemory::kSilence_s).held.empty());
  memory.Hear({7, 3, {{26, true, 1}}}, 12.0);
  EXPECT_TRUE(memory.Take(12.0).Holds(26)) << "it was only slow";
}

TEST(LiveKeys, SeveralWindowsDriveTogether) {
  LiveKeysMemory memory;
  memory.Hear({1, 1, {}}, 0.0);
  memory.Hear({2, 1, {}}, 0.0);
  memory.Hear({1, 2, {{26, true, 1}, {4, true, 1}}}, 0.1);
  memory.Hear({2, 2, {{26, true, 1}, {7, true, 1}}}, 0.1);
  KeysNow now = memory.Take(0.1);
  EXPECT_EQ(now.held, (std::vector<std::uint32_t>{4, 7, 26}));
  EXPECT_EQ(now.PressesOf(26), 2u);
  memory.Hear({1, 3, {{26, false, 1}, {4, false, 1}}}, 0.2);
  now = memory.Take(0.2);
  EXPECT_EQ(now.held, (std::vector<std::uint32_t>{7, 26})) << "the other still holds it";
}

TEST(LiveKeys, WhatWasPressedBeforeAWindowWasHeardDoesNotCount) {
  LiveKeysMemory memory;
  memory.Hear({7, 100, {{8, false, 5}}}, 0.0);
  EXPECT_EQ(memory.Take(0.0).PressesOf(8), 0u);
  memory.Hear({7, 101, {{8, true, 6}}}, 0.1);
  EXPECT_EQ(memory.Take(0.1).PressesOf(8), 1u);
}

TEST(LiveKeys, WithinAProcessEveryReceiverHearsEverySender) {
  LiveKeysBoard board;
  const auto a = board.MakeReceiver();
  const auto b = board.MakeReceiver();
  const auto window = board.MakeSender();
  window->Say({});
  window->Say({{26, true, 1}});
  EXPECT_TRUE(a->Take().Holds(26));
  const KeysNow other = b->Take();
  EXPECT_TRUE(other.Holds(26));
  EXPECT_EQ(other.PressesOf(26), 1u);
}

}  // namespace
}  // namespace rodeira::launch
