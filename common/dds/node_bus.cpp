#include "common/dds/node_bus.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <set>
#include <utility>

#include "idl/topics.hpp"

namespace rodeira::dds {

namespace {

volatile std::sig_atomic_t g_terminated = 0;

void OnTerminate(int) {
  g_terminated = 1;
  ::alarm(1);  // whose default ends the process, should it hang
}

}  // namespace

void NodeBus::HandleSignals() {
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, OnTerminate);
  std::signal(SIGXFSZ, SIG_IGN);  // a file-size limit is an error to report, not the process' end
}

namespace topics = idl::topics;
using WallClock = std::chrono::steady_clock;

NodeBus::NodeBus(const lockstep::Roster& roster, lockstep::Mailbox& mailbox, const Settings& settings)
    : roster_(roster), mailbox_(mailbox), settings_(settings), listens_(settings.incarnation == 0), kept_(roster, settings.node),
      parcels_(roster, settings.node, settings.most_parcel_bytes) {
  last_.node = settings.node;
  last_.incarnation = settings.incarnation;
  if (settings.keeps_all) archive_.emplace(roster);
}

base::Result<std::unique_ptr<NodeBus>> NodeBus::Open(Participant& participant, const lockstep::Roster& roster, lockstep::Mailbox& mailbox,
                                                     const Settings& settings) {
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
  readers_.clear();  // first: their callbacks use the rest
}

base::Status NodeBus::Connect(Participant& participant) {
  const auto add_reader = [&](std::string_view topic, Delivery delivery, OnPayload on_payload) -> base::Status {
    auto reader = participant.MakeReader(topic, delivery, std::move(on_payload));
    if (!reader) return reader.error();
    readers_.push_back(std::move(reader).value());
    return {};
  };
  outputs_ = roster_.node(settings_.node).outputs;
  if (const auto& snapshots = roster_.node(settings_.node).snapshots) outputs_.push_back(*snapshots);
  for (const lockstep::SourceIndex output : outputs_) {
    auto writer = participant.MakeWriter(roster_.source(output).topic, Delivery::kSaidAgain);
    if (!writer) return writer.error();
    writers_.push_back(std::move(writer).value());
  }
  for (const lockstep::Port& port : roster_.node(settings_.node).inputs) {
    const std::string_view topic = port.topic;
    const auto in_parcels = [&](lockstep::SourceIndex source) { return lockstep::GetsParcels(roster_, source, settings_.node); };
    if (std::all_of(port.sources.begin(), port.sources.end(), in_parcels)) continue;
    if (auto status = add_reader(topic, Delivery::kSaidAgain, [this, topic](base::Bytes&& bytes) { OnSample(topic, std::move(bytes)); }); !status) return status;
  }
  if (archive_) {
    for (const lockstep::Port& port : roster_.node(settings_.node).inputs) {
      auto relay = participant.MakeWriter(port.topic, Delivery::kSaidAgain);
      if (!relay) return relay.error();
      relays_.emplace(port.topic, std::move(relay).value());
    }
  }
  if (auto status = ConnectParcels(participant); !status) return status;
  if (!writers_.empty() || archive_) {
    if (auto status = add_reader(topics::kAsk, Delivery::kSaidAgain, [this](base::Bytes&& bytes) { OnAsk(bytes); }); !status) return status;
  }
  auto questions = participant.MakeWriter(topics::kAsk, Delivery::kSaidAgain);
  if (!questions) return questions.error();
  questions_ = std::move(questions).value();
  auto reports = participant.MakeWriter(topics::kReport, Delivery::kSaidAgain);
  if (!reports) return reports.error();
  reports_ = std::move(reports).value();
  return add_reader(topics::kGrant, Delivery::kSaidAgain, [this](base::Bytes&& bytes) { OnGrant(std::move(bytes)); });
}

// Whom this node sends parcels, and those for it. A recorder that answers for others sends them to everybody who gets any.
base::Status NodeBus::ConnectParcels(Participant& participant) {
  const auto topic_of = [&](lockstep::NodeIndex n) { return std::string(topics::kParcels) + roster_.node(n).name; };
  std::set<lockstep::NodeIndex> consumers;
  for (const lockstep::NodeIndex n : parcels_.Consumers()) consumers.insert(n);
  bool gets_some = false;
  for (lockstep::NodeIndex n = 0; n < roster_.nodes().size(); ++n) {
    for (const lockstep::Port& port : roster_.node(n).inputs) {
      for (const lockstep::SourceIndex source : port.sources) {
        if (!lockstep::GetsParcels(roster_, source, n)) continue;
        if (n == settings_.node) gets_some = true;
        else if (archive_) consumers.insert(n);
      }
    }
  }
  for (const lockstep::NodeIndex n : consumers) {
    auto writer = participant.MakeWriter(topic_of(n), Delivery::kSaidAgain);
    if (!writer) return writer.error();
    parcel_writers_.emplace(n, std::move(writer).value());
  }
  if (!gets_some) return {};
  auto reader = participant.MakeReader(topic_of(settings_.node), Delivery::kSaidAgain, [this](base::Bytes&& bytes) { OnParcel(bytes); });
  if (!reader) return reader.error();
  readers_.push_back(std::move(reader).value());
  return {};
}

