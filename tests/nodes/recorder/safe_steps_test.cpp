// SPDX-License-Identifier: Apache-2.0
// What a recorder reports as written: nodes keep everything behind it for a restart, and go on from there.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/core/base/files.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "common/data/record/mcap_contents.hpp"
#include "common/data/record/source.hpp"
#include "common/runtime/launch/launch.hpp"
#include "common/runtime/launch/node_context.hpp"
#include "common/runtime/launch/run_log_border.hpp"
#include "common/runtime/lockstep/in_process.hpp"
#include "idl/topics.hpp"
#include "nodes/empty/empty_node.hpp"
#include "nodes/recorder/recorder_node.hpp"

namespace rodeira::nodes {
namespace {

using lockstep::Step;

// A log with its next message `ahead` steps beyond the recorder's activation that takes it.
class LogAhead final : public launch::RunLogReceiver {
 public:
  LogAhead(Step period, Step ahead) : period_(period), ahead_(ahead) {}
  std::vector<lockstep::LogBatch> Take() override {
    lockstep::WallTime wall;
    wall.after = through_;
    wall.through = through_ = std::max(through_ + 1, period_ * static_cast<Step>(number_) + ahead_);
    lockstep::LogBatch batch;
    batch.number = number_++;
    batch.walls = {wall};
    return {batch};
  }
  void BeginAt(std::uint64_t) override {}
  bool AwaitEnd(std::chrono::milliseconds) override { return true; }

 private:
  Step period_, ahead_;
  Step through_ = -1;
  std::uint64_t number_ = 0;
};

// The newest sample in the whole chunks of a recording that is being written: a recorder that is started again now has
// what is valid before it, and begins there.
Step NewestOnDisk(const std::filesystem::path& file) {
  const auto source = record::OpenFileSource(file);
  if (!source) return -1;
  const auto scan = record::ScanFile(*source.value());
  if (!scan) return -1;
  Step newest = -1;
  for (const record::ChunkInfo& info : scan.value().contents.chunks) {
    const auto chunk = record::LoadChunk(*source.value(), info, scan.value().contents);
    if (!chunk) continue;
    for (const record::Chunk::Entry& entry : chunk.value().entries) {
      const auto record = record::RecordAt(chunk.value().records, entry.offset);
      const auto message = record ? record::ParseMessage(record->content) : std::nullopt;
      if (message && scan.value().contents.definitions.channels.at(message->channel).topic == idl::topics::kPulse)
        newest = std::max(newest, static_cast<Step>(message->log_time_ns / 1'000'000));
    }
  }
  return newest;
}

struct Told {
  Step safe = 0, on_disk = 0;
};

class Context final : public launch::NodeContext {
 public:
  Context(const launch::Launch& launch, const std::string& node, Step ahead, std::filesystem::path file,
          std::vector<Told>& told)
      : NodeContext(launch, launch.roster().Find(node)), ahead_(ahead), file_(std::move(file)), told_(told) {}
  ground::Ground& Ground() override { RODEIRA_ASSERT(false); }
  base::Result<launch::WorldSummary> World() override { return base::Failed("run.no_answer", "there is no world"); }
  std::unique_ptr<launch::RunLogReceiver> RunLog() override {
    return std::make_unique<LogAhead>(roster().node(index()).period, ahead_);
  }
  std::function<void(Step)> RecordedStepReporter() override {
    return [this](Step through) { told_.push_back({through, NewestOnDisk(file_)}); };
  }

 private:
  Step ahead_;
  std::filesystem::path file_;
  std::vector<Told>& told_;
};

class SafeSteps : public testing::TestWithParam<Step> {};

// Chunks of 0.8 s go to the file, whether a sample or a message of the log is the first beyond one.
TEST_P(SafeSteps, FollowTheRunWhereverTheLogIs) {
  const base::TemporaryFolder folder = base::TemporaryFolder::Make("safe").value();
  const auto path = folder.path() / "launch.yaml";
  ASSERT_TRUE(base::WriteWhole(path, std::string_view("rodeira: launch/1\nnodes:\n  a: {kind: empty}\n  recorder: "
                                                      "{kind: recorder, config: {file: run.mcap}}\n"))
                  .ok());
  const auto launch = launch::Launch::Load(path);
  ASSERT_TRUE(launch.ok()) << launch.error().Text();
  std::vector<Told> told;
  const auto file = folder.path() / "run.mcap";
  Context of_a(launch.value(), "a", 0, file, told), of_recorder(launch.value(), "recorder", GetParam(), file, told);
  const auto a = MakeEmptyNode(of_a);
  const auto recorder = MakeRecorderNode(of_recorder);
  ASSERT_TRUE(a.ok() && recorder.ok());
  lockstep::InProcessSettings settings;
  settings.last_step = 10'000;
  const auto outcome =
      lockstep::RunThreaded(launch.value().roster(), {a.value().get(), recorder.value().get()}, settings);
  ASSERT_TRUE(outcome.ok) << outcome.fault;
  ASSERT_GE(told.size(), 10u);
  EXPECT_GT(told.back().safe, 9'000) << "a second is lost at most";
  Step before = 0;
  for (const auto& [safe, on_disk] : told) {
    EXPECT_GE(safe, before);
    EXPECT_LE(safe - before, 1'000);
    // Others forget what is safe: no more than what is passed over when the file is gone on with.
    EXPECT_EQ(safe, on_disk - 1);
    before = safe;
  }
}

INSTANTIATE_TEST_SUITE_P(Log, SafeSteps, testing::Values<Step>(-100, 0, 1, 50, 150),
                         [](const auto& ahead) { return "Ahead" + std::to_string(ahead.index); });

}  // namespace
}  // namespace rodeira::nodes
