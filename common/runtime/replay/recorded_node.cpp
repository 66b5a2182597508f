// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/replay/recorded_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>

namespace rodeira::replay {
namespace {

class RecordedNode final : public lockstep::Node {
 public:
  RecordedNode(const RecordedRun& run, lockstep::NodeIndex node, lockstep::Step from)
      : run_(run),
        outputs_(run.roster().node(node).outputs),
        stream_(run.Samples(from)),
        waiting_(outputs_.size()),
        last_(outputs_.size()) {}

  base::Status Initialise(lockstep::Outbox& outbox) override { return PutValidAt(0, outbox); }
  base::Status Step(const lockstep::StepInfo& step, const lockstep::Inbox&, lockstep::Outbox& outbox) override {
    return PutValidAt(step.output_valid, outbox);
  }
  void Save(base::StateWriter&) const override {}
  void Restore(base::StateReader&) override {}

 private:
  base::Status PutValidAt(lockstep::Step valid, lockstep::Outbox& outbox) {
    for (std::size_t i = 0; i < outputs_.size(); ++i) {
      while (!over_ && (waiting_[i].empty() || waiting_[i].back().valid() < valid)) {
        if (auto status = ReadOne(); !status) return status;
      }
      while (!waiting_[i].empty() && waiting_[i].front().valid() <= valid) {
        last_[i] = *waiting_[i].front().payload;
        waiting_[i].pop_front();
      }
      if (last_[i].empty()) {
        return base::WrongInput(
            "recording.sample_missing",
            fmt::format("no sample of {} valid at step {} is recorded", run_.roster().SourceName(outputs_[i]), valid),
            run_.path().string());
      }
      outbox.Put(run_.roster().source(outputs_[i]).topic, last_[i]);
    }
    return {};
  }
  base::Status ReadOne() {
    auto sample = stream_.Next();
    if (!sample) return sample.error();
    if (!sample.value()) {
      over_ = true;
      return {};
    }
    const auto output = std::find(outputs_.begin(), outputs_.end(), sample.value()->source());
    if (output != outputs_.end())
      waiting_[static_cast<std::size_t>(output - outputs_.begin())].push_back(std::move(*sample.value()));
    return {};
  }

  const RecordedRun& run_;
  std::vector<lockstep::SourceIndex> outputs_;
  SampleStream stream_;
  std::vector<std::deque<lockstep::Sample>> waiting_;  // of each output
  std::vector<base::Bytes> last_;
  bool over_ = false;
};

class NullSink final : public lockstep::Node {
 public:
  base::Status Initialise(lockstep::Outbox&) override { return {}; }
  base::Status Step(const lockstep::StepInfo&, const lockstep::Inbox&, lockstep::Outbox&) override { return {}; }
  bool runs_inline() const override { return true; }
  void Save(base::StateWriter&) const override {}
  void Restore(base::StateReader&) override {}
};

}  // namespace

std::unique_ptr<lockstep::Node> MakeRecordedNode(const RecordedRun& run, lockstep::NodeIndex node,
                                                 lockstep::Step from) {
  return std::make_unique<RecordedNode>(run, node, from);
}

std::unique_ptr<lockstep::Node> MakeNullSink() { return std::make_unique<NullSink>(); }

}  // namespace rodeira::replay