base::Status NodeBus::Publish(const lockstep::Sample& sample) {
  std::vector<lockstep::Parcels::Parcel> parcels;
  const lockstep::Grant grant = mailbox_.grant();
  {
    const std::lock_guard lock(kept_mutex_);
    kept_.Add(sample);
    parcels = parcels_.Add(sample, grant.final ? grant.through : lockstep::kNever);
  }
  for (const auto& parcel : parcels) {
    if (auto status = parcel_writers_.at(parcel.to)->Write(EncodeParcel(parcel.samples)); !status) return status;
  }
  return Say(sample);  // also where every consumer gets parcels: others may look on
}

base::Status NodeBus::Say(const lockstep::Sample& sample) { return WriterOf(sample.source()).Write(*sample.payload); }

Writer& NodeBus::WriterOf(lockstep::SourceIndex source) {
  const auto output = std::find(outputs_.begin(), outputs_.end(), source);
  RODEIRA_ASSERT(output != outputs_.end());
  return *writers_[static_cast<std::size_t>(output - outputs_.begin())];
}

// By itself also where parcels are usual: what is small gets through where large ones were lost.
void NodeBus::SayTo(lockstep::NodeIndex asker, const lockstep::Sample& sample, Writer& to_all) {
  const auto to = parcel_writers_.find(asker);
  const bool parcel = to != parcel_writers_.end() && lockstep::GetsParcels(roster_, sample.source(), asker);
  (void)(parcel ? to->second->Write(EncodeParcel({sample})) : to_all.Write(*sample.payload));
}

void NodeBus::Ask(const lockstep::Gap& gap) {
  (void)questions_->Write(EncodeAsk(roster_.hash(), {settings_.node, gap}));  // a lost question is put again by the runner
}

void NodeBus::OnAsk(const base::Bytes& payload) {
  const auto ask = DecodeAsk(roster_.hash(), payload);
  if (!ask) return;
  std::vector<lockstep::Sample> again;
  {
    const std::lock_guard lock(kept_mutex_);
    again = kept_.From(ask->gap);
  }
  for (const lockstep::Sample& sample : again) SayTo(ask->asker, sample, WriterOf(sample.source()));
  if (archive_) AnswerForOthers(*ask);
}

void NodeBus::AnswerForOthers(const dds::Ask& ask) {
  std::vector<lockstep::Sample> again;
  {
    const std::lock_guard lock(kept_mutex_);
    again = archive_->From(ask.gap);
  }
  for (const lockstep::Sample& sample : again) SayTo(ask.asker, sample, *relays_.find(roster_.source(sample.source()).topic)->second);
}

void NodeBus::OnParcel(const base::Bytes& payload) {
  if (!listens_) return;
  auto samples = DecodeParcel(payload);
  if (!samples) return Abort(samples.error().Text());
  for (base::Bytes& sample : samples.value()) OnSample({}, std::move(sample));
}

base::Status NodeBus::Remember(const lockstep::Sample& sample) {
  if (!archive_) return {};
  const std::lock_guard lock(kept_mutex_);
  return archive_->Add(sample);
}

std::optional<lockstep::Grant> NodeBus::AwaitGrant(std::chrono::milliseconds limit) {
  const auto until = WallClock::now() + limit;
  std::unique_lock lock(mutex_);
  while (!heard_ && WallClock::now() < until) woken_.wait_for(lock, std::chrono::milliseconds(10));
  return heard_ && !heard_->abort ? heard_ : std::nullopt;
}

