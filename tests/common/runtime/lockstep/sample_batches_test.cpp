// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/sample_batches.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

#include "tests/common/runtime/lockstep/law.hpp"

namespace rodeira::lockstep {
namespace {

Sample Make(SourceIndex source, Step valid) {
  base::Bytes payload = law::Payload(static_cast<std::uint64_t>(valid));
  const SampleHeader header{valid, valid * 1'000'000, source, 0, 0};
  header.Write(payload);
  return {header, std::make_shared<const base::Bytes>(std::move(payload))};
}

Roster MakeRoster(Step source_period, Step state_period, Step event_period) {
  return Roster::Create(
             1'000'000, 100,
             {{"source", "t", Role::kStepped, source_period, 0, 0, {"a"}, {}},
              {"state", "t", Role::kStepped, state_period, 0, 0, {"b"}, {{"a", PortKind::kState, {"source"}}}},
              {"events", "t", Role::kStepped, event_period, 0, 0, {}, {{"a", PortKind::kEvent, {"source"}}}}})
      .value();
}

std::vector<Step> Steps(const std::vector<Sample>& samples) {
  std::vector<Step> steps;
  for (const Sample& sample : samples) steps.push_back(sample.valid());
  return steps;
}

TEST(SampleBatches, AStateIsSentOnceAnActivationAndEventsTogether) {
  const Roster roster = MakeRoster(1, 4, 5);
  SampleBatches batches(roster, 0, 1'000'000);
  EXPECT_FALSE(batches.IsSentAlone(0));
  EXPECT_EQ(batches.Consumers(), (std::vector<NodeIndex>{1, 2}));
  std::vector<std::pair<NodeIndex, std::vector<Step>>> sent;
  for (Step v = 0; v <= 11; ++v) {
    for (const auto& batch : batches.Add(Make(0, v), 11)) sent.emplace_back(batch.to, Steps(batch.samples));
  }
  const std::vector<std::pair<NodeIndex, std::vector<Step>>> expected{
      {1, {0}},  {2, {0}}, {1, {4}}, {2, {1, 2, 3, 4, 5}}, {1, {8}}, {2, {6, 7, 8, 9, 10}},
      {1, {11}}, {2, {11}}};  // 11 is the run's last step
  EXPECT_EQ(sent, expected);
}

TEST(SampleBatches, WhatIsFullGoesAtOnce) {
  const Roster roster = MakeRoster(1, 1, 100);
  const std::size_t size = Make(0, 0).payload->size();
  SampleBatches batches(roster, 0, 3 * size);
  EXPECT_TRUE(batches.IsSentAlone(0)) << "the state's consumer is as fast as the source";
  std::vector<std::vector<Step>> sent;
  for (Step v = 0; v <= 6; ++v) {
    for (const auto& batch : batches.Add(Make(0, v), kNever)) sent.push_back(Steps(batch.samples));
  }
  EXPECT_EQ(sent, (std::vector<std::vector<Step>>{{0}, {1, 2, 3}, {4, 5, 6}}));
}

// Against the law: when the newest sample at an activation has been added, everything that this activation sees is
// sent.
RC_GTEST_PROP(SampleBatches, NoNodeWaitsLongerThanForSingleSamples, ()) {
  const Step source = *rc::gen::inRange<Step>(1, 8);
  const Step state = *rc::gen::inRange<Step>(1, 30);
  const Step event = *rc::gen::inRange<Step>(1, 30);
  const Step last = *rc::gen::inRange<Step>(0, 90);
  const Roster roster = MakeRoster(source, state, event);
  SampleBatches batches(roster, 0, *rc::gen::inRange<std::size_t>(1, 2000));
  std::vector<std::set<Step>> has(3);
  for (Step v = 0; v <= last; v += source) {
    for (const NodeIndex n : {1u, 2u}) {
      if (!GetsSampleBatches(roster, 0, n)) has[n].insert(v);
    }
    for (const auto& batch : batches.Add(Make(0, v), last)) {
      for (const Sample& sample : batch.samples) RC_ASSERT(has[batch.to].insert(sample.valid()).second);  // never twice
    }
    for (Step k = FloorTo(v + source - 1, state); k >= v && k <= last; k -= state)
      RC_ASSERT(has[1].contains(FloorTo(k, source)));
    for (Step k = FloorTo(v + source - 1, event); k >= v && k <= last; k -= event) {
      for (Step e = CeilTo(std::max<Step>(k - event + 1, 0), source); e <= k; e += source)
        RC_ASSERT(has[2].contains(e));
    }
  }
  for (Step e = 0; e <= last; e += source)
    RC_ASSERT(has[2].contains(e));  // behind the last activation a sink sees the rest
}

}  // namespace
}  // namespace rodeira::lockstep
