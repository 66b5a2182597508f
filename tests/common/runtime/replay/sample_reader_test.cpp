// SPDX-License-Identifier: Apache-2.0
// A recording at any step: the same samples as by reading it from its beginning, and only the chunks that are needed.
#include "common/runtime/replay/sample_reader.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "common/core/base/files.hpp"
#include "common/core/base/random.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "tests/common/runtime/replay/made_recording.hpp"

namespace rodeira::replay {
namespace {

using lockstep::SourceIndex;
using lockstep::Step;

// A car at 10 Hz, traffic at 2 Hz, a steering hand at 10 Hz.
constexpr const char* kLaunch =
    "rodeira: launch/1\nname: made\nnodes:\n  hands: {kind: input, period_s: 0.1}\n  ego: {kind: vehicle, period_s: "
    "0.1}\n"
    "  others: {kind: traffic, period_s: 0.5}\n";

base::Bytes Payload(const lockstep::Source& source, Step step) {
  if (source.topic == idl::topics::kControls) return idl::Encode(msg::Controls());
  if (source.topic == idl::topics::kTrafficState) return idl::Encode(msg::TrafficState());
  if (source.topic == idl::topics::kCollisions) return idl::Encode(msg::Collisions());
  if (source.topic == idl::topics::kSignalsState) return idl::Encode(msg::SignalsState());
  if (source.topic == idl::topics::kTrafficDetails) return idl::Encode(msg::TrafficDetails());
  msg::VehicleState car;
  car.position_w_m().x(0.02 * static_cast<double>(step));
  return idl::Encode(car);
}

class SampleReaderTest : public testing::Test {
 protected:
  SampleReaderTest()
      : file_(std::filesystem::temp_directory_path() / ("rodeira-tape-" + std::to_string(::getpid()) + ".mcap")) {}
  ~SampleReaderTest() override { std::filesystem::remove(file_); }

  RecordedRun Made(Step last, const std::function<void(MadeRecording&)>& change = {}) {
    MadeRecording spec;
    spec.launch_text = kLaunch;
    spec.last_step = last;
    spec.payload = Payload;
    if (change) change(spec);
    Make(spec, file_);
    auto run = RecordedRun::Open(file_);
    EXPECT_TRUE(run.ok()) << run.error().Text();
    return std::move(run).value();
  }
  static std::vector<SourceIndex> Seen(const RecordedRun& run) {
    std::vector<SourceIndex> seen;
    for (SourceIndex s = 0; s < run.roster().sources().size(); ++s) {
      const std::string& topic = run.roster().source(s).topic;
      if (topic == idl::topics::kVehicleState || topic == idl::topics::kTrafficState) seen.push_back(s);
    }
    return seen;
  }
  static std::vector<Step> ValidAt(SampleReader& sample_reader, Step step) {
    const auto samples = sample_reader.At(step);
    EXPECT_TRUE(samples.ok()) << samples.error().Text();
    std::vector<Step> valid;
    for (const auto& sample : samples.value()) valid.push_back(sample ? sample->valid() : -1);
    return valid;
  }
  // The same, told by a plain walk over all messages.
  static std::vector<std::optional<lockstep::Sample>> Plainly(const RecordedRun& run,
                                                              const std::vector<SourceIndex>& sources, Step step) {
    std::vector<std::optional<lockstep::Sample>> newest(sources.size());
    SampleStream stream = run.Samples();
    for (auto sample = stream.Next(); sample.value(); sample = stream.Next()) {
      const auto place = std::ranges::find(sources, sample.value()->source());
      if (place == sources.end() || sample.value()->valid() > step) continue;
      auto& best = newest[static_cast<std::size_t>(place - sources.begin())];
      if (!best || best->valid() < sample.value()->valid()) best = *sample.value();
    }
    return newest;
  }
  void ExpectTheSameAsPlainly(const RecordedRun& run, Step last, std::uint64_t seed) {
    SampleReader sample_reader(run, Seen(run));
    for (std::uint64_t n = 0; n < 60; ++n) {
      const auto step = static_cast<Step>(base::RandomBits({seed, n}) % static_cast<std::uint64_t>(last + 500));
      const auto samples = sample_reader.At(step);
      ASSERT_TRUE(samples.ok()) << samples.error().Text();
      const auto expected = Plainly(run, sample_reader.sources(), step);
      for (std::size_t i = 0; i < expected.size(); ++i) {
        ASSERT_EQ(samples.value()[i].has_value(), expected[i].has_value()) << step;
        if (!expected[i]) continue;
        ASSERT_EQ(*samples.value()[i]->payload, *expected[i]->payload)
            << step << ": " << samples.value()[i]->valid() << ", " << expected[i]->valid();
      }
    }
  }

