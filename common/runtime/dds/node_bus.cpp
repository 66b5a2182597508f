// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/node_bus.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "common/core/base/recycled_bytes.hpp"
#include "common/core/base/wait.hpp"
#include "common/runtime/dds/wall_clock.hpp"
#include "common/runtime/launch/sample_difference.hpp"
#include "idl/topics.hpp"

namespace rodeira::dds {

namespace topics = idl::topics;
using lockstep::LifeEvent;

namespace {

// Bytes that nothing else needs.
base::Status WriteOnce(Writer& writer, base::Bytes&& payload) {
  auto status = writer.Write(payload);
  base::RecycleBytes(std::move(payload));
  return status;
}

}  // namespace

NodeBus::NodeBus(const lockstep::Roster& roster, lockstep::Mailbox& mailbox, const Settings& settings)
    : roster_(roster),
      mailbox_(mailbox),
      settings_(settings),
      listens_(settings.incarnation == 0),
      batches_(roster, settings.node, settings.max_batch_bytes),
      clock_silence_(settings.clock_silence.count(), settings.longest_gap.count()),
      safe_(settings.keeps_all && settings.incarnation > 0 ? lockstep::kUnknown : -1) {
  last_.node = settings.node;
  last_.incarnation = settings.incarnation;
  retransmit_server_.emplace(roster, settings.node, settings.keeps_all, settings.most_answer_bytes,
                             [this](lockstep::NodeIndex requester, std::span<const lockstep::Sample> samples) {
                               if (requester != settings_.node)
                                 (void)WriteOnce(*answers_writer_, EncodeSampleBatch(requester, samples));
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
  listener_.reset();
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
    const auto comes_otherwise = [&](lockstep::SourceIndex source) {
      return IsLocal(source) || lockstep::GetsSampleBatches(roster_, source, settings_.node);
    };
    if (std::all_of(port.sources.begin(), port.sources.end(), comes_otherwise)) continue;
    if (auto status = add_reader(topic, Delivery::kBestEffortRepeated,
                                 [this, topic](base::Bytes&& bytes) { OnSample(topic, std::move(bytes)); });
        !status)
      return status;
  }
  if (auto status = ConnectSampleBatches(participant); !status) return status;
  // Answers have a topic of their own, which no step is published on: two threads that write on a topic which their
  // process also reads can stop each other for good, each within a lock of Fast DDS that the other waits for.
  auto answers = participant.MakeWriter(topics::kRetransmissions, Delivery::kBestEffortRepeated);
  if (!answers) return answers.error();
  answers_writer_ = std::move(answers).value();
  if (auto status = add_reader(topics::kRetransmissions, Delivery::kBestEffortRepeated,
                               [this](base::Bytes&& bytes) { OnAnswer(bytes); });
      !status)
    return status;
  if (!writers_.empty() || settings_.keeps_all) {
    if (auto status =
            add_reader(topics::kNack, Delivery::kBestEffortRepeated, [this](base::Bytes&& bytes) { OnNack(bytes); });
        !status)
      return status;
  }
  auto nacks = participant.MakeWriter(topics::kNack, Delivery::kBestEffortRepeated);
  if (!nacks) return nacks.error();
  nack_writer_ = std::move(nacks).value();
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
    if (IsHere(n)) continue;
    auto writer = participant.MakeWriter(topic_of(n), Delivery::kBestEffortRepeated);
    if (!writer) return writer.error();
    batch_writers_.emplace(n, std::move(writer).value());
  }
  const auto gets_batches = [&](const lockstep::Port& port) {
    return std::any_of(port.sources.begin(), port.sources.end(), [&](lockstep::SourceIndex source) {
      return !IsLocal(source) && lockstep::GetsSampleBatches(roster_, source, settings_.node);
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
  retransmit_server_->Keep(sample);
  for (const auto& batch : batches_.Add(sample, mailbox_.last_step())) {
    if (IsHere(batch.to)) continue;
    if (auto status = WriteOnce(*batch_writers_.at(batch.to), EncodeSampleBatch(batch.to, batch.samples)); !status)
      return status;
  }
  // Also where every consumer gets batches or is in this process: others may look on.
  if (auto status = Say(sample); !status) return status;
  if (settings_.exchange != nullptr) settings_.exchange->Deliver(sample);
  return {};
}

bool NodeBus::IsHere(lockstep::NodeIndex node) const {
  return settings_.exchange != nullptr && settings_.exchange->Has(node);
}
bool NodeBus::IsLocal(lockstep::SourceIndex source) const {
  return settings_.exchange != nullptr && settings_.exchange->HasSource(source);
}

base::Status NodeBus::Say(const lockstep::Sample& sample) { return WriterOf(sample.source()).Write(*sample.payload); }

Writer& NodeBus::WriterOf(lockstep::SourceIndex source) {
  const auto output = std::find(outputs_.begin(), outputs_.end(), source);
  RODEIRA_ASSERT(output != outputs_.end());
  return *writers_[static_cast<std::size_t>(output - outputs_.begin())];
}

void NodeBus::SendNack(const lockstep::Gap& gap) {
  (void)WriteOnce(*nack_writer_, EncodeNack(roster_.hash(), {settings_.node, gap}));  // the runner repeats a lost nack
}

void NodeBus::OnNack(const base::Bytes& payload) {
  if (const auto nack = DecodeNack(roster_.hash(), payload)) retransmit_server_->Take(*nack);
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
    SendNack(wanted);
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
  (void)WriteOnce(*reports_, EncodeReport(named));  // a lost report is said again by the heartbeat
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
  // Of a topic on which nodes of other processes publish, too. An answer has no topic.
  if (!topic.empty() && IsLocal(header.source)) return;
  Take({header, base::ShareBytes(std::move(payload))});
}

void NodeBus::TakeLocal(const lockstep::Sample& sample) {
  if (listens_) Take(sample);
}

void NodeBus::Take(const lockstep::Sample& sample) {
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
  const auto grant = Note(payload);
  if (!grant) return;
  mailbox_.DeliverGrant(*grant);
  retransmit_server_->Granted(*grant);
  if (grant->over || grant->abort) woken_.notify_all();
}

void NodeBus::OnGrantMeanwhile(const base::Bytes& payload) {
  const auto grant = Note(payload);
  if (!grant) return;
  {
    const std::lock_guard lock(mutex_);
    heard_meanwhile_ = true;
  }
  if (grant->over || grant->abort) mailbox_.DeliverGrant(*grant);
}

std::optional<lockstep::Grant> NodeBus::Note(const base::Bytes& payload) {
  const auto grant = DecodeGrant(payload);
  if (!grant) return std::nullopt;  // of another version; the clock refuses our report and says so
  {
    const std::lock_guard lock(mutex_);
    if (clock_id_ == 0) clock_id_ = grant.value().clock_id;
    if (clock_id_ != grant.value().clock_id) return std::nullopt;  // one clock a run: the first
    heard_ = grant.value().grant;
    clock_silence_.Heard(NowMs());
  }
  const std::vector<std::uint32_t>& incarnations = grant.value().grant.incarnations;
  if (settings_.node >= incarnations.size() || incarnations[settings_.node] <= settings_.incarnation)
    return grant.value().grant;
  EndEarly(LifeEvent::kLost, "was replaced by another process");
  return std::nullopt;
}

void NodeBus::EndEarly(LifeEvent event, std::string reason) {
  mailbox_.EndEarly({event, std::move(reason)});
  woken_.notify_all();
}

std::uint64_t NodeBus::clock_id() const {
  const std::lock_guard lock(mutex_);
  return clock_id_;
}

}  // namespace rodeira::dds
