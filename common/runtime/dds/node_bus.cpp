// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/node_bus.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <utility>

#include "common/core/base/wait.hpp"
#include "common/runtime/dds/stop_signals.hpp"
#include "common/runtime/dds/wall_clock.hpp"
#include "common/runtime/launch/sample_difference.hpp"
#include "idl/topics.hpp"

namespace rodeira::dds {

namespace {

constexpr std::chrono::milliseconds kTimeToEnd{500};
constexpr std::chrono::milliseconds kShownWait{500};
constexpr std::chrono::milliseconds kTimeToRead{5};

std::int64_t NowMs() {
  return std::chrono::duration_cast<std::chrono::milliseconds>(WallClock::now().time_since_epoch()).count();
}

volatile std::sig_atomic_t g_terminated = 0;

void OnTerminate(int) {
  g_terminated = 1;
  EndProcessWithin(kEndWithoutSupervisor);
}

}  // namespace

void NodeBus::HandleSignals() {
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, OnTerminate);
  std::signal(SIGXFSZ, SIG_IGN);  // a file-size limit is an error to report, not the process' end
}

namespace topics = idl::topics;
using lockstep::LifeEvent;

NodeBus::NodeBus(const lockstep::Roster& roster, lockstep::Mailbox& mailbox, const Settings& settings)
    : roster_(roster),
      mailbox_(mailbox),
      settings_(settings),
      listens_(settings.incarnation == 0),
      batches_(roster, settings.node, settings.max_batch_bytes),
      clock_silence_(settings.clock_silence.count()),
      safe_(settings.keeps_all && settings.incarnation > 0 ? lockstep::kUnknown : -1) {
  last_.node = settings.node;
  last_.incarnation = settings.incarnation;
  retransmit_server_.emplace(roster, settings.node, settings.keeps_all, settings.most_answer_bytes,
                             [this](lockstep::NodeIndex asker, std::span<const lockstep::Sample> samples) {
                               if (asker != settings_.node)
                                 (void)answers_writer_->Write(EncodeSampleBatch(asker, samples));
                             });
}

base::Result<std::unique_ptr<NodeBus>> NodeBus::Open(Participant& participant, const lockstep::Roster& roster,
                                                     lockstep::Mailbox& mailbox, const Settings& settings) {
  std::unique_ptr<NodeBus> bus(new NodeBus(roster, mailbox, settings));
  if (auto status = bus->Connect(participant); !status) return status.error();
  bus->heartbeat_ = std::thread([raw = bus.get()] { raw->Heartbeat(); });
  return bus;
}

NodeBus::~NodeBus() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  woken_.notify_all();
  if (heartbeat_.joinable()) heartbeat_.join();
  readers_.clear();            // first: their callbacks use the rest
  retransmit_server_.reset();  // then: it uses the writers
}

base::Status NodeBus::Connect(Participant& participant) {
  const auto add_reader = [&](std::string_view topic, Delivery delivery, OnPayload on_payload) -> base::Status {
    auto reader = participant.MakeReader(topic, delivery, Noted(std::move(on_payload)));
    if (!reader) return reader.error();
    readers_.push_back(std::move(reader).value());
    return {};
  };
  outputs_ = roster_.node(settings_.node).outputs;
  if (const auto& snapshots = roster_.node(settings_.node).snapshots) outputs_.push_back(*snapshots);
  for (const lockstep::SourceIndex output : outputs_) {
    auto writer = participant.MakeWriter(roster_.source(output).topic, Delivery::kBestEffortRepeated);
    if (!writer) return writer.error();
    writers_.push_back(std::move(writer).value());
  }
  for (const lockstep::Port& port : roster_.node(settings_.node).inputs) {
    const std::string_view topic = port.topic;
    const auto in_batches = [&](lockstep::SourceIndex source) {
      return lockstep::GetsSampleBatches(roster_, source, settings_.node);
    };
    if (std::all_of(port.sources.begin(), port.sources.end(), in_batches)) continue;
    if (auto status = add_reader(topic, Delivery::kBestEffortRepeated,
                                 [this, topic](base::Bytes&& bytes) { OnSample(topic, std::move(bytes)); });
        !status)
      return status;
  }
  if (auto status = ConnectSampleBatches(participant); !status) return status;
  // Answers have a topic of their own, which no step is published on: two threads that write on a topic which their
  // process also reads can stop each other for good, each within a lock of Fast DDS that the other wants.
  auto answers = participant.MakeWriter(topics::kRetransmissions, Delivery::kBestEffortRepeated);
  if (!answers) return answers.error();
  answers_writer_ = std::move(answers).value();
  if (auto status = add_reader(topics::kRetransmissions, Delivery::kBestEffortRepeated,
                               [this](base::Bytes&& bytes) { OnAnswer(bytes); });
      !status)
    return status;
  if (!writers_.empty() || settings_.keeps_all) {
    if (auto status =
            add_reader(topics::kNack, Delivery::kBestEffortRepeated, [this](base::Bytes&& bytes) { OnAsk(bytes); });
        !status)
      return status;
  }
  auto questions = participant.MakeWriter(topics::kNack, Delivery::kBestEffortRepeated);
  if (!questions) return questions.error();
  nack_writer_ = std::move(questions).value();
  auto reports = participant.MakeWriter(topics::kReport, Delivery::kBestEffortRepeated);
  if (!reports) return reports.error();
  reports_ = std::move(reports).value();
  return add_reader(topics::kGrant, Delivery::kBestEffortRepeated,
                    [this](base::Bytes&& bytes) { OnGrant(std::move(bytes)); });
}

