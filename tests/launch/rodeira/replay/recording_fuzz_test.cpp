// SPDX-License-Identifier: Apache-2.0
// Whole recordings with drawn changes, given to everything that opens one: whatever stands in them, there is a sentence
// or a result, and nothing that was changed passes for what was recorded. RODEIRA_FUZZ_RECORDINGS sets how many,
// RODEIRA_FUZZ_FIRST with which number they begin.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "common/core/base/files.hpp"
#include "common/runtime/replay/sample_reader.hpp"
#include "launch/rodeira/commands/info_command.hpp"
#include "launch/rodeira/commands/repair_command.hpp"
#include "launch/rodeira/replay/branch.hpp"
#include "launch/rodeira/replay/verify.hpp"
#include "tests/common/data/record/mutated.hpp"
#include "tests/launch/rodeira/replay/copied_recording.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/property/last_words.hpp"
#include "tests/setting.hpp"
#include "tests/system/command.hpp"
#include "tests/tree.hpp"

namespace rodeira::cli {
namespace {

using lockstep::Step;
using record::Draw;
using system_test::Bin;
using system_test::RunCommand;

constexpr Step kMaxSteps = 60;  // whatever a changed file says of its end

// What is printed meanwhile goes nowhere.
class Quiet {
 public:
  Quiet() {
    std::fflush(nullptr);
    const int nothing = ::open("/dev/null", O_WRONLY);
    for (int i : {1, 2}) {
      was_[i] = ::dup(i);
      ::dup2(nothing, i);
    }
    ::close(nothing);
  }
  ~Quiet() {
    std::fflush(nullptr);
    for (int i : {1, 2}) {
      ::dup2(was_[i], i);
      ::close(was_[i]);
    }
  }

 private:
  int was_[3] = {};
};

class RecordingFuzz : public ::testing::Test {
 protected:
  std::string File(const std::string& name) const { return (folder_.path() / name).string(); }

  // A short run as it is written, and once more with chunks that are not compressed: there the changes reach the
  // samples.
  void AddSeeds(const std::string& launch, const std::string& seconds) {
    const auto ended =
        RunCommand({Bin("rodeira"), "run", launch, "--in-process", "--for", seconds, "--record", File("seed.mcap")});
    ASSERT_EQ(ended.status, 0) << ended.out;
    record::WriterSettings settings;
    settings.compression = record::Compression::kNone;
    settings.chunk_span_ns = 8'000'000;
    CopyRecording(
        File("seed.mcap"), File("plain.mcap"), [](const std::string&, record::TextMap&) {},
        [](const std::string&, const record::Message&, base::Bytes&) { return true; },
        [](const std::string&) { return true; }, settings);
    for (const char* name : {"seed.mcap", "plain.mcap", "plain.mcap"}) {
      seeds_.push_back(base::ReadBytes(File(name)).value());
      const auto verdict = VerifyFile(File(name), 0);
      ASSERT_TRUE(verdict.ok()) << verdict.error().Text();
      ASSERT_FALSE(verdict.value().difference.has_value()) << verdict.value().difference->Text();
    }
    std::filesystem::remove(File("seed.mcap"));
  }

  static void ExpectASentence(const base::Error& error) {
    EXPECT_FALSE(error.message.empty());
    EXPECT_EQ(error.Text().find('\n'), std::string::npos) << error.Text();
    EXPECT_EQ(error.Text().find("rodeira-replay-"), std::string::npos) << error.Text();
  }
  static base::Result<VerifyResult> VerifyFile(const std::string& file, Step from) {
    const auto run = replay::RecordedRun::Open(file);
    if (!run) return run.error();
    Recomputation spec;
    spec.from = from;
    spec.last_step = std::min(run.value().last_step(), kMaxSteps);
    auto done = Recompute(run.value(), spec);
    if (!done) return done.error();
    return std::move(done.value().verdict);
  }
  // Everything that looks at a recording without computing it.
  static void LookAt(const std::string& file, Draw& draw) {
    const auto run = replay::RecordedRun::Open(file);
    if (!run) return ExpectASentence(run.error());
    std::vector<lockstep::SourceIndex> sources;
    for (lockstep::SourceIndex s = 0; s < run.value().roster().sources().size(); ++s) sources.push_back(s);
    replay::SampleReader sample_reader(run.value(), sources);
    for (int i = 0; i < 3; ++i) {
      const auto samples = sample_reader.At(static_cast<Step>(draw.Below(kMaxSteps)));
      if (!samples) ExpectASentence(samples.error());
    }
    const auto at = run.value().SnapshotAtOrBefore(static_cast<Step>(draw.Below(kMaxSteps)));
    if (!at) return ExpectASentence(at.error());
    const auto snapshots = run.value().Snapshots(at.value());
    if (!snapshots) ExpectASentence(snapshots.error());
  }
  void TryABranch(const std::string& file, Draw& draw) const {
    const std::string branch = File("branch.mcap");
    std::filesystem::remove(branch);
    const auto at = static_cast<Step>(2 * draw.Below(16));
    const auto outcome = Branch({file, at, {{"seed", "7"}}, at + 10, branch});
    if (!outcome) ExpectASentence(outcome.error());
    const bool made = outcome.ok() && !outcome.value().difference;
    EXPECT_EQ(std::filesystem::exists(branch), made);
  }

