// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/stepped_run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "common/core/base/assert.hpp"
#include "common/runtime/lockstep/in_process_parts.hpp"
#include "common/runtime/lockstep/life.hpp"

namespace rodeira::lockstep {

class SteppedRun::DirectBus final : public Bus {
 public:
  explicit DirectBus(SteppedRun& run) : run_(run) {}
  base::Status Publish(const Sample& sample) override { return run_.Route(sample); }
  void SendNack(const Gap&) override {}  // nothing is lost here
  void Tell(const Report& report) override { run_.Hear(report); }

 private:
  SteppedRun& run_;
};

SteppedRun::SteppedRun(const Roster& roster, const std::vector<Node*>& nodes, Settings settings)
    : roster_(roster),
      nodes_(nodes),
      settings_(std::move(settings)),
      clock_(roster, std::nullopt),
      consumers_(ConsumersOf(roster)),
      bus_(std::make_unique<DirectBus>(*this)),
      first_(nodes.size()) {
  RODEIRA_ASSERT(nodes.size() == roster.nodes().size());
  RODEIRA_ASSERT(settings_.resume.empty() || settings_.resume.size() == nodes.size());
  ReportServices(roster, clock_);
  for (NodeIndex n = 0; n < nodes.size(); ++n) {
    mailboxes_.push_back(std::make_unique<Mailbox>(roster, n));
    over_.push_back(nodes[n] == nullptr);
    Runner::Settings one;
    if (!settings_.resume.empty()) one.resume = settings_.resume[n];
    runners_.push_back(nodes[n] == nullptr
                           ? nullptr
                           : std::make_unique<Runner>(roster, n, *nodes[n], *bus_, *mailboxes_[n], std::move(one)));
  }
}

SteppedRun::~SteppedRun() { Abort("the run was given up"); }

base::Status SteppedRun::Start() { return Advance(); }

std::vector<Snapshot> SteppedRun::Beginning() const {
  RODEIRA_ASSERT(limit_ < 0 && clock_.all_ready());
  std::vector<Snapshot> all(nodes_.size());
  for (NodeIndex n = 0; n < nodes_.size(); ++n) {
    all[n].node = n;
    all[n].has_state = nodes_[n] != nullptr && nodes_[n]->can_save();
    all[n].samples = first_[n];
    if (nodes_[n] == nullptr) continue;
    const Report report = runners_[n]->report();
    all[n].steps = report.steps;
    all[n].digest = report.digest;
    if (!all[n].has_state) continue;
    base::StateWriter out;
    nodes_[n]->Save(out);
    all[n].state = out.bytes();
  }
  return all;
}

base::Status SteppedRun::RunThrough(Step step) {
  RODEIRA_ASSERT(step >= limit_ && !ended_);
  if (limit_ < 0) first_.assign(nodes_.size(), {});
  limit_ = step;
  return Advance();
}

base::Status SteppedRun::Finish() {
  RODEIRA_ASSERT(!ended_);
  clock_.Stop();  // without a step: aborts
  const base::Status status = Advance();
  ended_ = true;
  return status;
}

void SteppedRun::Abort(const std::string& reason) {
  if (ended_) return;
  ended_ = true;
  clock_.Abort(reason);
  do {
    SendGrant();
  } while (AdvanceAll());
}

// Until no node can go on, which is where all have come as far as the caller has asked, or at the end.
base::Status SteppedRun::Advance() {
  bool granted = true;
  while (fault_.ok() && (AdvanceAll() || granted)) {
    clock_.Update(limit_);
    granted = SendGrant();
  }
  if (!fault_.ok()) {
    const base::Status fault = fault_;
    Abort(fault.error().Text());
    return fault;
  }
  RODEIRA_ASSERT(clock_.grant().final ? clock_.all_finished() : clock_.slowest_progress() > limit_);
  return {};
}

// True where one did.
bool SteppedRun::AdvanceAll() {
  bool any = false;
  for (NodeIndex n = 0; n < runners_.size(); ++n) {
    while (!over_[n]) {
      const Runner::Outcome outcome = runners_[n]->Advance(std::chrono::milliseconds(0));
      if (outcome == Runner::Outcome::kBlocked) break;
      any = true;
      over_[n] = outcome != Runner::Outcome::kWorking;
    }
  }
  return any;
}

bool SteppedRun::SendGrant() {
  const Grant& grant = clock_.grant();
  if (grant.through == sent_.through && grant.final == sent_.final && grant.abort == sent_.abort) return false;
  sent_ = grant;
  for (auto& mailbox : mailboxes_) mailbox->DeliverGrant(sent_);
  return true;
}

base::Status SteppedRun::Route(const Sample& sample) {
  const NodeIndex from = roster_.source(sample.source()).node;
  if (roster_.node(from).snapshots != sample.source()) {
    if (limit_ < 0) first_[from].push_back(sample);
    if (settings_.on_sample) settings_.on_sample(sample);
  }
  for (const NodeIndex n : consumers_[sample.source()]) {
    if (auto status = mailboxes_[n]->Deliver(sample); !status) return status;
  }
  return {};
}

void SteppedRun::Hear(const Report& report) {
  if (IsFault(report.phase) && fault_.ok()) {
    const std::string what =
        fmt::format("node '{}' failed at step {}: {}", roster_.node(report.node).name, report.progress, report.message);
    fault_ = report.phase == Phase::kRefused ? base::WrongInput("run.refused", what) : base::Failed("run.failed", what);
  }
  if (auto status = clock_.Take(report); !status && fault_.ok()) fault_ = status;
}

base::Digest SteppedRun::digest() const {
  base::Digest digest = roster_.hash();
  for (NodeIndex n = 0; n < runners_.size(); ++n)
    digest = base::Combine(digest, runners_[n] == nullptr ? base::Digest{0} : runners_[n]->report().digest);
  return digest;
}

}  // namespace rodeira::lockstep
