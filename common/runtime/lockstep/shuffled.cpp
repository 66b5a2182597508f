// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <utility>

#include "common/core/base/random.hpp"
#include "common/runtime/lockstep/archive.hpp"
#include "common/runtime/lockstep/in_process.hpp"
#include "common/runtime/lockstep/in_process_parts.hpp"
#include "common/runtime/lockstep/kept_samples.hpp"
#include "common/runtime/lockstep/life.hpp"
#include "common/runtime/lockstep/mailbox.hpp"
#include "common/runtime/lockstep/planned_losses.hpp"
#include "common/runtime/lockstep/sample_batches.hpp"

namespace rodeira::lockstep {
namespace {

constexpr std::size_t kMaxSampleBatch_bytes = 300;  // a few samples of a test's: some batches go before they are due

class ShuffledRun {
 public:
  ShuffledRun(const Roster& roster, const std::vector<Node*>& nodes, const InProcessSettings& settings,
              std::uint64_t seed, std::vector<PlannedLoss> losses)
      : roster_(roster),
        settings_(settings),
        seed_(seed),
        losses_(std::move(losses)),
        clock_(std::make_unique<Clock>(roster, settings.last_step, settings.first_step, settings.deaths.policies)),
        consumers_(ConsumersOf(roster)) {
    ReportServices(roster, *clock_);
    for (NodeIndex n = 0; n < nodes.size(); ++n) {
      mailboxes_.push_back(std::make_unique<Mailbox>(roster, n));
      if (!settings.resume.empty()) mailboxes_.back()->StartAt(settings.first_step);
      buses_.push_back(std::make_unique<ShuffleBus>(*this, n));
      runners_.push_back(nodes[n] == nullptr ? nullptr
                                             : std::make_unique<Runner>(roster, n, *nodes[n], *buses_[n],
                                                                        *mailboxes_[n], RunnerSettings(settings, n)));
      over_.push_back(nodes[n] == nullptr);
    }
    stopped_.resize(nodes.size());
    incarnations_.resize(nodes.size(), 0);
    dead_.resize(nodes.size());
  }

  RunOutcome Run() {
    std::size_t idle = 0;
    const std::size_t patience = 5000 * runners_.size();
    while (fault_.empty() && !AllOver()) {
      LoseAsPlanned();
      if (clocks_ > 0 && Draw(8) == 0) Repeat();
      if (settings_.deaths.share > 0.0 && base::RandomUniform({seed_, draws_++}) < settings_.deaths.share) KillOne();
      const bool deliver = !in_flight_.empty() && Draw(3) != 0;
      const bool moved = deliver ? DeliverOne() : AdvanceOne();
      // A node that waits asks at each turn: without a bound the answers would bury the one message that it waits for.
      while (fault_.empty() && in_flight_.size() > 64) DeliverOne();
      idle = moved ? 0 : idle + 1;
      if (idle > patience) {
        fault_ = "deadlock: " + DescribeState();
      }
    }
    RunOutcome outcome = OutcomeOf(*clock_, fault_);
    outcome.deaths = deaths_;
    outcome.clocks = clocks_;
    return outcome;
  }

