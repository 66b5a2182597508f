// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>

#include "common/core/base/crash_trace.hpp"
#include "common/core/base/wait.hpp"
#include "common/runtime/dds/clock_silence_limit.hpp"
#include "common/runtime/dds/hosted_part.hpp"
#include "common/runtime/dds/node_bus.hpp"
#include "common/runtime/dds/remote_ground.hpp"
#include "common/runtime/dds/remote_keys.hpp"
#include "common/runtime/dds/remote_log.hpp"
#include "common/runtime/dds/remote_requests.hpp"
#include "common/runtime/dds/run.hpp"
#include "common/runtime/dds/run_one_part.hpp"
#include "common/runtime/dds/supervisor_pipe.hpp"
#include "common/runtime/launch/node_library.hpp"
#include "common/runtime/lockstep/pump.hpp"
#include "common/runtime/lockstep/recovery.hpp"
#include "common/runtime/lockstep/runner.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"

namespace rodeira::dds {
namespace {

using namespace std::chrono_literals;

// A datagram is lost with any of its fragments of 1 500 bytes.
constexpr std::size_t kSampleBatchOnWire_bytes = 8'000;
constexpr std::size_t kSampleBatchInMemory_bytes = 40'000;
constexpr std::size_t kAnswerOnWire_bytes = 1'200;

class ProcessContext final : public launch::NodeContext {
 public:
  ProcessContext(const launch::Launch& launch, lockstep::NodeIndex index, Participant& participant,
                 lockstep::Mailbox& mailbox, NodeBus& bus, std::uint32_t incarnation)
      : NodeContext(launch, index),
        participant_(participant),
        mailbox_(mailbox),
        bus_(bus),
        incarnation_(incarnation) {}

  ground::Ground& Ground() override {
    if (ground_ == nullptr) {
      auto ground = RemoteGround::Open(participant_, index(), incarnation_, [this] { return mailbox_.grant().abort; });
      RODEIRA_ASSERT(ground.ok());  // fails only where Fast DDS has no memory left
      ground_ = std::move(ground).value();
    }
    return *ground_;
  }
  base::Result<launch::WorldSummary> World() override {
    std::mutex mutex;
    std::condition_variable woken;
    std::optional<launch::WorldSummary> summary;
    auto reader = participant_.MakeReader(idl::topics::kWorldInfo, Delivery::kLatched, [&](base::Bytes&& bytes) {
      const auto info = idl::Decode<msg::WorldInfo>(bytes);
      if (!info) return;
      const std::lock_guard lock(mutex);
      summary = {info.value().content_hash(), info.value().name(), info.value().start_x_m(), info.value().start_y_m(),
                 info.value().start_heading_rad()};
      woken.notify_all();
    });
    if (!reader) return reader.error();
    const base::WaitNote note("the road server's world");
    std::unique_lock lock(mutex);
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(launch().watchdog().start_ms);
    while (!summary && !mailbox_.grant().abort && std::chrono::steady_clock::now() < until) woken.wait_for(lock, 20ms);
    lock.unlock();
    reader.value().reset();  // its callback uses what lies on this stack
    if (!summary) return base::Failed("run.no_answer", "the road server has not answered");
    return *summary;
  }
  std::unique_ptr<launch::LiveKeysSender> KeysSender() override {
    auto sender = OpenKeysSender(participant_);
    RODEIRA_ASSERT(sender.ok());  // fails only where Fast DDS has no memory left
    return std::move(sender).value();
  }
  std::unique_ptr<launch::LiveKeysReceiver> KeysReceiver() override {
    auto receiver = OpenKeysReceiver(participant_);
    RODEIRA_ASSERT(receiver.ok());
    return std::move(receiver).value();
  }
  std::unique_ptr<launch::LiveRequestsSender> RequestsSender() override {
    auto sender = OpenRequestsSender(participant_);
    RODEIRA_ASSERT(sender.ok());
    return std::move(sender).value();
  }
  std::unique_ptr<launch::LiveRequestsReceiver> RequestsReceiver() override {
    auto receiver = OpenRequestsReceiver(participant_);
    RODEIRA_ASSERT(receiver.ok());
    return std::move(receiver).value();
  }
  std::unique_ptr<launch::RunLogReceiver> RunLog() override {
    auto receiver = OpenLogReceiver(participant_, roster().hash());
    RODEIRA_ASSERT(receiver.ok());
    return std::move(receiver).value();
  }
  bool is_restarted() const override { return incarnation_ > 0; }
  base::Result<lockstep::Step> LastRecordedStep() override {
    const auto grant = bus_.AwaitGrant(std::chrono::milliseconds(launch().watchdog().start_ms));
    if (!grant) return base::Failed("run.no_answer", "the clock has not answered a restarted node");
    return grant->safe;
  }
  std::function<void(lockstep::Step)> RecordedStepReporter() override {
    return [&bus = bus_](lockstep::Step through) { bus.SetSafe(through); };
  }
  base::Status Remember(const lockstep::Sample& sample) override { return bus_.Remember(sample); }
  void Follow(lockstep::Runner* runner) {
    if (ground_ != nullptr) ground_->Follow(runner);
  }

