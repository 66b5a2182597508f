// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/kept_samples.hpp"

#include <gtest/gtest.h>

#include "tests/common/runtime/lockstep/law.hpp"

namespace rodeira::lockstep {
namespace {

class KeptSamplesTest : public ::testing::Test {
 protected:
  static Sample Make(SourceIndex source, Step valid) {
    base::Bytes payload = law::Payload(static_cast<std::uint64_t>(valid));
    const SampleHeader header{valid, valid * 1'000'000, source, 0, 0};
    header.Write(payload);
    return {header, std::make_shared<const base::Bytes>(std::move(payload))};
  }
  static Grant Through(Step step, Step safe = kNever) {
    Grant grant;
    grant.through = step;
    grant.safe = safe;
    return grant;
  }
  static std::vector<Step> Steps(const std::vector<Sample>& samples) {
    std::vector<Step> steps;
    for (const Sample& sample : samples) steps.push_back(sample.valid());
    return steps;
  }
  // Window 20; the consumer of events has a period of 5.
  const Roster roster_ = Roster::Create(1'000'000, 20,
                                        {{"fast", "t", Role::kStepped, 2, 0, 0, {"a"}, {}},
                                         {"me", "t", Role::kStepped, 5, 0, 0, {}, {{"a", PortKind::kEvent, {"fast"}}}}})
                             .value();
  KeptSamples kept_{roster_, 0};
};

TEST_F(KeptSamplesTest, GivesWhatIsAskedForInOrder) {
  for (Step v = 0; v <= 10; v += 2) kept_.Add(Make(0, v));
  kept_.Add(Make(0, 4));  // said again: kept once
  EXPECT_EQ(Steps(kept_.From({0, 5})), (std::vector<Step>{6, 8, 10}));
  EXPECT_EQ(Steps(kept_.From({0, 11})), (std::vector<Step>{}));
  EXPECT_EQ(Steps(kept_.From({7, 0})), (std::vector<Step>{}));  // another node's
}

TEST_F(KeptSamplesTest, KeepsWhatTheSlowestConsumerMayStillNeed) {
  for (Step v = 0; v <= 60; v += 2) kept_.Add(Make(0, v));
  kept_.Granted(Through(20));
  EXPECT_EQ(Steps(kept_.From({0, 0})).front(), 0);
  // Granted 43: a node may stand at 23; its next activation is at 25 and sees the events in (20, 25].
  kept_.Granted(Through(43));
  EXPECT_EQ(Steps(kept_.From({0, 0})).front(), 22);
  EXPECT_EQ(kept_.size(), 20u);
}

TEST_F(KeptSamplesTest, KeepsWhatARecorderCouldLose) {
  for (Step v = 0; v <= 1000; v += 2) kept_.Add(Make(0, v));
  kept_.Granted(Through(1000, -1));
  EXPECT_EQ(Steps(kept_.From({0, 0})).front(), 0);
  // Through 21 everything is safe: a recorder's other incarnation begins at 25 and sees the events in (20, 25].
  kept_.Granted(Through(1000, 21));
  EXPECT_EQ(Steps(kept_.From({0, 0})).front(), 22);
  EXPECT_EQ(Steps(kept_.From({0, 0})).back(), 22 + 2 * 63);
  EXPECT_EQ(Steps(kept_.From({0, 900})).back(), 1000);
}

}  // namespace
}  // namespace rodeira::lockstep