OnPayload NodeBus::Noted(OnPayload on_payload) {
  return [this, on_payload = std::move(on_payload)](base::Bytes&& bytes) {
    const Receiving note(*this);
    on_payload(std::move(bytes));
  };
}

// The nodes to which this node sends batches, and those for it.
base::Status NodeBus::ConnectSampleBatches(Participant& participant) {
  const auto topic_of = [&](lockstep::NodeIndex n) {
    return std::string(topics::kSampleBatches) + roster_.node(n).name;
  };
  for (const lockstep::NodeIndex n : batches_.Consumers()) {
    auto writer = participant.MakeWriter(topic_of(n), Delivery::kBestEffortRepeated);
    if (!writer) return writer.error();
    batch_writers_.emplace(n, std::move(writer).value());
  }
  const auto gets_batches = [&](const lockstep::Port& port) {
    return std::any_of(port.sources.begin(), port.sources.end(), [&](lockstep::SourceIndex source) {
      return lockstep::GetsSampleBatches(roster_, source, settings_.node);
    });
  };
  const auto& inputs = roster_.node(settings_.node).inputs;
  if (std::none_of(inputs.begin(), inputs.end(), gets_batches)) return {};
  auto reader = participant.MakeReader(topic_of(settings_.node), Delivery::kBestEffortRepeated,
                                       Noted([this](base::Bytes&& bytes) { OnSampleBatch(bytes); }));
  if (!reader) return reader.error();
  readers_.push_back(std::move(reader).value());
  return {};
}

base::Status NodeBus::Publish(const lockstep::Sample& sample) {
  const lockstep::Grant grant = mailbox_.grant();
  retransmit_server_->Keep(sample);
  for (const auto& batch : batches_.Add(sample, grant.final ? grant.through : lockstep::kNever)) {
    if (auto status = batch_writers_.at(batch.to)->Write(EncodeSampleBatch(batch.to, batch.samples)); !status)
      return status;
  }
  return Say(sample);  // also where every consumer gets batches: others may look on
}

base::Status NodeBus::Say(const lockstep::Sample& sample) { return WriterOf(sample.source()).Write(*sample.payload); }

Writer& NodeBus::WriterOf(lockstep::SourceIndex source) {
  const auto output = std::find(outputs_.begin(), outputs_.end(), source);
  RODEIRA_ASSERT(output != outputs_.end());
  return *writers_[static_cast<std::size_t>(output - outputs_.begin())];
}

void NodeBus::Ask(const lockstep::Gap& gap) {
  (void)nack_writer_->Write(
      EncodeNack(roster_.hash(), {settings_.node, gap}));  // a lost question is put again by the runner
}

void NodeBus::OnAsk(const base::Bytes& payload) {
  if (const auto question = DecodeNack(roster_.hash(), payload)) retransmit_server_->Take(*question);
}

void NodeBus::OnSampleBatch(const base::Bytes& payload) {
  if (!listens_) return;
  auto opened = DecodeSampleBatch(payload);
  if (!opened) return EndEarly(LifeEvent::kFailed, opened.error().Text());
  for (base::Bytes& sample : opened.value().samples) OnSample({}, std::move(sample));
}

void NodeBus::OnAnswer(const base::Bytes& payload) {
  auto opened = DecodeSampleBatch(payload);
  if (!opened) return EndEarly(LifeEvent::kFailed, opened.error().Text());
  if (opened.value().to != settings_.node) return;
  for (base::Bytes& sample : opened.value().samples) {
    TakeSnapshot(sample);
    OnSample({}, std::move(sample));
  }
}