 private:
  struct Message {
    enum class Kind { kSample, kSampleBatch, kGrant, kReport, kNack } kind;
    NodeIndex to = 0;
    Sample sample{};
    std::vector<Sample> batch{};
    Grant grant{};
    Report report{};
    Gap gap{};
  };
  struct ShuffleBus final : Bus {
    ShuffleBus(ShuffledRun& owner, NodeIndex n)
        : run(owner), node(n), kept(run.roster_, n), batches(run.roster_, n, kMaxSampleBatch_bytes) {
      const bool may_be_lost = run.settings_.deaths.share > 0.0 || !run.losses_.empty();
      if (may_be_lost && run.roster_.node(n).keeps_snapshots()) archive.emplace(run.roster_);
    }
    base::Status Publish(const Sample& sample) override {
      if (run.settings_.on_sample) run.settings_.on_sample(sample);
      kept.Add(sample);
      const Grant grant = run.mailboxes_[node]->grant();
      for (auto& batch : batches.Add(sample, grant.final ? grant.through : kNever)) {
        run.in_flight_.push_back(
            {.kind = Message::Kind::kSampleBatch, .to = batch.to, .batch = std::move(batch.samples)});
      }
      Say(sample, [&](NodeIndex n) { return !GetsSampleBatches(run.roster_, sample.source(), n); });
      return {};
    }
    template <class Receives>
    void Say(const Sample& sample, Receives receives) {
      for (const NodeIndex n : run.consumers_[sample.source()]) {
        if (receives(n)) run.in_flight_.push_back({.kind = Message::Kind::kSample, .to = n, .sample = sample});
      }
    }
    void SendNack(const Gap& gap) override {
      for (NodeIndex n = 0; n < run.buses_.size(); ++n) {
        const bool answers = n == run.roster_.source(gap.source).node || run.buses_[n]->archive;
        if (answers) run.in_flight_.push_back({.kind = Message::Kind::kNack, .to = n, .gap = gap});
      }
    }
    void Tell(const Report& report) override {
      Report said = report;
      const Grant grant = run.mailboxes_[node]->grant();
      said.granted = grant.through;
      said.granted_final = grant.final;
      const bool reads_its_file = run.runners_[node] == nullptr && run.Draw(2) == 0;
      if (archive) said.safe = reads_its_file ? kUnknown : run.settings_.deaths.safe(node);
      run.in_flight_.push_back({.kind = Message::Kind::kReport, .report = said});
    }
    void Answer(const Gap& gap) {
      const auto all_nodes = [](NodeIndex) { return true; };
      for (const Sample& sample : kept.From(gap)) Say(sample, all_nodes);
      if (!archive) return;
      for (const Sample& sample : archive->From(gap)) Say(sample, all_nodes);
    }
    void Keep(const Snapshot& snapshot) override {
      if (run.settings_.on_snapshot) run.settings_.on_snapshot(snapshot);
    }
    ShuffledRun& run;
    NodeIndex node;
    KeptSamples kept;
    SampleBatches batches;
    std::optional<Archive> archive;
  };

  std::uint64_t Draw(std::uint64_t below) { return base::RandomBits({seed_, draws_++}) % below; }