  const TemporaryFolder folder_;
  std::vector<base::Bytes> seeds_;
};

TEST_F(RecordingFuzz, NoChangedRecordingCrashesOrPasses) {
  const std::string root = SourceDir();
  const std::string empty = folder_
                                .Write("empty.yaml",
                                       "rodeira: launch/1\nsnapshot_every_s: 0.01\nnodes:\n  a: {kind: empty}\n"
                                       "  b: {kind: empty, period_s: 0.002, delay_s: 0.004}\n  c: {kind: empty}\n  "
                                       "recorder: {kind: recorder, period_s: 0.01}\n")
                                .string();
  const std::string without =
      folder_
          .Write("without.yaml",
                 "rodeira: launch/1\nsnapshot_every_s: 0.01\nnodes:\n  a: {kind: empty}\n"
                 "  b: {kind: empty, config: {saves: false}}\n  recorder: {kind: recorder, period_s: 0.01}\n")
          .string();
  const std::string drive =
      folder_
          .Write("drive.yaml", "rodeira: launch/1\nsnapshot_every_s: 0.01\nworld: " + root +
                                   "/tests/data/straight.yaml\nnodes:\n  road: {kind: road}\n"
                                   "  driver: {kind: input, period_s: 0.002, config: {source: script, script: " +
                                   root +
                                   "/tests/data/standing.csv}}\n"
                                   "  ego: {kind: vehicle, config: {vehicle: " +
                                   root +
                                   "/configs/vehicles/default.yaml}}\n  recorder: {kind: recorder, period_s: 0.01}\n")
          .string();
  for (const std::string& launch : {empty, without, drive}) ASSERT_NO_FATAL_FAILURE(AddSeeds(launch, "0.03"));
  const std::size_t first = Setting("RODEIRA_FUZZ_FIRST", 0);
  const std::size_t count = Setting("RODEIRA_FUZZ_RECORDINGS", 100);
  std::size_t opened = 0, computed = 0, mended = 0;
  property::SayWhereItDies();
  const std::string file = File("changed.mcap"), repaired = File("repaired.mcap");
  for (std::size_t number = first; number < first + count; ++number) {
    property::NowTrying("recording", number);
    ::alarm(120);
    Draw draw(number);
    const base::Bytes& seed = seeds_[draw.Below(seeds_.size())];
    base::Bytes bytes = seed;
    const std::size_t mutations = 1 + draw.Below(3);
    for (std::size_t i = 0; i < mutations && !bytes.empty(); ++i)
      draw.Below(2) == 0 ? record::Mutate(bytes, draw) : record::MutateARecord(bytes, draw);
    const bool resealed = draw.Below(2) == 0;
    if (resealed) record::Reseal(bytes);
    const bool must_be_found =
        mutations == 1 && !resealed && bytes != seed;  // with two, one may take a checksum out of force
    ASSERT_TRUE(base::WriteWhole(file, bytes).ok());
    LookAt(file, draw);
    const auto verdict = VerifyFile(file, static_cast<Step>(draw.Below(40)));
    if (verdict) {
      ++opened;
      if (!verdict.value().difference) ++computed;
      EXPECT_FALSE(must_be_found) << "a changed byte was not found";
    } else {
      ExpectASentence(verdict.error());
    }
    if (draw.Below(4) == 0) TryABranch(file, draw);
    if (draw.Below(4) == 0) {
      std::filesystem::remove(repaired);
      int status = 0;
      {
        const Quiet quiet;
        const int info = Info(file);
        status = RepairRecording(file, repaired);
        EXPECT_TRUE(info >= 0 && info <= 2 && !(must_be_found && info == 0)) << info;
      }
      EXPECT_EQ(std::filesystem::exists(repaired), status <= 1);  // 1: something is lost
      if (status <= 1) {
        const auto again = VerifyFile(repaired, 0);
        if (!again) ExpectASentence(again.error());
        if (again && !again.value().difference) ++mended;
        EXPECT_FALSE(must_be_found && again && again.value().difference)
            << "repaired, but not as it was: " << again.value().difference->Text();
      }
    }
    if (testing::Test::HasFailure()) FAIL() << property::g_last_words;
  }
  ::alarm(0);
  if (count < 1000) return;
  EXPECT_GT(opened, 0u) << "all is refused at the door";
  EXPECT_GT(mended, 0u);
  EXPECT_GT(computed, 0u) << "some changes lie where nothing depends on them";
}

}  // namespace
}  // namespace rodeira::cli
