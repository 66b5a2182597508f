#include "common/lockstep/in_process.hpp"

#include <fmt/format.h>

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

#include "common/base/random.hpp"
#include "common/lockstep/kept_samples.hpp"
#include "common/lockstep/mailbox.hpp"
#include "common/lockstep/pump.hpp"
#include "common/lockstep/runner.hpp"

namespace rodeira::lockstep {
namespace {

using namespace std::chrono_literals;

// Services take no part in the lockstep: for the clock they are ready and finished from the start.
void ReportServices(const Roster& roster, Clock& clock) {
  for (NodeIndex n = 0; n < roster.nodes().size(); ++n) {
    if (roster.node(n).role != Role::kService) continue;
    Report report;
    report.node = n;
    report.phase = Phase::kFinished;
    RODEIRA_ASSERT(clock.Take(report).ok());
  }
}

Wall ReadWall() {
  return {std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count(),
          std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count()};
}

std::vector<std::vector<NodeIndex>> ConsumersOf(const Roster& roster) {
  std::vector<std::vector<NodeIndex>> consumers(roster.sources().size());
  for (NodeIndex n = 0; n < roster.nodes().size(); ++n) {
    for (const Port& port : roster.node(n).inputs) {
      for (const SourceIndex source : port.sources) consumers[source].push_back(n);
    }
  }
  return consumers;
}

Runner::Settings RunnerSettings(const InProcessSettings& settings, NodeIndex n) {
  Runner::Settings out;
  out.snapshot_every = settings.snapshot_every;
  if (!settings.resume.empty()) out.resume = settings.resume[n];
  return out;
}

RunOutcome Outcome(const Clock& clock, const std::string& fault) {
  RunOutcome outcome;
  outcome.ok = fault.empty() && clock.all_finished() && !clock.grant().abort;
  outcome.fault = !fault.empty() ? fault : clock.grant().reason;
  outcome.last_step = clock.grant().through;
  outcome.digest = clock.RunDigest();
  for (NodeIndex n = 0; n < clock.roster().nodes().size(); ++n) outcome.reports.push_back(clock.report(n));
  return outcome;
}

// ---- threads ----

class ThreadedRun {
 public:
  ThreadedRun(const Roster& roster, const std::vector<Node*>& nodes, const InProcessSettings& settings)
      : roster_(roster), nodes_(nodes), settings_(settings), clock_(roster, settings.last_step, settings.first_step),
        conductor_(clock_, Pacer(roster.base_step_ns(), settings.pace, settings.first_step)), consumers_(ConsumersOf(roster)) {
    ReportServices(roster, clock_);
    for (NodeIndex n = 0; n < nodes.size(); ++n) {
      mailboxes_.push_back(std::make_unique<Mailbox>(roster, n));
      buses_.push_back(nodes[n] == nullptr ? nullptr : std::make_unique<ThreadBus>(*this));
    }
    for (NodeIndex n = 0; n < nodes.size(); ++n) {
      runners_.push_back(nodes[n] == nullptr ? nullptr
                                             : std::make_unique<Runner>(roster, n, *nodes[n], *buses_[n], *mailboxes_[n], RunnerSettings(settings, n)));
    }
  }

  RunOutcome Run() {
    std::vector<std::thread> threads;
    for (NodeIndex n = 0; n < runners_.size(); ++n) {
      if (runners_[n] == nullptr) continue;
      threads.emplace_back([this, n] {
        if (nodes_[n]->is_brief()) {
          RunWhereMessagesArrive(*runners_[n], *mailboxes_[n], {});
        } else {
          runners_[n]->Run();
        }
      });
    }
    std::unique_lock lock(mutex_);
    while (!Over()) {
      const Wall now = ReadWall();
      DoCommands(now);
      (void)conductor_.Move(now);
      if (settings_.stop_requested && settings_.stop_requested()) conductor_.Stop(now);
      news_ = false;
      SendNews(lock);
      if (clock_.grant().final && clock_.all_sources_finished()) conductor_.CloseLog(now);
      FlushLog(now);
      if (settings_.on_progress) settings_.on_progress(clock_);
      const auto due = std::chrono::nanoseconds(conductor_.NextDueIn(now));
      woken_.wait_for(lock, due > 0ns ? std::min<std::chrono::nanoseconds>(due, 20ms) : 20ms, [&] { return news_; });
    }
    SendGrant(lock, clock_.grant());
    FlushLog(ReadWall());
    lock.unlock();
    for (std::thread& thread : threads) thread.join();
    RunOutcome outcome = Outcome(clock_, fault_);
    outcome.slipped_ns = conductor_.pacer().slipped_ns();
    outcome.paused_ns = conductor_.pacer().PausedNs(ReadWall().monotonic_ns);
    outcome.lateness = conductor_.pacer().lateness();
    return outcome;
  }

