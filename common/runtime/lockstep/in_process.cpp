// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/in_process.hpp"

#include <fmt/format.h>

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

#include "common/core/base/log.hpp"
#include "common/runtime/lockstep/in_process_parts.hpp"
#include "common/runtime/lockstep/life.hpp"
#include "common/runtime/lockstep/mailbox.hpp"
#include "common/runtime/lockstep/pump.hpp"

namespace rodeira::lockstep {
namespace {

using namespace std::chrono_literals;

class ThreadedRun {
 public:
  ThreadedRun(const Roster& roster, const std::vector<Node*>& nodes, const InProcessSettings& settings)
      : roster_(roster),
        nodes_(nodes),
        settings_(settings),
        clock_(roster, settings.last_step, settings.first_step),
        controller_(clock_, Pacer(roster.base_step_ns(), settings.pace, settings.first_step)),
        consumers_(ConsumersOf(roster)) {
    ReportServices(roster, clock_);
    for (NodeIndex n = 0; n < nodes.size(); ++n) {
      mailboxes_.push_back(std::make_unique<Mailbox>(roster, n));
      if (!settings.resume.empty()) mailboxes_.back()->StartAt(settings.first_step);
      buses_.push_back(nodes[n] == nullptr ? nullptr : std::make_unique<ThreadBus>(*this));
    }
    for (NodeIndex n = 0; n < nodes.size(); ++n) {
      runners_.push_back(nodes[n] == nullptr ? nullptr
                                             : std::make_unique<Runner>(roster, n, *nodes[n], *buses_[n],
                                                                        *mailboxes_[n], RunnerSettings(settings, n)));
    }
  }

  RunOutcome Run() {
    std::vector<std::thread> threads;
    for (NodeIndex n = 0; n < runners_.size(); ++n) {
      if (runners_[n] == nullptr) continue;
      try {
        threads.emplace_back([this, n] { RunNode(n); });
      } catch (const std::system_error& error) {
        const std::lock_guard lock(mutex_);
        fault_ =
            fmt::format("no thread can be started for node '{}': {}", roster_.node(n).name, error.code().message());
        controller_.Abort(fault_, ReadWall());
        break;
      }
    }
    std::unique_lock lock(mutex_);
    while (!Over()) {
      const Wall now = ReadWall();
      DoCommands(now);
      (void)controller_.Update(now);
      if (const std::string warning = controller_.TakeWarning(); !warning.empty())
        base::Log(base::LogLevel::kWarning, "", warning);
      if (settings_.stop_requested && settings_.stop_requested()) controller_.Stop(now);
      news_ = false;
      SendNews(lock);
      if (clock_.grant().final && clock_.all_sources_finished()) controller_.CloseLog(now);
      FlushLog(now);
      if (settings_.on_progress) settings_.on_progress(clock_);
      const auto due = std::chrono::nanoseconds(controller_.NextDueIn(now));
      woken_.wait_for(lock, due > 0ns ? std::min<std::chrono::nanoseconds>(due, 20ms) : 20ms, [&] { return news_; });
    }
    SendGrant(lock, clock_.grant());
    FlushLog(ReadWall());
    lock.unlock();
    for (std::thread& thread : threads) thread.join();
    RunOutcome outcome = OutcomeOf(clock_, fault_);
    outcome.slipped_ns = controller_.pacer().slipped_ns();
    outcome.paused_ns = controller_.pacer().PausedNs(ReadWall().monotonic_ns);
    outcome.lateness = controller_.pacer().lateness();
    return outcome;
  }

 private:
  void RunNode(NodeIndex n) {
    if (nodes_[n]->runs_inline()) {
      RunInline(*runners_[n], *mailboxes_[n], {});
    } else {
      runners_[n]->Run();
    }
  }
  struct ThreadBus final : Bus {
    explicit ThreadBus(ThreadedRun& owner) : run(owner) {}
    base::Status Publish(const Sample& sample) override { return run.Route(sample); }
    void SendNack(const Gap&) override {}  // nothing is lost here
    void Tell(const Report& report) override { run.Hear(report); }
    void Keep(const Snapshot& snapshot) override {
      const std::lock_guard lock(run.trace_mutex_);
      if (run.settings_.on_snapshot) run.settings_.on_snapshot(snapshot);
    }
    ThreadedRun& run;
  };

  base::Status Route(const Sample& sample) {
    if (settings_.on_sample) {
      const std::lock_guard lock(trace_mutex_);
      settings_.on_sample(sample);
    }
    for (const NodeIndex n : consumers_[sample.source()]) {
      if (auto status = mailboxes_[n]->Deliver(sample); !status) return status;
    }
    return {};
  }
  void Hear(const Report& report) {
    const std::lock_guard lock(mutex_);
    if (IsFault(report.phase) && fault_.empty()) {
      fault_ = fmt::format("node '{}' failed at step {}: {}", roster_.node(report.node).name, report.progress,
                           report.message);
      controller_.Abort(fault_, ReadWall());
    }
    if (auto status = clock_.Take(report); !status && fault_.empty()) {
      fault_ = status.error().Text();
      controller_.Abort(fault_, ReadWall());
    }
    news_ = true;
    woken_.notify_all();
  }
  void DoCommands(const Wall& now) {
    while (settings_.next_command) {
      const auto asked = settings_.next_command();
      if (!asked) return;
      asked->answer(controller_.Do(asked->command, now));
    }
  }
  void FlushLog(const Wall& now) {
    const auto batch = controller_.log().Take(now.monotonic_ns);  // taken even where it is not read: it would only grow
    if (batch && settings_.on_log) settings_.on_log(*batch);
  }
  void SendNews(std::unique_lock<std::mutex>& lock) {
    const Grant& grant = clock_.grant();
    if (grant.through == sent_.through && grant.final == sent_.final) return;
    sent_ = grant;
    SendGrant(lock, sent_);
  }
  bool Over() const { return clock_.grant().abort || clock_.all_finished(); }
  void SendGrant(std::unique_lock<std::mutex>& lock, const Grant& grant) {
    const Grant copy = grant;
    lock.unlock();  // a mailbox's lock is never taken under ours: a node reports while it holds neither
    for (auto& mailbox : mailboxes_) mailbox->DeliverGrant(copy);
    lock.lock();
  }

  const Roster& roster_;
  const std::vector<Node*>& nodes_;
  const InProcessSettings& settings_;
  Clock clock_;
  RunController controller_;
  std::vector<std::vector<NodeIndex>> consumers_;
  std::vector<std::unique_ptr<Mailbox>> mailboxes_;
  std::vector<std::unique_ptr<ThreadBus>> buses_;
  std::vector<std::unique_ptr<Runner>> runners_;
  std::mutex mutex_;
  std::mutex trace_mutex_;
  std::condition_variable woken_;
  bool news_ = false;
  Grant sent_;
  std::string fault_;
};

}  // namespace

RunOutcome RunThreaded(const Roster& roster, const std::vector<Node*>& nodes, const InProcessSettings& settings) {
  RODEIRA_ASSERT(nodes.size() == roster.nodes().size());
  return ThreadedRun(roster, nodes, settings).Run();
}

}  // namespace rodeira::lockstep
