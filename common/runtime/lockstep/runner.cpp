// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/runner.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/core/base/assert.hpp"

namespace rodeira::lockstep {
namespace {

using WallClock = std::chrono::steady_clock;

}  // namespace

Runner::Runner(const Roster& roster, NodeIndex index, Node& node, Bus& bus, Mailbox& mailbox, Settings settings)
    : roster_(roster),
      index_(index),
      spec_(roster.node(index)),
      node_(node),
      bus_(bus),
      mailbox_(mailbox),
      settings_(std::move(settings)),
      outbox_(roster, index),
      since_(WallClock::now()) {
  report_.node = index;
  report_.incarnation = settings_.incarnation;
  report_.cannot_save = !node.can_save();
}

Runner::Outcome Runner::Run() {
  auto patience = settings_.patience;
  for (;;) {
    const Outcome outcome = Advance(patience);
    if (outcome != Outcome::kWorking && outcome != Outcome::kBlocked) return outcome;
    if (outcome == Outcome::kBlocked) RequestRetransmission();
    patience = outcome == Outcome::kWorking ? settings_.patience : std::min(2 * patience, settings_.most_patience);
  }
}

Runner::Outcome Runner::Advance(std::chrono::milliseconds limit) {
  switch (stage_) {
    case Stage::kBegin:
      return Begin();
    case Stage::kInputs:
      return AwaitInputs(limit);
    case Stage::kStepping:
      return Activate(limit);
    case Stage::kEnding:
      return End(limit);
    case Stage::kOver:
      break;
  }
  RODEIRA_ASSERT(false && "a node is advanced after its end");
}

Runner::Outcome Runner::Begin() {
  TellReport();
  std::vector<Sample> first;
  if (settings_.resume) {
    const Snapshot& snapshot = *settings_.resume;
    if (snapshot.has_state) {
      if (!node_.can_save())
        return Fail(base::WrongInput("run.cannot_restore",
                                     "its snapshot holds a state, which this node can neither save nor take"));
      base::StateReader in(snapshot.state);
      node_.Restore(in);
      if (auto status = in.Finish(); !status) return Fail(status.error());
    }
    next_ = CeilTo(snapshot.at, spec_.period);
    first = snapshot.samples;
    for (Sample& sample : first) {
      base::Bytes payload = *sample.payload;
      sample.header.incarnation = settings_.incarnation;
      sample.header.Write(payload);
      sample.payload = std::make_shared<const base::Bytes>(std::move(payload));
    }
    {
      const std::lock_guard lock(report_mutex_);
      report_.steps = snapshot.steps;
      report_.digest = snapshot.digest;
    }
    mailbox_.StartAt(snapshot.at);
  } else if (settings_.sink_from > 0) {
    RODEIRA_ASSERT(spec_.is_sink());
    if (auto status = node_.Initialise(outbox_); !status) return Fail(status.error());
    next_ = CeilTo(settings_.sink_from, spec_.period);
    {
      const std::lock_guard lock(report_mutex_);
      report_.steps = static_cast<std::uint64_t>(next_ / spec_.period);
    }
    mailbox_.StartAt(next_);
  } else {
    if (auto status = node_.Initialise(outbox_); !status) return Fail(status.error());
    const base::Digest state = StateDigest();
    for (const Sample& sample : outbox_.Take(0, settings_.incarnation, state)) {
      // Samples valid at P … D - P repeat the initial one (law L1).
      for (Step valid = 0; valid < spec_.delay; valid += spec_.period) {
        base::Bytes payload = *sample.payload;
        SampleHeader header = sample.header;
        header.step = valid;
        header.time_ns = valid * roster_.base_step_ns();
        header.Write(payload);
        first.push_back({header, std::make_shared<const base::Bytes>(std::move(payload))});
        const std::lock_guard lock(report_mutex_);
        report_.digest = base::Combine(report_.digest, PayloadDigest(*first.back().payload));
      }
    }
    std::stable_sort(first.begin(), first.end(),
                     [](const Sample& a, const Sample& b) { return a.valid() < b.valid(); });
  }
  if (auto status = PublishAll(first); !status) return Fail(status.error());
  // The first snapshot is, like every first sample, there before any node is ready.
  begun_at_ = settings_.resume ? settings_.resume->at : next_;
  if (spec_.snapshots && begun_at_ % roster_.source(*spec_.snapshots).period == 0) {
    if (auto status = PublishSnapshot(SnapshotAt(begun_at_)); !status) return Fail(status.error());
  }
  stage_ = Stage::kInputs;
  return Outcome::kWorking;
}

Runner::Outcome Runner::AwaitInputs(std::chrono::milliseconds limit) {
  // A recorder that begins again beyond the granted time is ready at once: the snapshots that are valid there are taken
  // only in activations that are granted once all are ready.
  const bool is_ahead = settings_.sink_from > 0 && !mailbox_.IsGranted(begun_at_);
  switch (is_ahead ? Mailbox::Woken::kReady : mailbox_.WaitForInputs(begun_at_, limit)) {
    case Mailbox::Woken::kReady: {
      const std::lock_guard lock(report_mutex_);
      report_.progress = settled_ = next_;
    }
      Note(LifeEvent::kInputsComplete, Waiting::kGrant);
      TellReport();
      stage_ = Stage::kStepping;
      return Outcome::kWorking;
    case Mailbox::Woken::kAborted:
      return FinishAborted();
    default:
      break;
  }
  NoteWaiting(next_);
  return Outcome::kBlocked;
}

// A step counts as progress only when the node's own threads have done what it gave to them: a restarted node begins
// behind the progress that was told.
base::Status Runner::FlushStep() {
  if (settled_ == next_) return {};
  Note(LifeEvent::kActivated, Waiting::kOutput);
  if (auto status = node_.Flush(); !status) return status;
  settled_ = next_;
  const std::lock_guard lock(report_mutex_);
  report_.progress = next_;
  report_.waiting = Waiting::kGrant;  // until it is known that something else is missing
  since_ = WallClock::now();
  return {};
}

Runner::Outcome Runner::Activate(std::chrono::milliseconds limit) {
  // Progress is told each quarter window, and before blocking on the grant (law L2): so the clock always knows enough
  // to grant the slowest node's next activation, and no more is ever said.
  if (auto status = FlushStep(); !status) return Fail(status.error());
  const bool granted = mailbox_.IsGranted(next_);
  if (told_ < next_ && (!granted || next_ - told_ >= std::max<Step>(roster_.window() / 4, 1))) TellReport();
  switch (mailbox_.WaitForActivation(next_, limit)) {
    case Mailbox::Woken::kReady:
      break;
    case Mailbox::Woken::kFinal:
      stage_ = Stage::kEnding;
      return Outcome::kWorking;
    case Mailbox::Woken::kAborted:
      return FinishAborted();
    case Mailbox::Woken::kTimeout:
      NoteWaiting(next_);
      return Outcome::kBlocked;
  }
  Note(LifeEvent::kActivated, Waiting::kOutput);
  if (auto status = TakeSnapshotIfDue(next_); !status) return Fail(status.error());
  mailbox_.Open(next_, inbox_);
  const StepInfo info{next_, next_ * roster_.base_step_ns(), spec_.period,
                      static_cast<double>(spec_.period) * static_cast<double>(roster_.base_step_ns()) * 1e-9,
                      next_ + spec_.delay};
  Note(LifeEvent::kActivated, Waiting::kNothing);
  const auto begin = WallClock::now();
  if (begun_step_) intervals_.Add(std::chrono::nanoseconds(begin - *begun_step_).count());
  begun_step_ = begin;
  const base::Status status = node_.Step(info, inbox_, outbox_);
  const std::int64_t took_ns = std::chrono::nanoseconds(WallClock::now() - begin).count();
  // A server's answer may have failed to come: nothing of this counts. A sink asks no server, and what it has written
  // is written.
  if (!spec_.is_sink() && mailbox_.is_aborted()) return FinishAborted();
  if (!status) return Fail(status.error());
  outbox_.TakeInto(info.output_valid, settings_.incarnation, spec_.outputs.empty() ? 0 : StateDigest(), samples_);
  {
    const std::lock_guard lock(report_mutex_);
    for (const Sample& sample : samples_)
      report_.digest = base::Combine(report_.digest, PayloadDigest(*sample.payload));
    ++report_.steps;
    report_.busy_ns += took_ns;
    report_.worst_ns = std::max(report_.worst_ns, took_ns);
    next_ += spec_.period;
    report_.waiting = Waiting::kGrant;  // until it is known that something else is missing
    since_ = WallClock::now();
  }
  if (auto sent = PublishAll(samples_); !sent) return Fail(sent.error());
  mailbox_.Forget(next_);
  ForgetOwnSamples(next_);
  return Outcome::kWorking;
}

Runner::Outcome Runner::End(std::chrono::milliseconds limit) {
  const Step last = mailbox_.grant().through;
  if (spec_.is_sink()) {
    const auto woken = mailbox_.WaitForEventsThrough(last, limit);
    if (woken == Mailbox::Woken::kAborted) return FinishAborted();
    if (woken != Mailbox::Woken::kReady) return Outcome::kBlocked;
  }
  const Inbox rest = spec_.is_sink() ? mailbox_.OpenEvents(next_ - spec_.period, last) : Inbox();
  if (auto status = node_.Finish(rest, last, true); !status) return Fail(status.error());
  return EndWith(LifeEvent::kEndReached, {});
}

// By the clock's word, or because of an end of its own: a sink closes what it has open either way. A sink that may be
// started again keeps nothing beyond the grant: it goes on behind what it has, and no node is ahead of the grant.
Runner::Outcome Runner::FinishAborted() {
  const std::optional<EarlyEnd> early_end = mailbox_.early_end();
  const Step after = next_ - spec_.period;
  const Step complete = mailbox_.CompleteThrough(after);
  const Step last = early_end ? std::max(after, std::min(complete, mailbox_.grant().through)) : complete;
  const Inbox rest = spec_.is_sink() ? mailbox_.OpenEvents(after, last) : Inbox();
  const base::Status status = node_.Finish(rest, last, false);
  if (early_end) {
    return EndWith(early_end->event,
                   status.ok() ? early_end->reason : early_end->reason + "; " + status.error().Text());
  }
  return status.ok() ? EndWith(LifeEvent::kRunAborted, {}) : Fail(status.error());
}

Runner::Outcome Runner::Fail(const base::Error& error) {
  return EndWith(error.exit_status() == 2 ? LifeEvent::kRefused : LifeEvent::kFailed, error.Text());
}

Runner::Outcome Runner::EndWith(LifeEvent event, std::string reason) {
  Note(event, Waiting::kNothing);
  Phase phase;
  {
    const std::lock_guard lock(report_mutex_);
    report_.message = std::move(reason);
    report_.median_interval_ns = intervals_.Quantile(0.5);
    report_.p99_interval_ns = intervals_.Quantile(0.99);
    phase = report_.phase;
  }
  TellReport();
  stage_ = Stage::kOver;
  if (phase == Phase::kFinished) return Outcome::kFinished;
  return phase == Phase::kAborted ? Outcome::kAborted : Outcome::kFailed;
}

base::Status Runner::PublishAll(std::vector<Sample>& samples) {
  for (Sample& sample : samples) {
    if (auto status = bus_.Publish(sample); !status) return status;
    own_.push_back(std::move(sample));
  }
  samples.clear();
  return {};
}

void Runner::RequestRetransmission() {
  std::vector<Gap> gaps;
  switch (stage_) {
    case Stage::kInputs:
      gaps = mailbox_.MissingInputs(begun_at_);
      break;
    case Stage::kStepping:
      if (mailbox_.IsGranted(next_)) gaps = mailbox_.Missing(next_);  // before that no sample is due
      break;
    case Stage::kEnding:
      gaps = mailbox_.MissingEvents(mailbox_.grant().through);
      break;
    default:
      break;
  }
  for (const Gap& gap : gaps) bus_.SendNack(gap);
}

// Of the state as it is, without samples.
Snapshot Runner::SnapshotAt(Step step) const {
  Snapshot snapshot{index_, step, {}, {}, report_.steps, report_.digest, node_.can_save()};
  if (!snapshot.has_state) return snapshot;
  base::StateWriter out;
  node_.Save(out);
  snapshot.state = out.bytes();
  return snapshot;
}

base::Status Runner::PublishSnapshot(const Snapshot& snapshot) {
  return bus_.Publish(snapshot.ToSample(roster_, settings_.incarnation));
}

base::Status Runner::TakeSnapshotIfDue(Step step) {
  const bool publish = spec_.snapshots && step > begun_at_ && step % roster_.source(*spec_.snapshots).period == 0;
  Step at = settings_.snapshot_every > 0 ? FloorTo(step, settings_.snapshot_every) : 0;
  const bool keep = at > step - spec_.period && at != 0;  // one lies between the last activation and this one
  if (!publish && !keep) return {};
  Snapshot snapshot = SnapshotAt(step);
  if (publish) {
    if (auto status = PublishSnapshot(snapshot); !status) return status;
  }
  if (!keep) return {};
  snapshot.at = at;
  for (const Sample& sample : own_) {
    if (sample.valid() >= roster_.OldestNeeded(sample.source(), at)) snapshot.samples.push_back(sample);
  }
  bus_.Keep(snapshot);
  return {};
}

void Runner::ForgetOwnSamples(Step step) {
  const Step reference = std::max<Step>(step - spec_.period, 0);
  while (!own_.empty() && own_.front().valid() < roster_.OldestNeeded(own_.front().source(), reference))
    own_.pop_front();
}

base::Digest Runner::StateDigest() {
  state_without_names_.Clear();
  node_.Save(state_without_names_);
  return state_without_names_.digest();
}

void Runner::Note(LifeEvent event, Waiting waiting) {
  const std::lock_guard lock(report_mutex_);
  report_.phase = NextPhase(report_.phase, event);
  if (report_.waiting != waiting || waiting == Waiting::kNothing) since_ = WallClock::now();
  report_.waiting = waiting;
}

void Runner::NoteWaiting(Step step) {
  const auto missing = mailbox_.FirstMissing(step);
  const std::lock_guard lock(report_mutex_);
  const Waiting waiting = missing ? Waiting::kInputs : Waiting::kGrant;
  if (report_.waiting != waiting) since_ = WallClock::now();
  report_.waiting = waiting;
  report_.waiting_source = missing ? missing->source : 0;
}

void Runner::BeginServerCall() {
  const std::lock_guard lock(report_mutex_);
  report_.waiting = Waiting::kServer;
  since_ = WallClock::now();
  ++report_.server_calls;
}

void Runner::EndServerCall() {
  const std::lock_guard lock(report_mutex_);
  report_.waiting = Waiting::kNothing;
  since_ = WallClock::now();
}

Report Runner::report() const {
  const std::lock_guard lock(report_mutex_);
  Report report = report_;
  report.since_ms = std::chrono::duration_cast<std::chrono::milliseconds>(WallClock::now() - since_).count();
  return report;
}

void Runner::TellReport() {
  const Report now = report();
  told_ = now.progress;
  bus_.Tell(now);
}

}  // namespace rodeira::lockstep
