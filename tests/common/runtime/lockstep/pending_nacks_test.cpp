// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/pending_nacks.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace rodeira::lockstep {
namespace {

std::vector<std::vector<Step>> Drained(PendingNacks& questions) {
  std::vector<std::vector<Step>> all;
  while (const auto q = questions.Next())
    all.push_back({static_cast<Step>(q->asker), static_cast<Step>(q->gap.source), q->gap.from});
  return all;
}

TEST(PendingNacks, ARepeatedNackIsAnsweredOnce) {
  PendingNacks questions;
  for (int i = 0; i < 1000; ++i) questions.Add({2, {1, 64}});
  EXPECT_EQ(Drained(questions), (std::vector<std::vector<Step>>{{2, 1, 64}}));
  EXPECT_TRUE(questions.empty());
}

TEST(PendingNacks, OfOneAskerAndSourceTheNewestStandsWhateverItsStep) {
  PendingNacks questions;
  for (const Step from : {0, 64, 128, 32}) questions.Add({2, {1, from}});
  EXPECT_EQ(Drained(questions), (std::vector<std::vector<Step>>{{2, 1, 32}}));
}

TEST(PendingNacks, WhatIsRepeatedWhileItIsAnsweredWasAnsweredAndWhatIsNewWasNot) {
  PendingNacks questions;
  questions.Add({2, {1, 64}});
  ASSERT_TRUE(questions.Next());
  questions.Add({2, {1, 64}});
  EXPECT_TRUE(questions.empty());
  questions.Add({2, {1, 128}});
  questions.Add({3, {1, 64}});
  EXPECT_EQ(Drained(questions), (std::vector<std::vector<Step>>{{3, 1, 64}, {2, 1, 128}}));
  questions.Add({2, {1, 128}});  // the answer was lost
  EXPECT_EQ(Drained(questions), (std::vector<std::vector<Step>>{{2, 1, 128}}));
}

TEST(PendingNacks, NoNodeWaitsLongerThanARoundHoweverEagerTheOthersAre) {
  PendingNacks questions;
  const auto all_ask = [&] {
    for (NodeIndex asker = 0; asker < 4; ++asker) questions.Add({asker, {asker % 2, 0}});
  };
  std::vector<int> answered(4);
  all_ask();
  for (int i = 0; i < 40; ++i) {
    const auto next = questions.Next();
    ASSERT_TRUE(next);
    ++answered[next->asker];
    all_ask();
    questions.Add({next->asker, {next->gap.source, i + 1}});  // it asks at once for the rest
  }
  EXPECT_EQ(answered, (std::vector<int>{10, 10, 10, 10}));
}

}  // namespace
}  // namespace rodeira::lockstep