 private:
  Participant& participant_;
  lockstep::Mailbox& mailbox_;
  NodeBus& bus_;
  std::uint32_t incarnation_;
  std::unique_ptr<RemoteGround> ground_;
};

// For another incarnation than the first.
base::Status FindBeginning(ProcessContext& context, NodeBus& bus, lockstep::Mailbox& mailbox,
                           lockstep::Runner::Settings& settings) {
  const auto limit = std::chrono::milliseconds(context.launch().watchdog().start_ms);
  const auto until = std::chrono::steady_clock::now() + limit;
  if (context.roster().node(context.index()).keeps_snapshots()) bus.SetSafe(context.has_through());
  for (;;) {  // a clock that takes the place of a lost one may name a later snapshot
    const auto grant = bus.AwaitGrant(limit, true);
    if (!grant) return base::Failed("run.no_answer", "the clock has not answered a restarted node");
    const lockstep::Beginning beginning =
        lockstep::BeginningOf(context.roster(), context.index(), *grant, context.has_through());
    settings.sink_from = beginning.sink_from;
    if (beginning.snapshot <= 0) break;
    settings.resume = bus.FetchSnapshot(beginning.snapshot, std::min<std::chrono::milliseconds>(limit, 500ms));
    if (settings.resume) break;
    if (mailbox.grant().abort || std::chrono::steady_clock::now() > until)
      return base::Failed("run.cannot_restart",
                          fmt::format("no process has its snapshot at step {}", beginning.snapshot));
  }
  if (settings.resume && !settings.resume->has_state)
    return base::Failed("run.cannot_restart", "it cannot save its state, so it cannot be started again");
  mailbox.StartAt(settings.resume ? settings.resume->at : settings.sink_from);
  bus.Listen();
  return {};
}

// Its calls are those of the node, on whatever thread they come: what crashes is named.
class NamedCalls final : public lockstep::Node {
 public:
  NamedCalls(std::unique_ptr<lockstep::Node> node, const char* name) : node_(std::move(node)), name_(name) {}
  base::Status Initialise(lockstep::Outbox& outbox) override {
    const base::NodeCall call(name_);
    return node_->Initialise(outbox);
  }
  base::Status Step(const lockstep::StepInfo& step, const lockstep::Inbox& inbox, lockstep::Outbox& outbox) override {
    const base::NodeCall call(name_);
    return node_->Step(step, inbox, outbox);
  }
  base::Status Flush() override {
    const base::NodeCall call(name_);
    return node_->Flush();
  }
  bool runs_inline() const override { return node_->runs_inline(); }
  void Save(base::StateWriter& out) const override {
    const base::NodeCall call(name_);
    node_->Save(out);
  }
  void Restore(base::StateReader& in) override {
    const base::NodeCall call(name_);
    node_->Restore(in);
  }
  bool can_save() const override { return node_->can_save(); }
  base::Status Finish(const lockstep::Inbox& rest, lockstep::Step last_step, bool complete) override {
    const base::NodeCall call(name_);
    return node_->Finish(rest, last_step, complete);
  }

 private:
  std::unique_ptr<lockstep::Node> node_;
  const char* name_;
};

class HostedNode final : public HostedPart {
 public:
  HostedNode(const PartHost& host, lockstep::NodeIndex index, std::uint32_t incarnation, launch::NodeFactory factory)
      : host_(host),
        name_(host.exchange == nullptr ? "" : host.launch.roster().node(index).name),
        incarnation_(incarnation),
        factory_(std::move(factory)),
        mailbox_(host.launch.roster(), index) {}