  // No node has moved by that: one that waits in vain may ask and be answered for ever.
  bool DeliverOne() {
    const std::size_t at = Draw(in_flight_.size());
    const Message message = in_flight_[at];
    const auto take_out = [&] {
      in_flight_[at] = in_flight_.back();
      in_flight_.pop_back();
    };
    if (message.kind != Message::Kind::kReport && (HasLeft(message.to) || stopped_[message.to])) {
      if (stopped_[message.to]) stopped_[message.to]->held.push_back(message);
      take_out();
      return false;
    }
    if (Draw(8) != 0) take_out();  // otherwise it stays in flight and arrives once more
    const bool may_be_lost = message.kind == Message::Kind::kSample || message.kind == Message::Kind::kSampleBatch ||
                             message.kind == Message::Kind::kNack;
    if (may_be_lost && base::RandomUniform({seed_, draws_++}) < settings_.loss) return false;
    switch (message.kind) {
      case Message::Kind::kSample:
        Deliver(message.to, message.sample);
        break;
      case Message::Kind::kSampleBatch:
        for (const Sample& sample : message.batch) Deliver(message.to, sample);
        break;
      case Message::Kind::kGrant:
        DeliverGrant(message);
        break;
      case Message::Kind::kNack:
        buses_[message.to]->Answer(message.gap);
        break;
      case Message::Kind::kReport:
        Hear(message.report);
        break;
    }
    return false;
  }
  void Deliver(NodeIndex to, const Sample& sample) {
    if (runners_[to] == nullptr) return;  // no node runs there
    if (auto& archive = buses_[to]->archive) {
      if (auto status = archive->Add(sample); !status) fault_ = status.error().Text();
    }
    if (auto status = mailboxes_[to]->Deliver(sample); !status) fault_ = status.error().Text();
  }
  void Hear(const Report& report) {
    if (clock_is_dead_ || report.incarnation < clock_->incarnation(report.node)) return;
    if (report.phase == Phase::kLost) return Replace(report.node, report.message);
    if (report.phase == Phase::kFailed || report.phase == Phase::kRefused)
      fault_ = fmt::format("node '{}' failed: {}", roster_.node(report.node).name, report.message);
    if (auto status = clock_->Take(report); !status) fault_ = status.error().Text();
    const Step before = clock_->grant().through;
    const Grant grant = clock_->Update(clock_->window_limit());
    if (grant.through == before) return;
    for (const auto& mailbox : mailboxes_) {
      if (mailbox->grant().through > before) fault_ = fmt::format("step {} is granted twice", before + 1);
    }
    for (NodeIndex n = 0; n < mailboxes_.size(); ++n) Grants(n);
  }
  void Grants(NodeIndex to) {
    in_flight_.push_back({.kind = Message::Kind::kGrant, .to = to, .grant = clock_->grant()});
  }
  // As in processes, once a clock was lost: a node says again where it stands, and the clock what it has granted.
  void Repeat() {
    const auto n = static_cast<NodeIndex>(Draw(runners_.size()));
    if (!stopped_[n] && !dead_[n] && roster_.node(n).role == Role::kStepped) {
      Report report;
      if (runners_[n] != nullptr) {
        report = runners_[n]->report();
      } else {
        report.node = n;
        report.incarnation = incarnations_[n];
      }
      buses_[n]->Tell(report);
    }
    if (!clock_is_dead_) Grants(n);
  }
  // What it has said arrives before the next clock begins, or never; what nodes said until then the next one has not
  // heard.
  void LoseClock(std::uint64_t until) {
    for (NodeIndex n = 0; n < runners_.size(); ++n) {
      if (settings_.deaths.policies[n] == Policy::kRestart) continue;
      fault_ = "the clock was killed";
      return;
    }
    if (clock_is_dead_) return;
    clock_is_dead_ = true;
    next_clock_ = until;
  }
  void StartClock() {
    const bool arrives = Draw(2) == 0;
    std::vector<Message> rest, grants;
    for (Message& message : in_flight_) {
      if (message.kind == Message::Kind::kReport) continue;
      (message.kind == Message::Kind::kGrant ? grants : rest).push_back(std::move(message));
    }
    in_flight_ = std::move(rest);
    for (Message& message : grants) {
      if (!arrives) continue;
      if (stopped_[message.to]) {
        stopped_[message.to]->held.push_back(std::move(message));
      } else {
        DeliverGrant(message);
      }
    }
    ++clocks_;
    clock_is_dead_ = false;
    clock_ = std::make_unique<Clock>(roster_, settings_.last_step, settings_.first_step, settings_.deaths.policies);
    clock_->Rebuild();
    ReportServices(roster_, *clock_);
    for (NodeIndex n = 0; n < dead_.size(); ++n) {
      if (dead_[n]) Replace(n, *std::exchange(dead_[n], std::nullopt));
    }
  }
  void DeliverGrant(const Message& message) {
    mailboxes_[message.to]->DeliverGrant(message.grant);
    buses_[message.to]->kept.Granted(message.grant);
    if (auto& archive = buses_[message.to]->archive) archive->Forget(message.grant.resume);
  }
  bool EndsInOrder() const { return !clock_is_dead_ && clock_->all_finished(); }
  bool MayBeLost(NodeIndex n) const {
    if (runners_[n] == nullptr || EndsInOrder()) return false;
    return !over_[n] || runners_[n]->report().phase == Phase::kFinished;
  }
  // Kills or terminates a random node; with it its mailbox, its kept samples and its unreported progress are lost.
  void KillOne() {
    const auto n = static_cast<NodeIndex>(Draw(runners_.size()));
    if (!MayBeLost(n)) return;
    if (base::RandomUniform({seed_, draws_++}) < settings_.deaths.terminated) {
      mailboxes_[n]->EndEarly({LifeEvent::kLost, "was told to end"});
    } else {
      Replace(n, "was killed");
    }
  }
  void LoseAsPlanned() {
    ++turn_;
    for (const PlannedLoss& loss : losses_) {
      if (loss.turn == turn_) HandleLoss(loss);
    }
    for (NodeIndex n = 0; n < stopped_.size(); ++n) {
      if (stopped_[n] && turn_ >= stopped_[n]->until) Continue(n);
    }
    for (NodeIndex n = 0; n < over_.size(); ++n) {
      const bool is_left = HasLeft(n) && runners_[n]->report().phase == Phase::kFinished;
      if (is_left && !EndsInOrder()) Replace(n, "was told to end");
    }
    if (clock_is_dead_ && turn_ >= next_clock_) StartClock();
  }
  void HandleLoss(const PlannedLoss& loss) {
    const NodeIndex n = loss.node;
    if (n == kClock) return LoseClock(turn_ + loss.lasts_turns);
    if (!MayBeLost(n)) return;
    if (loss.cause == LossCause::kKilled) return Replace(n, "was killed");
    if (loss.cause == LossCause::kTerminated) return mailboxes_[n]->EndEarly({LifeEvent::kLost, "was told to end"});
    if (!stopped_[n]) stopped_[n] = Stopped{turn_ + loss.lasts_turns, loss.is_found, {}};
  }
  void Continue(NodeIndex n) {
    Stopped stopped = std::move(*stopped_[n]);
    stopped_[n].reset();
    if (stopped.is_found) return Replace(n, "was stopped");
    // It reads what has come before it reports.
    for (Message& message : stopped.held) {
      if (message.kind == Message::Kind::kGrant) {
        DeliverGrant(message);
      } else {
        in_flight_.push_back(std::move(message));
      }
    }
  }
  void Replace(NodeIndex n, const std::string& reason) {
    stopped_[n].reset();
    if (clock_is_dead_) {  // the next one is told
      dead_[n] = reason;
      over_[n] = true;
      runners_[n].reset();
      return;
    }
    clock_->NoteIncarnation(n, incarnations_[n]);
    const auto decision = clock_->HandleLoss(n);
    if (decision.policy != Policy::kRestart) {
      fault_ = decision.why.empty() ? fmt::format("node '{}' {}", roster_.node(n).name, reason) : decision.why;
      return;
    }
    ++deaths_;
    incarnations_[n] = clock_->incarnation(n);
    over_[n] = false;
    runners_[n].reset();
    buses_[n] = std::make_unique<ShuffleBus>(*this, n);
    mailboxes_[n] = std::make_unique<Mailbox>(roster_, n);
  }
  // Once it finds what it begins with: its recorder may have died as well.
  bool Raise(NodeIndex n) {
    if (clock_is_dead_ || clock_->grant().resume == kUnknown) return false;
    const Grant grant = clock_->grant();
    Runner::Settings settings;
    settings.incarnation = incarnations_[n];
    const RosterNode& spec = roster_.node(n);
    if (!spec.keeps_snapshots()) {
      const Beginning beginning = BeginningOf(roster_, n, grant, -1);
      settings.sink_from = beginning.sink_from;
      if (beginning.snapshot > 0 && !FindSnapshot({*spec.snapshots, beginning.snapshot}, settings)) return false;
    }
    const auto remade = settings_.deaths.remake(n);
    if (spec.keeps_snapshots()) settings.sink_from = BeginningOf(roster_, n, grant, remade.has_through).sink_from;
    for (const Sample& sample : remade.tail) RODEIRA_ASSERT(buses_[n]->archive->Add(sample).ok());
    mailboxes_[n]->StartAt(settings.resume ? settings.resume->at : settings.sink_from);
    mailboxes_[n]->DeliverGrant(grant);
    runners_[n] = std::make_unique<Runner>(roster_, n, *remade.node, *buses_[n], *mailboxes_[n], settings);
    return true;
  }
  bool FindSnapshot(const Gap& gap, Runner::Settings& settings) const {
    for (const auto& bus : buses_) {
      if (!bus->archive) continue;
      const auto found = bus->archive->From(gap);
      if (found.empty() || found.front().valid() != gap.from) continue;
      settings.resume = Snapshot::FromSample(*found.front().payload).value();
      return true;
    }
    return false;
  }