std::optional<lockstep::Snapshot> NodeBus::FetchSnapshot(Participant& participant, lockstep::Step step, std::chrono::milliseconds limit) {
  const lockstep::SourceIndex source = *roster_.node(settings_.node).snapshots;
  std::mutex mutex;
  std::condition_variable arrived;
  std::optional<lockstep::Snapshot> found;
  auto reader = participant.MakeReader(lockstep::kSnapshotTopic, Delivery::kSaidAgain, [&](base::Bytes&& payload) {
    if (!lockstep::SampleHeader::HasHeader(payload)) return;
    const auto header = lockstep::SampleHeader::Read(payload);
    if (header.source != source || header.step != step) return;
    auto snapshot = lockstep::Snapshot::FromSample(payload);
    if (!snapshot || snapshot.value().node != settings_.node) return;
    const std::lock_guard lock(mutex);
    found = std::move(snapshot).value();
    arrived.notify_all();
  });
  if (!reader) return std::nullopt;
  const auto until = WallClock::now() + limit;
  std::unique_lock lock(mutex);
  while (!found && WallClock::now() < until && !mailbox_.grant().abort) {
    lock.unlock();
    Ask({source, step});
    lock.lock();
    arrived.wait_for(lock, std::chrono::milliseconds(10), [&] { return found.has_value(); });
  }
  lock.unlock();
  reader.value().reset();  // its callback uses what lies on this stack
  return found;
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

std::string NodeBus::fault() const {
  const std::lock_guard lock(mutex_);
  return fault_;
}

void NodeBus::OnSample(std::string_view topic, base::Bytes&& payload) {
  if (!listens_) return;
  if (!lockstep::SampleHeader::HasHeader(payload)) return Abort(fmt::format("topic {}: a sample of {} bytes has no header", topic, payload.size()));
  const auto header = lockstep::SampleHeader::Read(payload);
  if (header.source >= roster_.sources().size() || (!topic.empty() && roster_.source(header.source).topic != topic)) {
    return Abort(fmt::format("topic {}: a sample of source number {} was found, which does not publish it", topic, header.source));
  }
  lockstep::Sample sample{header, std::make_shared<const base::Bytes>(std::move(payload))};
  if (auto status = Remember(sample); !status) return Abort(status.error().Text());
  auto status = mailbox_.Deliver(std::move(sample));
  if (!status) Abort(status.error().Text());
}

void NodeBus::OnGrant(base::Bytes&& payload) {
  const auto grant = DecodeGrant(payload);
  if (!grant) return;  // of another version; the clock refuses our report and says so
  {
    const std::lock_guard lock(mutex_);
    if (clock_id_ == 0) clock_id_ = grant.value().clock_id;
    if (clock_id_ != grant.value().clock_id) return;  // one clock a run: the first
    heard_ = grant.value().grant;
    clock_heard_ = WallClock::now();
    if (grant.value().grant.abort && fault_.empty()) fault_ = grant.value().grant.reason;
  }
  const std::vector<std::uint32_t>& lives = grant.value().grant.lives;
  if (settings_.node < lives.size() && lives[settings_.node] > settings_.incarnation) return Abort("another process has taken its place");
  mailbox_.DeliverGrant(grant.value().grant);
  {
    const std::lock_guard lock(kept_mutex_);
    kept_.Granted(grant.value().grant);
    if (archive_) archive_->Forget(grant.value().grant.resume);
  }
  if (grant.value().grant.over || grant.value().grant.abort) woken_.notify_all();
}

void NodeBus::Abort(std::string reason) {
  {
    const std::lock_guard lock(mutex_);
    if (fault_.empty()) fault_ = reason;
    last_.phase = lockstep::Phase::kFailed;
    last_.message = reason;
  }
  lockstep::Grant grant = mailbox_.grant();
  grant.abort = true;
  grant.reason = std::move(reason);
  mailbox_.DeliverGrant(grant);
  woken_.notify_all();
}

void NodeBus::Heartbeat() {
  std::unique_lock lock(mutex_);
  auto looked = WallClock::now();
  while (!stop_) {
    const auto gap = WallClock::now() - looked;
    looked += gap;
    if (gap > settings_.clock_silence / 10) clock_heard_ += gap;  // this process itself was stopped, as by a debugger
    const lockstep::Runner* runner = runner_;
    lockstep::Report report = last_;
    const bool silent = clock_id_ != 0 && fault_.empty() && WallClock::now() - clock_heard_ > settings_.clock_silence;
    lock.unlock();
    if (runner != nullptr && report.phase < lockstep::Phase::kFailed) report = runner->report();
    if (silent && !mailbox_.grant().over) Abort(fmt::format("the clock has said nothing for {:.1f} s: it was killed, stopped or cut off",
                                                            static_cast<double>(settings_.clock_silence.count()) / 1e3));
    if (g_terminated != 0 && !mailbox_.grant().over) Abort("the process was told to end by SIGTERM");
    Tell(report);
    lock.lock();
    woken_.wait_for(lock, settings_.heartbeat, [this] { return stop_; });
  }
}

void NodeBus::Linger(const lockstep::Report& last, std::chrono::milliseconds limit) {
  Follow(nullptr);
  const auto until = WallClock::now() + limit;
  Tell(last);
  std::unique_lock lock(mutex_);
  while (WallClock::now() < until) {
    lock.unlock();
    const lockstep::Grant grant = mailbox_.grant();
    if (clock_id() == 0) Tell(last);  // not met yet: what was said may have reached nobody
    lock.lock();
    if (grant.over) return;
    if (grant.abort && WallClock::now() > until - limit + std::chrono::milliseconds(100)) return;  // the last word had time to go
    woken_.wait_for(lock, std::chrono::milliseconds(10));
  }
}

std::uint64_t NodeBus::clock_id() const {
  const std::lock_guard lock(mutex_);
  return clock_id_;
}

}  // namespace rodeira::dds
