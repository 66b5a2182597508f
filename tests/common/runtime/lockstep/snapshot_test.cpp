// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/snapshot.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "common/core/base/carried_state.hpp"
#include "tests/common/runtime/lockstep/law.hpp"

namespace rodeira::lockstep {
namespace {

using Contents = std::map<std::pair<SourceIndex, Step>, std::uint64_t>;

TEST(Snapshot, ARunResumedFromAnyStepGoesOnWithTheSameBits) {
  EXPECT_TRUE(rc::check("resumed runs equal the reference", [](std::uint64_t seed) {
    const Roster roster = law::RandomRoster(seed);
    const Step last = 80;
    const Step every = 1 + static_cast<Step>(seed % 40);
    std::vector<Snapshot> kept;
    InProcessSettings settings;
    settings.last_step = last;
    settings.snapshot_every = every;
    settings.on_snapshot = [&kept](const Snapshot& snapshot) {
      kept.push_back(Snapshot::Decode(snapshot.Encode()).value());  // as another process would read it
    };
    auto first = law::MakeNodes(roster);
    const RunOutcome whole = RunShuffled(roster, first.nodes, settings, seed);
    RC_ASSERT(whole.ok);

    std::vector<Snapshot> resume(roster.nodes().size());
    std::size_t found = 0;
    for (const Snapshot& snapshot : kept) {
      if (snapshot.at != every) continue;
      resume[snapshot.node] = snapshot;
      ++found;
    }
    if (found != roster.nodes().size()) return;  // some node has no activation behind that step

    Contents contents;
    InProcessSettings again;
    again.last_step = last;
    again.resume = resume;
    again.first_step = every;
    again.on_sample = [&contents](const Sample& sample) {
      contents[{sample.source(), sample.valid()}] = law::ContentOf(sample);
    };
    auto second = law::MakeNodes(roster);
    const RunOutcome resumed = RunShuffled(roster, second.nodes, again, seed + 7);
    RC_ASSERT(resumed.fault == "");
    RC_ASSERT(resumed.ok);
    RC_ASSERT(resumed.digest == whole.digest);
    const Contents reference = law::Reference(roster, last);
    for (const auto& [key, content] : contents) RC_ASSERT(reference.at(key) == content);
  }));
}

TEST(Snapshot, CutAnywhereItIsRefused) {
  Snapshot snapshot;
  snapshot.at = 12;
  snapshot.state.resize(20);
  snapshot.samples.push_back({{}, std::make_shared<const base::Bytes>(law::Payload(5))});
  const base::Bytes whole = snapshot.Encode();
  ASSERT_TRUE(Snapshot::Decode(whole).ok());
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(Snapshot::Decode(std::span(whole).first(size)).ok()) << size;
  base::Bytes longer = whole;
  longer.push_back(std::byte{1});
  EXPECT_FALSE(Snapshot::Decode(longer).ok());
}

TEST(Snapshot, WithoutAStateItSaysSo) {
  Snapshot snapshot;
  snapshot.at = 12;
  snapshot.steps = 3;
  snapshot.has_state = false;
  const auto read = Snapshot::Decode(snapshot.Encode());
  ASSERT_TRUE(read.ok()) << read.error().Text();
  EXPECT_FALSE(read.value().has_state);
  EXPECT_EQ(read.value().steps, 3u);
  snapshot.has_state = true;  // an empty state is one
  EXPECT_TRUE(Snapshot::Decode(snapshot.Encode()).value().has_state);
  snapshot.has_state = false;
  snapshot.state.resize(1);
  EXPECT_FALSE(Snapshot::Decode(snapshot.Encode()).ok());
}

// Bytes of another program's state may hold addresses: they are carried, and no difference. Everything else is one.
TEST(Snapshot, CarriedFieldsAreNoDifference) {
  const Roster roster =
      Roster::Create(1'000'000, 20,
                     {{"car", "t", Role::kStepped, 1, 1, 0, {"a"}, {}, 10},
                      {"sink",
                       "t",
                       Role::kStepped,
                       5,
                       5,
                       0,
                       {},
                       {{"a", PortKind::kEvent, {"car"}}, {std::string(kSnapshotTopic), PortKind::kEvent, {"car"}}},
                       0}})
          .value();
  const auto sample = [&roster](double speed, std::vector<std::uint8_t> bytes, std::uint32_t incarnation = 0) {
    base::StateWriter state;
    state.Put("speed", speed);
    state.Put(std::string(base::kCarried) + "fmu", bytes);
    state.Put("gear", 3);
    Snapshot snapshot;
    snapshot.at = 10;
    snapshot.state = state.bytes();
    return snapshot.ToSample(roster, incarnation);
  };
  EXPECT_TRUE(SameContent(sample(2.0, {1, 2, 3}), sample(2.0, {9, 2, 3}, 1)));
  EXPECT_TRUE(SameContent(sample(2.0, {1, 2, 3}), sample(2.0, {7})));
  EXPECT_FALSE(SameContent(sample(2.0, {1, 2, 3}), sample(2.5, {1, 2, 3})));
}

}  // namespace
}  // namespace rodeira::lockstep