 private:
  struct ThreadBus final : Bus {
    explicit ThreadBus(ThreadedRun& owner) : run(owner) {}
    base::Status Publish(const Sample& sample) override { return run.Route(sample); }
    void Ask(const Gap&) override {}  // nothing is lost here
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
    if (report.phase == Phase::kFailed && fault_.empty()) {
      fault_ = fmt::format("node '{}' failed at step {}: {}", roster_.node(report.node).name, report.progress, report.message);
      conductor_.Abort(fault_, ReadWall());
    }
    if (auto status = clock_.Take(report); !status && fault_.empty()) {
      fault_ = status.error().Text();
      conductor_.Abort(fault_, ReadWall());
    }
    news_ = true;
    woken_.notify_all();
  }
  void DoCommands(const Wall& now) {
    while (settings_.next_command) {
      const auto asked = settings_.next_command();
      if (!asked) return;
      asked->answer(conductor_.Do(asked->command, now));
    }
  }
  void FlushLog(const Wall& now) {
    const auto batch = conductor_.log().Take(now.monotonic_ns);  // taken even where nobody reads it: it would only grow
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
  Conductor conductor_;
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

// ---- one thread, seeded ----

class ShuffledRun {
 public:
  ShuffledRun(const Roster& roster, const std::vector<Node*>& nodes, const InProcessSettings& settings, std::uint64_t seed)
      : roster_(roster), settings_(settings), seed_(seed), clock_(roster, settings.last_step, settings.first_step), consumers_(ConsumersOf(roster)) {
    ReportServices(roster, clock_);
    for (NodeIndex n = 0; n < nodes.size(); ++n) {
      mailboxes_.push_back(std::make_unique<Mailbox>(roster, n));
      buses_.push_back(std::make_unique<ShuffleBus>(*this, n));
      runners_.push_back(nodes[n] == nullptr ? nullptr
                                             : std::make_unique<Runner>(roster, n, *nodes[n], *buses_[n], *mailboxes_[n], RunnerSettings(settings, n)));
      over_.push_back(nodes[n] == nullptr);
    }
  }

  RunOutcome Run() {
    std::size_t idle = 0;
    const std::size_t patience = 5000 * runners_.size();
    while (fault_.empty() && !AllOver()) {
      const bool deliver = !in_flight_.empty() && Draw(3) != 0;
      const bool moved = deliver ? DeliverOne() : AdvanceOne();
      // A node that waits asks at each turn: without a bound the answers would bury the one message that it waits for.
      while (fault_.empty() && in_flight_.size() > 64) DeliverOne();
      idle = moved ? 0 : idle + 1;
      if (idle > patience) {
        fault_ = "deadlock: " + Standing();
      }
    }
    return Outcome(clock_, fault_);
  }

 private:
  struct Message {
    enum class Kind { kSample, kGrant, kReport, kAsk } kind;
    NodeIndex to = 0;
    Sample sample{};
    Grant grant{};
    Report report{};
    Gap gap{};
  };
  struct ShuffleBus final : Bus {
    ShuffleBus(ShuffledRun& owner, NodeIndex n) : run(owner), kept(run.roster_, n) {}
    base::Status Publish(const Sample& sample) override {
      if (run.settings_.on_sample) run.settings_.on_sample(sample);
      kept.Add(sample);
      Say(sample);
      return {};
    }
    void Say(const Sample& sample) {
      for (const NodeIndex n : run.consumers_[sample.source()]) run.in_flight_.push_back({.kind = Message::Kind::kSample, .to = n, .sample = sample});
    }
    void Ask(const Gap& gap) override {
      run.in_flight_.push_back({.kind = Message::Kind::kAsk, .to = run.roster_.source(gap.source).node, .gap = gap});
    }
    void Tell(const Report& report) override { run.in_flight_.push_back({.kind = Message::Kind::kReport, .report = report}); }
    void Keep(const Snapshot& snapshot) override {
      if (run.settings_.on_snapshot) run.settings_.on_snapshot(snapshot);
    }
    ShuffledRun& run;
    KeptSamples kept;
  };

  std::uint64_t Draw(std::uint64_t below) { return base::RandomBits({seed_, draws_++}) % below; }

  // Nobody has moved by that: who waits in vain may ask and be answered for ever.
  bool DeliverOne() {
    const std::size_t at = Draw(in_flight_.size());
    const Message message = in_flight_[at];
    if (Draw(8) != 0) {  // otherwise it stays in flight and arrives once more
      in_flight_[at] = in_flight_.back();
      in_flight_.pop_back();
    }
    const bool may_be_lost = message.kind == Message::Kind::kSample || message.kind == Message::Kind::kAsk;
    if (may_be_lost && base::RandomUniform({seed_, draws_++}) < settings_.loss) return false;
    switch (message.kind) {
      case Message::Kind::kSample:
        if (auto status = mailboxes_[message.to]->Deliver(message.sample); !status) fault_ = status.error().Text();
        break;
      case Message::Kind::kGrant:
        mailboxes_[message.to]->DeliverGrant(message.grant);
        buses_[message.to]->kept.Granted(message.grant);
        break;
      case Message::Kind::kAsk:
        for (const Sample& sample : buses_[message.to]->kept.From(message.gap)) buses_[message.to]->Say(sample);
        break;
      case Message::Kind::kReport: Hear(message.report); break;
    }
    return false;
  }
  void Hear(const Report& report) {
    if (report.phase == Phase::kFailed) fault_ = fmt::format("node '{}' failed: {}", roster_.node(report.node).name, report.message);
    if (auto status = clock_.Take(report); !status) fault_ = status.error().Text();
    const Step before = clock_.grant().through;
    const Grant grant = clock_.Update(clock_.window_limit());
    if (grant.through == before) return;
    for (NodeIndex n = 0; n < mailboxes_.size(); ++n) in_flight_.push_back({.kind = Message::Kind::kGrant, .to = n, .grant = grant});
  }
  bool AdvanceOne() {
    const std::size_t n = Draw(runners_.size());
    if (over_[n]) return false;
    const Runner::Outcome outcome = runners_[n]->Advance(std::chrono::milliseconds(0));
    if (outcome == Runner::Outcome::kBlocked) {
      runners_[n]->AskAgain();
      return false;
    }
    over_[n] = outcome != Runner::Outcome::kWorking;
    return true;
  }
  bool AllOver() const {
    for (const bool over : over_) {
      if (!over) return false;
    }
    return in_flight_.empty();
  }
  std::string Standing() const {
    std::string text;
    for (NodeIndex n = 0; n < runners_.size(); ++n) {
      if (runners_[n] == nullptr) continue;
      const Report report = runners_[n]->report();
      text += fmt::format("{} at {} ({}); ", roster_.node(n).name, report.progress, PhaseName(report.phase));
    }
    return text + fmt::format("granted {}", clock_.grant().through);
  }

  const Roster& roster_;
  const InProcessSettings& settings_;
  std::uint64_t seed_;
  std::uint64_t draws_ = 0;
  Clock clock_;
  std::vector<std::vector<NodeIndex>> consumers_;
  std::vector<std::unique_ptr<Mailbox>> mailboxes_;
  std::vector<std::unique_ptr<ShuffleBus>> buses_;
  std::vector<std::unique_ptr<Runner>> runners_;
  std::vector<bool> over_;
  std::vector<Message> in_flight_;
  std::string fault_;
};

}  // namespace

RunOutcome RunThreaded(const Roster& roster, const std::vector<Node*>& nodes, const InProcessSettings& settings) {
  RODEIRA_ASSERT(nodes.size() == roster.nodes().size());
  return ThreadedRun(roster, nodes, settings).Run();
}

RunOutcome RunShuffled(const Roster& roster, const std::vector<Node*>& nodes, const InProcessSettings& settings, std::uint64_t seed) {
  RODEIRA_ASSERT(nodes.size() == roster.nodes().size());
  return ShuffledRun(roster, nodes, settings, seed).Run();
}

}  // namespace rodeira::lockstep
