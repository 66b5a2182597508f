// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/unavailable_nodes.hpp"

#include <gtest/gtest.h>

namespace rodeira::lockstep {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

TEST(UnavailableNodes, TellsWhichAndSinceWhenInTheOrderOfTheRoster) {
  UnavailableNodes missed;
  EXPECT_TRUE(missed.empty());
  missed.Lost(3, "node 'c' was killed", 2 * kSecond_ns);
  missed.Lost(1, "node 'a' was stopped", 4 * kSecond_ns);
  EXPECT_EQ(missed.Text(5 * kSecond_ns), "node 'a' was stopped 1.0 s ago; node 'c' was killed 3.0 s ago");
  missed.Restarted(3);
  EXPECT_EQ(missed.Text(5 * kSecond_ns), "node 'a' was stopped 1.0 s ago");
}

TEST(UnavailableNodes, WhatWasOnItsWayDoesNotBringANodeBack) {
  UnavailableNodes missed;
  missed.Lost(1, "node 'a' was stopped", kSecond_ns);
  missed.Heard(1, kSecond_ns + kSecond_ns / 10);
  EXPECT_FALSE(missed.empty());
  missed.Heard(2, 3 * kSecond_ns);
  EXPECT_FALSE(missed.empty());
  missed.Heard(1, 2 * kSecond_ns);
  EXPECT_TRUE(missed.empty());
}

}  // namespace
}  // namespace rodeira::lockstep