void NodeBus::TakeSnapshot(const base::Bytes& payload) {
  const std::lock_guard lock(mutex_);
  if (!wanted_ || !lockstep::SampleHeader::HasHeader(payload)) return;
  const auto header = lockstep::SampleHeader::Read(payload);
  if (header.source != wanted_->source || header.step != wanted_->from) return;
  auto snapshot = lockstep::Snapshot::FromSample(payload);
  if (!snapshot || snapshot.value().node != settings_.node) return;
  snapshot_ = std::move(snapshot).value();
  woken_.notify_all();
}

base::Status NodeBus::Remember(const lockstep::Sample& sample) { return retransmit_server_->Remember(sample); }

std::optional<lockstep::Grant> NodeBus::AwaitGrant(std::chrono::milliseconds limit, bool with_resume) {
  const base::WaitNote note("the clock's first grant");
  const auto until = WallClock::now() + limit;
  std::unique_lock lock(mutex_);
  const auto is_there = [&] {
    return heard_ && (heard_->abort || !with_resume || heard_->resume != lockstep::kUnknown);
  };
  while (!is_there() && WallClock::now() < until && !mailbox_.early_end())
    woken_.wait_for(lock, std::chrono::milliseconds(10));
  return is_there() && !heard_->abort ? heard_ : std::nullopt;
}

std::optional<lockstep::Snapshot> NodeBus::FetchSnapshot(lockstep::Step step, std::chrono::milliseconds limit) {
  const lockstep::Gap wanted{*roster_.node(settings_.node).snapshots, step};
  const base::WaitNote note("its snapshot, which another node keeps");
  const auto until = WallClock::now() + limit;
  std::unique_lock lock(mutex_);
  wanted_ = wanted;
  while (!snapshot_ && WallClock::now() < until && !mailbox_.grant().abort) {
    lock.unlock();
    Ask(wanted);
    lock.lock();
    woken_.wait_for(lock, std::chrono::milliseconds(10), [&] { return snapshot_.has_value(); });
  }
  wanted_.reset();
  return std::exchange(snapshot_, std::nullopt);
}

void NodeBus::SetSafe(lockstep::Step safe) {
  const std::lock_guard lock(mutex_);
  safe_ = safe;
}

void NodeBus::Tell(const lockstep::Report& report) {
  NamedReport named;
  const lockstep::Grant grant = mailbox_.grant();
  {
    const std::lock_guard lock(mutex_);
    last_ = report;
    last_.safe = safe_;
    last_.granted = grant.through;
    last_.granted_final = grant.final;
    named.clock_id = clock_id_;
    named.hello = settings_.hello;
    named.report = last_;
    // The clock has read them by the time it grants a step.
    if (last_.phase > lockstep::Phase::kReady && grant.through >= 0) named.hello.topics = nullptr;
  }
  named.node = roster_.node(settings_.node).name;
  (void)reports_->Write(EncodeReport(named));  // a lost report is said again by the heartbeat
}

void NodeBus::Follow(const lockstep::Runner* runner) {
  const std::lock_guard lock(mutex_);
  runner_ = runner;
}

void NodeBus::SetWorldHash(base::Digest hash) {
  const std::lock_guard lock(mutex_);
  settings_.hello.world = hash;
}

void NodeBus::OnSample(std::string_view topic, base::Bytes&& payload) {
  if (!listens_) return;
  if (!lockstep::SampleHeader::HasHeader(payload))
    return EndEarly(LifeEvent::kFailed,
                    fmt::format("topic {}: a sample of {} bytes has no header", topic, payload.size()));
  const auto header = lockstep::SampleHeader::Read(payload);
  if (header.source >= roster_.sources().size() || (!topic.empty() && roster_.source(header.source).topic != topic)) {
    return EndEarly(LifeEvent::kFailed,
                    fmt::format("topic {}: a sample of source number {} was found, which does not publish it", topic,
                                header.source));
  }
  lockstep::Sample sample{header, std::make_shared<const base::Bytes>(std::move(payload))};
  if (auto status = Remember(sample); !status) return AbortBy(status.error(), sample);
  if (auto status = mailbox_.Deliver(sample); !status) AbortBy(status.error(), sample);
}

void NodeBus::AbortBy(const base::Error& error, const lockstep::Sample& came) {
  auto kept = retransmit_server_->Kept(came.source(), came.valid());
  if (!kept) kept = mailbox_.Kept(came.source(), came.valid());
  EndEarly(LifeEvent::kFailed, kept && kept->valid() == came.valid() && !lockstep::SameContent(*kept, came)
                                   ? launch::ContradictionText(roster_, settings_.topics, *kept, came)
                                   : error.Text());
}