  bool HasLeft(NodeIndex n) const {
    return over_[n] && runners_[n] != nullptr && MayLeave(runners_[n]->report().phase, mailboxes_[n]->grant());
  }
  bool AdvanceOne() {
    const std::size_t n = Draw(runners_.size());
    if (over_[n] || stopped_[n]) return false;
    if (runners_[n] == nullptr) return Raise(static_cast<NodeIndex>(n));
    const Runner::Outcome outcome = runners_[n]->Advance(std::chrono::milliseconds(0));
    if (outcome == Runner::Outcome::kBlocked) {
      runners_[n]->RequestRetransmission();
      return false;
    }
    over_[n] = outcome != Runner::Outcome::kWorking;
    return true;
  }
  bool AllOver() const {
    for (const bool over : over_) {
      if (!over) return false;
    }
    return in_flight_.empty() && !clock_is_dead_ && (clocks_ == 0 || clock_->all_finished());
  }
  std::string DescribeState() const {
    std::string text;
    for (NodeIndex n = 0; n < runners_.size(); ++n) {
      if (runners_[n] == nullptr) continue;  // a service, or dead
      const Report report = runners_[n]->report();
      text += fmt::format("{} at {} ({})", roster_.node(n).name, report.progress, PhaseName(report.phase));
      const bool starts = report.phase == Phase::kStarting;
      const auto missing =
          starts ? mailboxes_[n]->MissingInputs(clock_->grant().resume) : mailboxes_[n]->Missing(report.progress);
      if (!IsTerminal(report.phase) && !missing.empty())
        text += fmt::format(" lacks {} from {}", roster_.SourceName(missing.front().source), missing.front().from);
      text += "; ";
    }
    return text + fmt::format("granted {}", clock_->grant().through);
  }

