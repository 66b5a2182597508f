// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/pending_nacks.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace rodeira::lockstep {
namespace {

std::vector<std::vector<Step>> Drained(PendingNacks& nacks) {
  std::vector<std::vector<Step>> all;
  while (const auto q = nacks.Next())
    all.push_back({static_cast<Step>(q->requester), static_cast<Step>(q->gap.source), q->gap.from});
  return all;
}

TEST(PendingNacks, ARepeatedNackIsAnsweredOnce) {
  PendingNacks nacks;
  for (int i = 0; i < 1000; ++i) nacks.Add({2, {1, 64}});
  EXPECT_EQ(Drained(nacks), (std::vector<std::vector<Step>>{{2, 1, 64}}));
  EXPECT_TRUE(nacks.empty());
}

TEST(PendingNacks, OfOneRequesterAndSourceTheNewestStandsWhateverItsStep) {
  PendingNacks nacks;
  for (const Step from : {0, 64, 128, 32}) nacks.Add({2, {1, from}});
  EXPECT_EQ(Drained(nacks), (std::vector<std::vector<Step>>{{2, 1, 32}}));
}

TEST(PendingNacks, WhatIsRepeatedWhileItIsAnsweredWasAnsweredAndWhatIsNewWasNot) {
  PendingNacks nacks;
  nacks.Add({2, {1, 64}});
  ASSERT_TRUE(nacks.Next());
  nacks.Add({2, {1, 64}});
  EXPECT_TRUE(nacks.empty());
  nacks.Add({2, {1, 128}});
  nacks.Add({3, {1, 64}});
  EXPECT_EQ(Drained(nacks), (std::vector<std::vector<Step>>{{3, 1, 64}, {2, 1, 128}}));
  nacks.Add({2, {1, 128}});  // the answer was lost
  EXPECT_EQ(Drained(nacks), (std::vector<std::vector<Step>>{{2, 1, 128}}));
}

TEST(PendingNacks, NoNodeWaitsLongerThanARoundHoweverEagerTheOthersAre) {
  PendingNacks nacks;
  const auto all_ask = [&] {
    for (NodeIndex requester = 0; requester < 4; ++requester) nacks.Add({requester, {requester % 2, 0}});
  };
  std::vector<int> answered(4);
  all_ask();
  for (int i = 0; i < 40; ++i) {
    const auto next = nacks.Next();
    ASSERT_TRUE(next);
    ++answered[next->requester];
    all_ask();
    nacks.Add({next->requester, {next->gap.source, i + 1}});  // it asks at once for the rest
  }
  EXPECT_EQ(answered, (std::vector<int>{10, 10, 10, 10}));
}

}  // namespace
}  // namespace rodeira::lockstep