void NodeBus::OnGrant(base::Bytes&& payload) {
  const auto grant = DecodeGrant(payload);
  if (!grant) return;  // of another version; the clock refuses our report and says so
  {
    const std::lock_guard lock(mutex_);
    if (clock_id_ == 0) clock_id_ = grant.value().clock_id;
    if (clock_id_ != grant.value().clock_id) return;  // one clock a run: the first
    heard_ = grant.value().grant;
    clock_silence_.Heard(NowMs());
  }
  const std::vector<std::uint32_t>& incarnations = grant.value().grant.incarnations;
  if (settings_.node < incarnations.size() && incarnations[settings_.node] > settings_.incarnation)
    return EndEarly(LifeEvent::kLost, "was replaced by another process");
  mailbox_.DeliverGrant(grant.value().grant);
  retransmit_server_->Granted(grant.value().grant);
  if (grant.value().grant.over || grant.value().grant.abort) woken_.notify_all();
}

void NodeBus::EndEarly(LifeEvent event, std::string reason) {
  mailbox_.EndEarly({event, std::move(reason)});
  woken_.notify_all();
}

// Where the node stands. A node that has to end and does not come to it, because it loads, computes or hangs, is
// reported as ended after a while: its process has a second.
lockstep::Report NodeBus::ReportNow() {
  const std::lock_guard lock(mutex_);
  lockstep::Report report = runner_ != nullptr ? runner_->report() : last_;
  const auto end = mailbox_.early_end();
  if (runner_ == nullptr && report.phase == lockstep::Phase::kRunning && held_up_since_) {  // of a server: a request
    report.waiting = lockstep::Waiting::kNothing;
    report.since_ms = std::chrono::duration_cast<std::chrono::milliseconds>(WallClock::now() - *held_up_since_).count();
  }
  if (!lockstep::IsTerminal(report.phase)) report.message = base::LongestWait(kShownWait);
  if (!end || lockstep::IsTerminal(report.phase)) return report;
  if (!ends_since_) ends_since_ = WallClock::now();
  if (runner_ != nullptr && WallClock::now() - *ends_since_ < kTimeToEnd) return report;
  report.phase = lockstep::NextPhase(report.phase, end->event);
  report.message = end->reason;
  return report;
}

void NodeBus::Heartbeat() {
  std::unique_lock lock(mutex_);
  std::uint64_t begun_before = 0;
  auto looked = WallClock::now();
  while (!stop_) {
    // A step may run on the receiving thread: one that hangs keeps all further messages, also the clock's, waiting.
    const std::uint64_t done = messages_done_, begun = messages_begun_;
    const bool was_stopped = WallClock::now() - looked > settings_.clock_silence / 10;
    const bool held_up = begun == begun_before && begun != done;
    if (!held_up || !held_up_since_) held_up_since_ = held_up ? std::optional(looked) : std::nullopt;
    begun_before = begun;
    looked = WallClock::now();
    const bool silent = clock_silence_.IsSilent(NowMs(), !held_up);
    lock.unlock();
    const lockstep::Grant grant = mailbox_.grant();
    if (silent && !grant.over && !grant.abort)
      EndEarly(LifeEvent::kFailed,
               fmt::format("the clock has said nothing for {:.1f} s: it was killed, stopped or cut off",
                           static_cast<double>(settings_.clock_silence.count()) / 1e3));
    if (g_terminated != 0 && !grant.over)
      EndEarly(LifeEvent::kLost, fmt::format("was told to end by signal {} (Terminated)", SIGTERM));
    lock.lock();
    // What has come while this process was stopped is read before it reports.
    if (was_stopped) woken_.wait_for(lock, kTimeToRead, [this] { return stop_; });
    lock.unlock();
    Tell(ReportNow());
    lock.lock();
    woken_.wait_for(lock, settings_.heartbeat, [this] { return stop_; });
  }
}

void NodeBus::Linger(const lockstep::Report& last, std::optional<std::chrono::milliseconds> limit) {
  Follow(nullptr);
  const auto begin = WallClock::now();
  Tell(last);
  std::unique_lock lock(mutex_);
  while (!limit || WallClock::now() < begin + *limit) {
    lock.unlock();
    const lockstep::Grant grant = mailbox_.grant();
    if (clock_id() == 0) Tell(last);  // not met yet: what was said may have reached no node
    lock.lock();
    if (grant.over) return;
    if (grant.abort && WallClock::now() > begin + std::chrono::milliseconds(100))
      return;  // the last word had time to go
    woken_.wait_for(lock, std::chrono::milliseconds(10));
  }
}

std::uint64_t NodeBus::clock_id() const {
  const std::lock_guard lock(mutex_);
  return clock_id_;
}

}  // namespace rodeira::dds