  const Roster& roster_;
  const InProcessSettings& settings_;
  std::uint64_t seed_;
  const std::vector<PlannedLoss> losses_;
  std::uint64_t turn_ = 0;
  std::uint64_t draws_ = 0;
  int deaths_ = 0;
  std::unique_ptr<Clock> clock_;
  int clocks_ = 0;  // that took the place of another one
  bool clock_is_dead_ = false;
  std::uint64_t next_clock_ = 0;  // the turn at which it begins
  std::vector<std::vector<NodeIndex>> consumers_;
  std::vector<std::unique_ptr<Mailbox>> mailboxes_;
  std::vector<std::unique_ptr<ShuffleBus>> buses_;
  std::vector<std::unique_ptr<Runner>> runners_;
  std::vector<bool> over_;
  std::vector<std::uint32_t> incarnations_;       // that were started
  std::vector<std::optional<std::string>> dead_;  // how a node was lost; set until a clock has noticed
  // A node that is stopped: until when, whether it is lost then, and what has come for it.
  struct Stopped {
    std::uint64_t until = 0;
    bool is_found = true;
    std::vector<Message> held;
  };
  std::vector<std::optional<Stopped>> stopped_;
  std::vector<Message> in_flight_;
  std::string fault_;
};

}  // namespace

RunOutcome RunShuffled(const Roster& roster, const std::vector<Node*>& nodes, const InProcessSettings& settings,
                       std::uint64_t seed) {
  RODEIRA_ASSERT(nodes.size() == roster.nodes().size());
  return ShuffledRun(roster, nodes, settings, seed, {}).Run();
}

RunOutcome RunWithLosses(const Roster& roster, const std::vector<Node*>& nodes, const InProcessSettings& settings,
                         std::uint64_t seed, const std::vector<PlannedLoss>& losses) {
  RODEIRA_ASSERT(nodes.size() == roster.nodes().size());
  return ShuffledRun(roster, nodes, settings, seed, losses).Run();
}

std::string TextOf(const std::vector<PlannedLoss>& losses) {
  std::string text;
  for (const PlannedLoss& loss : losses) {
    const char* cause = loss.cause == LossCause::kKilled       ? "killed"
                        : loss.cause == LossCause::kTerminated ? "told to end"
                        : loss.is_found                        ? "stopped and found"
                                                               : "stopped for a while";
    const std::string part = loss.node == kClock ? "clock" : fmt::format("node {}", loss.node);
    text += fmt::format("{}{} {} at turn {}", text.empty() ? "" : ", ", part, cause, loss.turn);
  }
  return text;
}

}  // namespace rodeira::lockstep