  base::Status Open(lockstep::NodeIndex index) {
    const lockstep::Roster& roster = host_.launch.roster();
    const bool is_shared_memory = host_.domain.transport == launch::Transport::kSharedMemory;
    NodeBus::Settings settings;
    settings.node = index;
    settings.incarnation = incarnation_;
    settings.hello = OwnHello(host_.launch, index);
    settings.topics = host_.launch.topics();
    settings.domain = host_.domain;
    settings.max_batch_bytes = is_shared_memory ? kSampleBatchInMemory_bytes : kSampleBatchOnWire_bytes;
    settings.most_answer_bytes = is_shared_memory ? kSampleBatchInMemory_bytes : kAnswerOnWire_bytes;
    settings.keeps_all = host_.launch.keeps_for_restarts() && roster.node(index).keeps_snapshots();
    settings.exchange = host_.exchange;
    settings.has_sink = host_.has_sink;
    settings.clock_silence = ClockSilenceLimit(host_.launch);
    auto bus = NodeBus::Open(host_.participant, roster, mailbox_, settings);
    if (!bus) return bus.error();
    bus_ = std::move(bus).value();
    if (host_.exchange != nullptr) host_.exchange->Join(index, *bus_);
    context_.emplace(host_.launch, index, host_.participant, mailbox_, *bus_, incarnation_);
    return {};
  }

  void Make() override {
    const base::NodeCall call(name_.empty() ? nullptr : name_.c_str());
    problem_ = MakeNode();
  }

  // What goes wrong is told to the clock, which ends the run.
  int Run() override {
    const base::NodeCall call(name_.empty() ? nullptr : name_.c_str());
    if (!problem_.ok()) return Fail(problem_.error());
    lockstep::Runner::Settings settings;
    settings.incarnation = incarnation_;
    if (incarnation_ > 0) {
      if (auto status = FindBeginning(*context_, *bus_, mailbox_, settings); !status) return Fail(status.error());
    }
    lockstep::Runner runner(context_->roster(), context_->index(), *node_, *bus_, mailbox_, settings);
    context_->Follow(&runner);
    bus_->Follow(&runner);
    const auto outcome = node_->runs_inline() ? lockstep::RunInline(runner, mailbox_, settings) : runner.Run();
    context_->Follow(nullptr);
    const bool finished = outcome == lockstep::Runner::Outcome::kFinished;
    WriteLastWord(runner.report(), name_);
    bus_->Linger(runner.report(), finished ? std::nullopt : std::optional(500ms));
    if (finished) return 0;
    return runner.report().phase == lockstep::Phase::kRefused ? 2 : 1;
  }

 private:
  base::Status MakeNode() {
    (void)context_->config();  // so that the keys of a node that reads none are unknown ones
    auto node = factory_(*context_);
    if (!node) return node.error();
    node = launch::AsManifestSays(*host_.launch.node(context_->index()).kind, std::move(node).value());
    if (!node) return node.error();
    node_ = std::move(node).value();
    if (!name_.empty()) node_ = std::make_unique<NamedCalls>(std::move(node_), name_.c_str());
    if (auto status = host_.launch.file().Finish(); !status) return status;
    bus_->SetWorldHash(context_->world_hash());
    return {};
  }
  int Fail(const base::Error& error) {
    lockstep::Report report;
    report.node = context_->index();
    report.incarnation = incarnation_;
    const auto end = mailbox_.early_end().value_or(lockstep::EarlyEnd{
        error.exit_status() == 2 ? lockstep::LifeEvent::kRefused : lockstep::LifeEvent::kFailed, error.Text()});
    report.phase = lockstep::NextPhase(report.phase, end.event);
    report.message = end.reason;
    WriteLastWord(report, name_);
    bus_->Linger(report, 1000ms);
    return report.phase == lockstep::Phase::kRefused ? 2 : 1;
  }

  const PartHost host_;
  const std::string name_;  // empty: the process has one node
  const std::uint32_t incarnation_;
  launch::NodeFactory factory_;
  lockstep::Mailbox mailbox_;
  std::unique_ptr<NodeBus> bus_;
  std::optional<ProcessContext> context_;
  std::unique_ptr<lockstep::Node> node_;
  base::Status problem_;
};

}  // namespace

base::Result<std::unique_ptr<HostedPart>> OpenNode(const PartHost& host, lockstep::NodeIndex index,
                                                   std::uint32_t incarnation, launch::NodeFactory factory) {
  auto node = std::make_unique<HostedNode>(host, index, incarnation, std::move(factory));
  if (auto status = node->Open(index); !status) return status.error();
  return std::unique_ptr<HostedPart>(std::move(node));
}

int RunNode(std::string_view kind, int argc, char** argv, const launch::NodeFactory& factory) {
  // An external node is called as its file is.
  const std::string program = kind == launch::kExternalKind ? std::filesystem::path(argv[0]).filename().string()
                                                            : fmt::format("rodeira-{}", kind);
  return RunOnePart(program, kind, argc, argv,
                    [&](const PartHost& host, lockstep::NodeIndex index, std::uint32_t incarnation) {
                      return OpenNode(host, index, incarnation, factory);
                    });
}

}  // namespace rodeira::dds
