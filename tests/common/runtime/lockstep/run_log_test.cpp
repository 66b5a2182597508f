// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/run_log.hpp"

#include <gtest/gtest.h>

#include "common/core/base/random.hpp"

namespace rodeira::lockstep {
namespace {

constexpr std::int64_t kMs = 1'000'000;

WallTime Through(Step step) {
  WallTime wall;
  wall.through = step;
  return wall;
}

TEST(RunLog, WallTimesWaitForCompanyAndRemarksDoNot) {
  RunLog log;
  EXPECT_FALSE(log.Take(0).has_value());
  log.Add(Through(1));
  EXPECT_FALSE(log.Take(49 * kMs).has_value());
  EXPECT_EQ(log.Take(50 * kMs)->walls.size(), 1u);
  log.Add(Through(2));
  EXPECT_EQ(log.Add(Remark{}), 1u);
  const auto batch = log.Take(51 * kMs);
  ASSERT_TRUE(batch.has_value());
  EXPECT_EQ(batch->number, 1u);
  EXPECT_EQ(batch->walls.size(), 1u);
  EXPECT_EQ(batch->remarks.size(), 1u);
  for (Step k = 0; k < 256; ++k) log.Add(Through(k));
  EXPECT_EQ(log.Take(51 * kMs)->walls.size(), 256u) << "a full batch goes at once";
  log.Close();
  EXPECT_TRUE(log.Take(51 * kMs)->last);
  EXPECT_TRUE(log.closed());
}

// Batches are lost, doubled and overtaken; a reader that asks for what is missing has all of them, once, in order.
TEST(RunLog, TheReceiverHasEverythingInOrderWhateverIsLost) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    KeptLog kept;
    LogInbox inbox;
    std::vector<LogBatch> in_flight, heard;
    std::uint64_t draws = 0;
    const auto draw = [&](std::uint64_t below) { return base::RandomBits({seed, draws++}) % below; };
    constexpr std::uint64_t kBatches = 100;
    const auto take = [&] {
      for (LogBatch& batch : inbox.Take()) heard.push_back(std::move(batch));
    };
    for (std::uint64_t number = 0; number < kBatches; ++number) {
      LogBatch batch{number, {Through(static_cast<Step>(number))}, {}, number + 1 == kBatches};
      kept.Add(batch);
      if (draw(3) != 0) in_flight.push_back(batch);
      while (!in_flight.empty() && draw(2) == 0) {
        const std::size_t at = draw(in_flight.size());
        inbox.Deliver(in_flight[at]);
        if (draw(4) != 0) in_flight.erase(in_flight.begin() + static_cast<std::ptrdiff_t>(at));
      }
      if (const auto gap = inbox.Gap(); gap && draw(2) == 0) {
        for (const LogBatch& again : kept.From(*gap)) in_flight.push_back(again);
      }
      take();
    }
    for (int i = 0; i < 10 && !inbox.AwaitEnd(std::chrono::milliseconds(0)); ++i) {
      for (const LogBatch& again : kept.From(inbox.next())) inbox.Deliver(again);
    }
    EXPECT_TRUE(inbox.AwaitEnd(std::chrono::milliseconds(0))) << "seed " << seed;
    take();
    ASSERT_EQ(heard.size(), kBatches) << "seed " << seed;
    for (std::uint64_t number = 0; number < kBatches; ++number)
      ASSERT_EQ(heard[number].number, number) << "seed " << seed;
  }
}

TEST(RunLog, OnlySoMuchIsKept) {
  KeptLog kept;
  for (std::uint64_t number = 0; number < KeptLog::kMost + 10; ++number) kept.Add({number, {}, {}, false});
  EXPECT_EQ(kept.From(0).front().number, 10u);
  EXPECT_EQ(kept.From(0).size(), 64u);
  EXPECT_TRUE(kept.From(KeptLog::kMost + 10).empty());
}

}  // namespace
}  // namespace rodeira::lockstep