  std::filesystem::path file_;
};

TEST_F(SampleReaderTest, SaysWhatTheStepLawSays) {
  const RecordedRun run = Made(30'000);
  SampleReader sample_reader(run, Seen(run));
  EXPECT_EQ(ValidAt(sample_reader, 0), (std::vector<Step>{0, 0}));
  EXPECT_EQ(ValidAt(sample_reader, 12'345), (std::vector<Step>{12'300, 12'000}));
  EXPECT_EQ(ValidAt(sample_reader, 12'299), (std::vector<Step>{12'200, 12'000}));
  EXPECT_EQ(ValidAt(sample_reader, 99'999), (std::vector<Step>{30'000, 30'000})) << "behind the end: the end";
  EXPECT_EQ(ValidAt(sample_reader, -1), (std::vector<Step>{-1, -1}));
  ExpectTheSameAsPlainly(run, 30'000, 1);
}

TEST_F(SampleReaderTest, AnHourIsReadOnlyWhereItIsLookedAt) {
  constexpr Step kHour = 3'600'000;
  const RecordedRun run = Made(kHour);
  ASSERT_GE(run.reader().chunks().size(), 3600u) << "chunks of a second";
  SampleReader sample_reader(run, Seen(run));
  EXPECT_EQ(sample_reader.chunks_read(), 0u);
  for (const Step step : {kHour - 1, Step{7}, kHour / 2, Step{1'234'567}, kHour / 3}) {  // anywhere: one chunk
    const std::uint64_t before = sample_reader.chunks_read();
    EXPECT_EQ(ValidAt(sample_reader, step), (std::vector<Step>{step / 100 * 100, step / 500 * 500}));
    EXPECT_EQ(sample_reader.chunks_read(), before + 1) << step;
  }
  std::uint64_t before = sample_reader.chunks_read();
  for (Step step = 2'000'000; step < 2'010'000; step += 20)
    ValidAt(sample_reader, step);  // ten seconds forward: ten chunks
  EXPECT_EQ(sample_reader.chunks_read(), before + 10);
  before = sample_reader.chunks_read();
  for (Step step = 2'009'980; step >= 2'003'000; step -= 20)
    ValidAt(sample_reader, step);  // and back: they are still known
  EXPECT_EQ(sample_reader.chunks_read(), before);
  for (Step step = 2'002'980; step >= 1'995'000; step -= 20) ValidAt(sample_reader, step);
  EXPECT_EQ(sample_reader.chunks_read(), before + 7) << "second 2002 is the eighth that was kept";
}

TEST_F(SampleReaderTest, ChunksThatOverlapAreTakenTogether) {
  for (const std::uint64_t seed : {11U, 12U, 13U}) {
    const RecordedRun run = Made(20'000, [seed](MadeRecording& spec) {
      spec.settings.chunk_bytes = 4096;
      spec.reorder = [seed](auto& order) {  // each up to three seconds away from its place
        std::vector<std::pair<double, std::pair<Step, SourceIndex>>> keyed;
        for (std::size_t i = 0; i < order.size(); ++i)
          keyed.emplace_back(static_cast<double>(order[i].first) + 3000.0 * base::RandomUniform({seed, i}), order[i]);
        std::ranges::stable_sort(keyed, {}, [](const auto& entry) { return entry.first; });
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = keyed[i].second;
      };
    });
    ExpectTheSameAsPlainly(run, 20'000, seed);
  }
}

TEST_F(SampleReaderTest, WhereASampleIsMissingTheOneBeforeItStands) {
  const RecordedRun run = Made(20'000, [](MadeRecording& spec) {
    spec.payload = [](const lockstep::Source& source, Step step) {
      const bool lost = source.topic == idl::topics::kVehicleState
                            ? step > 5'000 && step < 12'000
                            : source.topic == idl::topics::kTrafficState && step < 3'000;
      return lost ? base::Bytes() : Payload(source, step);
    };
  });
  SampleReader sample_reader(run, Seen(run));
  EXPECT_EQ(ValidAt(sample_reader, 11'950), (std::vector<Step>{5'000, 11'500}));
  EXPECT_EQ(ValidAt(sample_reader, 12'000), (std::vector<Step>{12'000, 12'000}));
  EXPECT_EQ(ValidAt(sample_reader, 2'000), (std::vector<Step>{2'000, -1}));
  ExpectTheSameAsPlainly(run, 20'000, 2);
}

TEST_F(SampleReaderTest, ADamagedChunkIsToldOfAndTheRestIsThere) {
  { const RecordedRun whole = Made(20'000); }
  const auto damaged_at = [&] {
    const auto reader = record::McapReader::Open(file_);
    const auto& chunk = *std::ranges::find_if(reader.value().chunks(),
                                              [](const auto& one) { return one.first_log_time_ns == 10'000'000'000; });
    return chunk.offset + chunk.record_bytes - 20;
  }();
  {
    std::fstream bytes(file_, std::ios::in | std::ios::out | std::ios::binary);
    bytes.seekp(static_cast<std::streamoff>(damaged_at));
    bytes.put('\x5a').put('\x5a').put('\x5a');
  }
  const auto run = RecordedRun::Open(file_);
  ASSERT_TRUE(run.ok()) << run.error().Text();
  SampleReader sample_reader(run.value(), Seen(run.value()));
  EXPECT_EQ(ValidAt(sample_reader, 9'950), (std::vector<Step>{9'900, 9'500}));
  const auto there = sample_reader.At(10'200);
  ASSERT_FALSE(there.ok());
  EXPECT_EQ(there.error().exit_status(), 2);
  EXPECT_NE(there.error().Text().find("the chunk with the messages from 10.000 s to 10.900 s is damaged"),
            std::string::npos)
      << there.error().Text();
  EXPECT_EQ(ValidAt(sample_reader, 11'000), (std::vector<Step>{11'000, 11'000}));
}

TEST_F(SampleReaderTest, AnEndThatCannotBeIsRefused) {
  const auto make = [&](Step said) {
    MadeRecording spec;
    spec.launch_text = kLaunch;
    spec.last_step = 100;
    spec.payload = Payload;
    spec.said_last_step = said;
    Make(spec, file_);
    return RecordedRun::Open(file_);
  };
  const auto run = make(9'000'000'000'000'000'000);
  ASSERT_FALSE(run.ok());
  EXPECT_NE(run.error().Text().find("ended at step 9000000000000000000, which cannot be"), std::string::npos)
      << run.error().Text();
  const auto longer = make(5'000);  // than what is recorded: the last samples stand
  ASSERT_TRUE(longer.ok()) << longer.error().Text();
  SampleReader sample_reader(longer.value(), Seen(longer.value()));
  EXPECT_EQ(ValidAt(sample_reader, 4'000), (std::vector<Step>{100, 0}));
}

TEST_F(SampleReaderTest, BrokenFilesAreRefusedOrRead) {
  { const RecordedRun whole = Made(3'000); }
  const base::Bytes whole = base::ReadBytes(file_).value();
  std::size_t opened = 0, refused = 0;
  for (std::uint64_t n = 0; n < 400; ++n) {
    base::Bytes bytes = whole;
    for (std::uint64_t i = 0; i <= n % 3; ++i)
      bytes[base::RandomBits({n, i, 1}) % bytes.size()] = static_cast<std::byte>(base::RandomBits({n, i, 2}));
    if (n % 8 == 7) bytes.resize(base::RandomBits({n, 3}) % bytes.size());
    std::filesystem::remove(file_);
    Must(base::WriteWhole(file_, bytes));
    const auto run = RecordedRun::Open(file_);
    ++(run ? opened : refused);
    if (!run) {
      EXPECT_EQ(run.error().exit_status(), 2) << run.error().Text();
      continue;
    }
    SampleReader sample_reader(run.value(), Seen(run.value()));
    for (Step step = 0; step <= 3'000; step += 250) {
      const auto samples = sample_reader.At(step);
      EXPECT_TRUE(samples.ok() || samples.error().exit_status() == 2) << samples.error().Text();
    }
  }
  EXPECT_GT(opened, 20u);
  EXPECT_GT(refused, 20u);
}

}  // namespace
}  // namespace rodeira::replay
